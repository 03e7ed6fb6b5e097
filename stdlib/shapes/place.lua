-- stdlib/shapes/place.lua
--- Transforms of shapes: translation, rotation, scaling and reflection. Each returns a new mesh and leaves the given one unchanged.
local raise = require "clench.raise"
local described = require "clench.described"
local mesh = require "clench.shapes.mesh"
local vector = require "clench.shapes.vector"
local within = require "clench.within"
local place = {}

local function check_vector(subject, what, v)
  local function expected(got)
    raise(("%s: %s must be {x, y, z} of at most %g, got %s"):format(subject, what, mesh.largest, described(got)))
  end
  v = vector.list(v)
  if type(v) ~= "table" then expected(v) end
  for k = 1, 3 do
    if not within(v[k], mesh.largest) then expected(v[k]) end
  end
  return v
end

--- Translates a shape by an offset.
---@param shape table  mesh as functions of clench.shapes return it
---@param offset number[]  {x, y, z} [m]
---@return table mesh
---@effect reads
function place.move(shape, offset)
  shape = mesh.check(shape, "shapes.move")
  offset = check_vector("shapes.move", "the offset", offset)
  return mesh.map(shape, function(p) return vector.add(p, offset) end, "shapes.move")
end

--- Rotates a shape about an axis through a point.
---@param shape table  mesh in the form of clench.shapes
---@param axis number[]  {x, y, z}, of any length
---@param angle number  right-handed [rad]
---@param about? number[]  a point of the axis, the origin by default [m]
---@return table mesh
---@effect reads
function place.turn(shape, axis, angle, about)
  shape = mesh.check(shape, "shapes.turn")
  local unit = vector.unit(check_vector("shapes.turn", "the axis", axis))
  if not unit then raise("shapes.turn: the axis must have a length, got {0, 0, 0}") end
  if type(angle) ~= "number" or angle ~= angle or math.abs(angle) == math.huge then
    raise("shapes.turn: the angle must be a finite number, got " .. described(angle))
  end
  local center = about and check_vector("shapes.turn", "the point", about) or {0, 0, 0}
  return mesh.map(shape, function(p)
    return vector.add(center, vector.turn(vector.sub(p, center), unit, angle))
  end, "shapes.turn")
end

--- Scales a shape about the origin, by one factor or by one per axis.
---@param shape table  mesh as functions of clench.shapes return it
---@param factor number|number[]  > 0
---@return table mesh
---@effect reads
function place.scale(shape, factor)
  shape = mesh.check(shape, "shapes.scale")
  factor = vector.list(factor)
  local k = type(factor) == "table" and factor or {factor, factor, factor}
  for i = 1, 3 do
    if type(k[i]) ~= "number" or not (k[i] > 0 and k[i] < math.huge) then
      raise("shapes.scale: the factor must be > 0, got " .. described(k[i]))
    end
  end
  return mesh.map(shape, function(p) return {k[1] * p[1], k[2] * p[2], k[3] * p[3]} end, "shapes.scale")
end

--- Reflects a shape in the plane through the origin perpendicular to an axis.
---@param shape table  mesh as functions of clench.shapes return it
---@param axis "x"|"y"|"z"  axis whose coordinates change sign
---@return table mesh
---@effect reads
function place.mirror(shape, axis)
  shape = mesh.check(shape, "shapes.mirror")
  local place_of = ({x = 1, y = 2, z = 3})[axis]
  if not place_of then raise("shapes.mirror: the axis must be 'x', 'y' or 'z', got " .. described(axis)) end
  return mesh.flip(mesh.map(shape, function(p)
    local q = {p[1], p[2], p[3]}
    q[place_of] = -q[place_of]
    return q
  end, "shapes.mirror"))
end

return place
