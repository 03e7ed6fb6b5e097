--- Tables of results as comma-separated values (RFC 4180) that preserve types: numbers are read back bit-exactly, integers as integers, and text that looks
--- like a number is quoted.
local raise = require "clench.raise"
local column_names = require "clench.column_names"
local described = require "clench.described"
local on_behalf_of = require "clench.on_behalf_of"
local read_options = require "clench.options"
local csv = {}

-- the value of a field without quotes; text that is not another value is returned unchanged
local function plain_value(word)
  if word == "" then return nil end
  if word == "true" then return true end
  if word == "false" then return false end
  if word == "nan" then return 0 / 0 end
  if word == "inf" or word == "-inf" then return word == "inf" and math.huge or -math.huge end
  if word:find "^[%+%-]?%.?%d[%w%.%+%-]*$" and not word:find "[xX]" then return tonumber(word) or word end
  return word
end

local function field(value, separator, place)
  if value == nil then return "" end
  if math.type(value) == "integer" then return ("%d"):format(value) end
  if type(value) == "number" then
    if value ~= value then return "nan" end
    if value - value ~= 0 then return value > 0 and "inf" or "-inf" end
    local short = ("%.15g"):format(value)
    if tonumber(short) ~= value then short = ("%.17g"):format(value) end
    return short:find "[%.en]" and short or short .. ".0"
  end
  if type(value) == "boolean" then return tostring(value) end
  if type(value) == "string" then return clench.files.csv_text(value, separator) end
  raise(("csv.write: %s: expected a number, a text, true or false, got %s"):format(place, described(value)))
end

local function check_columns(rows, columns)
  local known = {}
  for i, name in ipairs(columns) do
    if type(name) ~= "string" then raise(("csv.write: columns[%d]: expected a name, got %s"):format(i, described(name))) end
    if known[name] then raise(("csv.write: column '%s' appears twice"):format(name)) end
    known[name] = true
  end
  for _, name in ipairs(column_names("csv.write", rows)) do
    if not known[name] then raise(("csv.write: rows have '%s', which is not one of the columns"):format(name)) end
  end
end

local function separator_of(read)
  local separator = read:get "separator"
  if separator ~= "," and separator ~= ";" and separator ~= "\t" then
    read:expected("separator", "',', ';' or a tab", separator)
  end
  return separator
end

--- Writes rows to a file. The write is atomic: after an error an existing file is unchanged.
---@param path string  file to write
---@param rows table[]  rows of names and values: numbers, texts, true, false; missing values give empty cells
---@param options? table  format of the file
---@option columns? string[]  names in the order of the columns; all names, sorted, by default
---@option separator? string = ","  separator of cells: ",", ";" or a tab
---@effect files
--- > clench.csv.write("build/table.csv", {{object = "mug", epsilon = 0.25}, {object = "flask", note = "7"}})
--- > rows = clench.csv.read "build/table.csv"
--- > table.concat(rows.columns, " ")  --> epsilon note object
--- > rows[1].epsilon, rows[2].epsilon, rows[2].note  --> 0.25, nil, 7
--- > clench.csv.write("no/such/folder/a.csv", {{a = 1}})  --> error: no such folder: no/such/folder
function csv.write(path, rows, options)
  if type(path) ~= "string" then raise("csv.write: path: expected a name, got " .. described(path)) end
  if type(rows) ~= "table" then raise("csv.write: rows: expected a list, got " .. described(rows)) end
  local read = read_options("csv.write", options or {})
  local separator = separator_of(read)
  local columns = read:get "columns"
  read:done()
  if columns ~= nil and type(columns) ~= "table" then raise("csv.write: columns: expected a list of names, got " .. described(columns)) end
  if columns then check_columns(rows, columns) end
  columns = columns or column_names("csv.write", rows)
  if #columns == 0 then raise("csv.write: expected rows with columns, or `columns`, got neither") end
  local lines, cells = {}, {}
  for c, name in ipairs(columns) do cells[c] = clench.files.csv_text(name, separator) end
  lines[1] = table.concat(cells, separator)
  for i, row in ipairs(rows) do
    for c, name in ipairs(columns) do cells[c] = field(row[name], separator, ("rows[%d].%s"):format(i, name)) end
    lines[i + 1] = table.concat(cells, separator)
  end
  clench.files.save_text(path, table.concat(lines, "\n") .. "\n")
end

--- Reads a CSV file, also of other programs: numbers, true and false as values, quoted cells as text, empty cells as nil.
---@param path string  file to read
---@param options? table  format and location of the file
---@option separator? string = ","  separator of cells: ",", ";" or a tab
---@option confine? string  folder that must contain the file, directly or in subfolders
---@return table[] rows  rows of names and values; the field `columns` has the names in order
---@effect files
--- > clench.csv.read "no/such.csv"  --> error: no/such.csv
function csv.read(path, options)
  if type(path) ~= "string" then raise("csv.read: path: expected a name, got " .. described(path)) end
  local read = read_options("csv.read", options or {})
  local separator, confine = separator_of(read), read:get "confine"
  read:done()
  local text = on_behalf_of("csv.read", clench.files.read_text, path, {confine = confine})
  local name = path:match "[^/]+$" or path
  local function fail(line, format, ...) raise(("csv.read: %s:%d: " .. format):format(name, line, ...)) end
  local all = on_behalf_of("csv.read", clench.files.csv_records, name, text, separator)
  local header = table.remove(all, 1)
  if not header then fail(1, "expected names of columns, got an empty file") end
  local rows, known = {columns = {}}, {}
  for c, column in ipairs(header) do
    if known[column] then fail(1, "column '%s' appears twice", column) end
    known[column], rows.columns[c] = true, column
  end
  for i, record in ipairs(all) do
    all[i] = false  -- lets the memory be freed early
    -- an empty line is not a row
    local is_empty = #record == 1 and record[1] == "" and not record.quoted[1]
    if not (is_empty and #header > 1) then
      if #record ~= #header then fail(record.line, "expected %d cells, got %d", #header, #record) end
      local row = {}
      for c, column in ipairs(rows.columns) do
        if record.quoted[c] then row[column] = record[c] else row[column] = plain_value(record[c]) end
      end
      rows[#rows + 1] = row
    end
  end
  return rows
end

return require "clench.sealed"("clench.csv", csv)
