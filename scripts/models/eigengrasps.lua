-- scripts/models/eigengrasps.lua
--- Text of an eigengrasp file (.egr): directions in the space of the DOFs, and their initial posture.

local function line(numbers)
  local out = {}
  for i, x in ipairs(numbers) do out[i] = ("%.6g"):format(x) end
  return table.concat(out, " ")
end

--- directions orthogonalized one after the other, each of unit length
--- source  Golub & Van Loan, Matrix Computations, 5.2: modified Gram-Schmidt
local function orthonormal(directions)
  local out = {}
  for i, given in ipairs(directions) do
    local v = table.move(given, 1, #given, 1, {})
    for _, u in ipairs(out) do
      local dot = 0
      for k, x in ipairs(u) do dot = dot + x * v[k] end
      for k, x in ipairs(u) do v[k] = v[k] - dot * x end
    end
    local n = 0
    for _, x in ipairs(v) do n = n + x * x end
    if n < 1e-6 then error(("eigengrasp %d depends on those before it"):format(i), 0) end
    for k, x in ipairs(v) do v[k] = x / math.sqrt(n) end
    out[i] = v
  end
  return out
end

---@param e {origin: number[], [integer]: {value: number, [integer]: number}}  origin in degrees or mm, of each DOF; directions of any length; value:
---share of the variance, or 1
---@param slides? boolean[]  prismatic DOFs, which are in meters in the file
return function(e, slides)
  local origin = {}
  for i, x in ipairs(e.origin) do origin[i] = slides and slides[i] and x * 1e-3 or math.rad(x) end
  local out = {"DIMENSIONS " .. #origin}
  for i, direction in ipairs(orthonormal(e)) do
    if #e[i] ~= #origin then error(("eigengrasp %d: expected %d numbers, got %d"):format(i, #origin, #e[i]), 0) end
    table.move({"EG", ("%g"):format(e[i].value or 1), line(direction)}, 1, 3, #out + 1, out)
  end
  table.move({"ORIGIN", "0", line(origin), ""}, 1, 4, #out + 1, out)
  return table.concat(out, "\n")
end
