-- stdlib/suggest.lua
--- "; did you mean 'count'?": the nearest of the known names to one that is unknown, or "" when none is near, by the engine's rule.
---@param name any  nothing is near what is no string
---@param known string[]
---@return string

-- single-character edits (insert, drop, exchange, swap of neighbours) from a to b, without regard to case
local function edit_distance(a, b)
  a, b = a:lower(), b:lower()
  local before, last = {}, {}
  for j = 0, #b do last[j] = j end
  for i = 1, #a do
    local row = {[0] = i}
    for j = 1, #b do
      local same = a:byte(i) == b:byte(j)
      row[j] = math.min(last[j] + 1, row[j - 1] + 1, last[j - 1] + (same and 0 or 1))
      if i > 1 and j > 1 and a:byte(i) == b:byte(j - 1) and a:byte(i - 1) == b:byte(j) then
        row[j] = math.min(row[j], before[j - 2] + 1)
      end
    end
    before, last = last, row
  end
  return last[#b]
end

local longest = 40  -- of what a person mistypes

return function(name, known)
  if type(name) ~= "string" or #name < 3 or #name > longest then return "" end
  -- a slip is at most a third of the letters
  local limit = math.min(#name // 3, 3)
  local best, nearest = limit + 1, nil
  for _, candidate in ipairs(known) do
    local edits = candidate ~= name and edit_distance(name, candidate) or best
    if edits < best then best, nearest = edits, candidate end
  end
  return nearest and ("; did you mean '%s'?"):format(nearest) or ""
end
