-- stdlib/shapes/axis.lua
--- Position of a shape with an axis: a length along z, centered on the origin, or the two end points of its axis.
local vector = require "clench.shapes.vector"
local mesh = require "clench.shapes.mesh"

--- Reads `size` (the option that gives the length), or `from` and `to`.
---@return number length, fun(mesh: table): table place  moves a mesh that starts at z = 0 and rises along +z
return function(o, size)
  local length, from, to = o:raw(size), o:point "from", o:point "to"
  if length ~= nil and (from or to) or (from == nil) ~= (to == nil) or not (length or from) then
    local got = {}
    for _, name in ipairs {size, "from", "to"} do
      if o:raw(name) ~= nil then got[#got + 1] = name end
    end
    o:fail("expected either %s or both from and to, got %s", size, #got > 0 and table.concat(got, " and ") or "neither")
  end
  if length ~= nil then
    length = o:get(size)
    return length, function(shape)
      return mesh.map(shape, function(p) return {p[1], p[2], p[3] - length / 2} end, o.subject)
    end
  end
  local along = vector.sub(to, from)
  local z = vector.unit(along)
  if not z then o:fail("from and to must be apart, got {%.6g, %.6g, %.6g} twice", from[1], from[2], from[3]) end
  local x, y = vector.frame(z)
  return vector.norm(along), function(shape)
    return mesh.map(shape, function(p)
      return vector.along(vector.along(vector.along(from, p[1], x), p[2], y), p[3], z)
    end, o.subject)
  end
end
