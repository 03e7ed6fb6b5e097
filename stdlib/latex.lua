--- Tables of results for papers: rows in the form of clench.csv, as a LaTeX table with the rules of the package booktabs.
local raise = require "clench.raise"
local column_names = require "clench.column_names"
local described = require "clench.described"
local read_options = require "clench.options"
local latex = {}

local escapes = {["\\"] = "\\textbackslash{}", ["{"] = "\\{", ["}"] = "\\}", ["$"] = "\\$", ["&"] = "\\&", ["#"] = "\\#", ["%"] = "\\%",
                 ["_"] = "\\_", ["^"] = "\\textasciicircum{}", ["~"] = "\\textasciitilde{}", ["\n"] = " "}
local function escaped(text) return (text:gsub("[\\{}$&#%%_^~\n]", escapes)) end

-- a number as text: 1.5e-07 as a power of ten
local function number_text(value, format)
  if value ~= value then return "--" end
  if value - value ~= 0 then return value > 0 and "$\\infty$" or "$-\\infty$" end
  local text = (math.type(value) == "integer" and not format) and ("%d"):format(value) or (format or "%.3g"):format(value)
  local digits, power = text:match "^(.-)e([-+]%d+)$"
  if digits then return ("$%s \\times 10^{%d}$"):format(digits, math.tointeger(tonumber(power))) end
  return text:find "^-" and ("$%s$"):format(text) or text
end

local function cell(value, format, place)
  if value == nil then return "--" end
  if type(value) == "number" then return number_text(value, format) end
  if type(value) == "boolean" then return value and "yes" or "no" end
  if type(value) == "string" then return escaped(value) end
  raise(("latex.table: %s: expected a number, a text, true or false, got %s"):format(place, described(value)))
end

local function texts_by_column(read, key, columns)
  local given = read:get(key) or {}
  local known = {}
  for _, name in ipairs(columns) do known[name] = true end
  for name, text in pairs(given) do
    if not known[name] then read:fail("%s: '%s' is not one of the columns", key, tostring(name)) end
    if type(text) ~= "string" then read:expected(("%s.%s"):format(key, name), "a text", text) end
  end
  return given
end

local function check_formats(read, formats)
  for name, format in pairs(formats) do
    if not format:find "^%%%.?%d*[dfge]$" then read:expected("formats." .. name, "a format of one number, such as %.3f", format) end
  end
end

-- "r" if all values of the column are numbers, else "l"
local function alignments(rows, columns)
  local out = {}
  for c, name in ipairs(columns) do
    out[c] = "r"
    for _, row in ipairs(rows) do
      if row[name] ~= nil and type(row[name]) ~= "number" then out[c] = "l" end
    end
  end
  return table.concat(out)
end

local function columns_of(read, rows)
  local columns = read:get "columns"
  if columns == nil then columns = column_names("latex.table", rows) end
  for i, name in ipairs(columns) do
    if type(name) ~= "string" then read:expected(("columns[%d]"):format(i), "a name", name) end
  end
  column_names("latex.table", rows)  -- rejects rows that are not tables
  if #columns == 0 then read:fail "expected rows with columns, or `columns`, got neither" end
  return columns
end

local function body_of(rows, columns, headings, formats)
  local lines, cells = {}, {}
  for c, name in ipairs(columns) do cells[c] = headings[name] or escaped(name) end
  lines[1] = table.concat(cells, " & ") .. " \\\\\n\\midrule"
  for i, row in ipairs(rows) do
    for c, name in ipairs(columns) do cells[c] = cell(row[name], formats[name], ("rows[%d].%s"):format(i, name)) end
    lines[#lines + 1] = table.concat(cells, " & ") .. " \\\\"
  end
  return table.concat(lines, "\n")
end

--- Converts rows to the text of a LaTeX table. Columns of numbers are right-aligned; texts are escaped; missing values are dashes. The document needs the
--- package booktabs.
---@param rows table[]  rows of names and values: numbers, texts, true, false
---@param options? table  format of the table
---@option columns? string[]  names in the order of the columns; all names, sorted, by default
---@option headings? table<string, string>  headings in LaTeX that replace names of columns
---@option formats? table<string, string>  formats of numbers by column, "%.3g" by default
---@option caption? string  caption of a floating table
---@option label? string  label of a floating table, for references
---@return string
---@effect reads
--- > text = clench.latex.table({{object = "mug_2", epsilon = 0.25}, {object = "flask"}}, {columns = {"object", "epsilon"}, headings = {epsilon = "$\\epsilon$"}, formats = {epsilon = "%.3f"}})
--- > text:find("mug\\_2 & 0.250", 1, true) ~= nil, text:find("flask & --", 1, true) ~= nil  --> true, true
--- > clench.latex.table({{a = 1}}, {headings = {b = "B"}})  --> error: headings: 'b' is not one of the columns
function latex.table(rows, options)
  if type(rows) ~= "table" then raise("latex.table: rows: expected a list, got " .. described(rows)) end
  local read = read_options("latex.table", options or {})
  local columns = columns_of(read, rows)
  local headings, formats = texts_by_column(read, "headings", columns), texts_by_column(read, "formats", columns)
  check_formats(read, formats)
  local caption, label = read:get "caption", read:get "label"
  read:done()
  local text = ("\\begin{tabular}{%s}\n\\toprule\n%s\n\\bottomrule\n\\end{tabular}\n"):format(alignments(rows, columns),
    body_of(rows, columns, headings, formats))
  if not caption and not label then return text end
  local caption_line = caption and ("\\caption{%s}\n"):format(escaped(caption)) or ""
  local label_line = label and ("\\label{%s}\n"):format(label) or ""
  return ("\\begin{table}\n\\centering\n%s%s%s\\end{table}\n"):format(caption_line, label_line, text)
end

--- Writes a LaTeX table to a file. The write is atomic: after an error an existing file is unchanged.
---@param path string  file to write
---@param rows table[]  one table per row
---@param options? table  options of `clench.latex.table`
---@effect files
--- > clench.latex.write("build/table.tex", {{object = "mug", epsilon = 0.25}})
--- > clench.latex.write("no/such/folder/a.tex", {{a = 1}})  --> error: no such folder: no/such/folder
function latex.write(path, rows, options)
  if type(path) ~= "string" then raise("latex.write: path: expected a name, got " .. described(path)) end
  clench.files.save_text(path, latex.table(rows, options))
end

return require "clench.sealed"("clench.latex", latex)
