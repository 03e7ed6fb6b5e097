--- Names of all columns of a table of rows {name = value, ...}, sorted.
local described = require "clench.described"
local raise = require "clench.raise"

---@param subject string  "csv.write", for messages
---@param rows table[]
---@return string[]
return function(subject, rows)
  local seen, columns = {}, {}
  for i, row in ipairs(rows) do
    if type(row) ~= "table" then raise(("%s: rows[%d]: expected a table of names and values, got %s"):format(subject, i, described(row))) end
    for name in pairs(row) do
      if type(name) ~= "string" then raise(("%s: rows[%d]: expected names of columns as keys, got %s"):format(subject, i, described(name))) end
      if not seen[name] then seen[name], columns[#columns + 1] = true, name end
    end
  end
  table.sort(columns)
  return columns
end
