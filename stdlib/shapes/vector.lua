-- stdlib/shapes/vector.lua
--- Vectors of three numbers, with the operations that shapes need.
local vector = {list = require "clench.coordinates"}

function vector.add(a, b) return {a[1] + b[1], a[2] + b[2], a[3] + b[3]} end
--- a - b in floats: products of integers would wrap around
function vector.sub(a, b) return {a[1] - b[1] + 0.0, a[2] - b[2] + 0.0, a[3] - b[3] + 0.0} end
function vector.scale(a, k) return {k * a[1], k * a[2], k * a[3]} end
function vector.dot(a, b) return a[1] * b[1] + a[2] * b[2] + a[3] * b[3] end
function vector.norm(a) return math.sqrt(vector.dot(a, a)) end

--- a + k b
function vector.along(a, k, b) return {a[1] + k * b[1], a[2] + k * b[2], a[3] + k * b[3]} end

function vector.cross(a, b)
  return {a[2] * b[3] - a[3] * b[2], a[3] * b[1] - a[1] * b[3], a[1] * b[2] - a[2] * b[1]}
end

--- The unit vector along a; nil if a has no direction.
function vector.unit(a)
  local length = vector.norm(a)
  if not (length > 0) then return nil end
  return vector.scale(a, 1 / length)
end

--- Two unit vectors that form a right-handed frame x, y, z with the unit vector z.
function vector.frame(z)
  local least, axis = math.huge, nil
  for k = 1, 3 do
    if math.abs(z[k]) < least - 1e-9 then
      least, axis = math.abs(z[k]), {0, 0, 0}
      axis[k] = 1
    end
  end
  local x = vector.unit(vector.along(axis, -vector.dot(axis, z), z))
  return x, vector.cross(z, x)
end

--- Rotates a about a unit axis by an angle [rad].
function vector.turn(a, axis, angle)
  local c, s = math.cos(angle), math.sin(angle)
  local part = vector.scale(axis, vector.dot(a, axis) * (1 - c))
  return vector.add(vector.along(part, c, a), vector.scale(vector.cross(axis, a), s))
end

return vector
