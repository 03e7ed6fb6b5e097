--- Linear least squares by Householder's method, for few unknowns.
local least_squares = {}

-- makes the entries of column c below the diagonal zero, and transforms the right side accordingly
local function eliminate(a, b, c)
  local norm = 0
  for r = c, #a do norm = norm + a[r][c] ^ 2 end
  norm = math.sqrt(norm)
  if norm == 0 then return end
  local alpha = a[c][c] > 0 and -norm or norm
  local v, vv = {}, 0
  for r = c, #a do
    v[r] = a[r][c] - (r == c and alpha or 0)
    vv = vv + v[r] ^ 2
  end
  local function reflect(get, set)
    local dot = 0
    for r = c, #a do dot = dot + v[r] * get(r) end
    for r = c, #a do set(r, get(r) - 2 * dot / vv * v[r]) end
  end
  for k = c, #a[1] do reflect(function(r) return a[r][k] end, function(r, x) a[r][k] = x end) end
  reflect(function(r) return b[r] end, function(r, x) b[r] = x end)
end

--- Solves a x = b in the least-squares sense. Both are overwritten.
---@param a number[][]  rows, at least as many as columns
---@param b number[]
---@return number[]? x  nil: the columns are linearly dependent
---@return integer? column  the first that is a combination of those before it
function least_squares.solve(a, b)
  local columns = #a[1]
  local largest = 0
  for _, row in ipairs(a) do
    for _, x in ipairs(row) do largest = math.max(largest, math.abs(x)) end
  end
  for c = 1, columns do
    eliminate(a, b, c)
    if not (math.abs(a[c][c]) > 1e-10 * largest) then return nil, c end
  end
  local x = {}
  for c = columns, 1, -1 do
    local sum = b[c]
    for k = c + 1, columns do sum = sum - a[c][k] * x[k] end
    x[c] = sum / a[c][c]
  end
  return x
end

return least_squares
