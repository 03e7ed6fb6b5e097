-- stdlib/shapes/loft.lua
local vector = require "clench.shapes.vector"
local within = require "clench.within"
local read_options = require "clench.shapes.options"
local skin = require "clench.shapes.skin"

--- The solid through a sequence of cross-sections, each a ring of points {x, y, z}. All rings have the same orientation and the same number of corresponding
--- points; the first and the last may be a single point, an apex, and are capped by flat faces otherwise.
---@param sections number[][][]  two or more rings [m]
---@return table mesh
---@effect reads
return function(sections)
  local o = read_options("loft", sections)
  local rings, count = {}, nil
  for i = 1, #sections do
    local ring = o:raw(i)
    local least = (i == 1 or i == #sections) and 1 or 3
    local name = "ring " .. i
    if type(ring) ~= "table" then o:expected(name, "a list of points", ring) end
    if #ring < 3 and #ring ~= least then o:expected(name, "a list of at least 3 points, or one at an end", ring) end
    local points = {}
    for k = 1, #ring do
      local p = vector.list(ring[k])
      points[k] = p
      for axis = 1, 3 do
        local x = type(p) == "table" and p[axis]
        if not within(x, o.largest) then
          o:expected(("%s[%d]"):format(name, k), "a point {x, y, z}", p)
        end
      end
    end
    if #ring > 1 then
      count = count or #ring
      if #ring ~= count then o:fail("ring %d must have %d points like the rings before it, got %d", i, count, #ring) end
    end
    rings[i] = points
  end
  if #rings < 2 or not count then o:fail("expected two rings or more, one of them with an area, got %d", #rings) end
  o:done()
  return skin(rings, false, "shapes.loft")
end
