--- The table of a search for papers: LaTeX or comma-separated values.

local columns = {"number", "epsilon", "load", "perturbed", "contacts", "azimuth", "elevation", "held"}
local headings = {number = "\\#", epsilon = "$\\epsilon$", load = "load [weights]", perturbed = "perturbed $\\epsilon$",
                  azimuth = "azimuth [$^\\circ$]", elevation = "elevation [$^\\circ$]", held = "held in, of 6"}
local formats = {epsilon = "%.4f", load = "%.1f", perturbed = "%.4f"}

-- the columns in which at least one row has a value
local function filled(rows)
  local list = {}
  for _, name in ipairs(columns) do
    local some = false
    for _, row in ipairs(rows) do some = some or row[name] ~= nil end
    if some then list[#list + 1] = name end
  end
  return list
end

local function chosen(texts, names)
  local out = {}
  for _, name in ipairs(names) do out[name] = texts[name] end
  return out
end

---@param path string  .tex or .csv
---@param rows table[]  of report_rows
---@param caption string
return function(path, rows, caption)
  local names = filled(rows)
  if path:lower():match "%.csv$" then return clench.csv.write(path, rows, {columns = names}) end
  clench.latex.write(path, rows, {columns = names, headings = chosen(headings, names), formats = chosen(formats, names), caption = caption})
end
