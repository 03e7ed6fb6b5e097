local printable = require "clench.printable"

--- Prints rows of text in columns for a terminal.
---@param rows string[][]
---@param indent string  before each row
return function(rows, indent)
  local widths = {}
  for _, row in ipairs(rows) do
    for i, cell in ipairs(row) do widths[i] = math.max(widths[i] or 0, utf8.len(cell) or #cell) end
  end
  for _, row in ipairs(rows) do
    local cells = {}
    for i, cell in ipairs(row) do cells[i] = i < #row and cell .. (" "):rep(widths[i] - (utf8.len(cell) or #cell)) or cell end
    print(printable((indent .. table.concat(cells, "  ")):gsub("%s+$", "") .. ""))
  end
end
