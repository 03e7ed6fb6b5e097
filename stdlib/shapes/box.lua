-- stdlib/shapes/box.lua
local read_options = require "clench.shapes.options"

local corners = {{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1}, {-1, -1, 1}, {1, -1, 1}, {1, 1, 1}, {-1, 1, 1}}
local faces = {{1, 4, 3, 2}, {5, 6, 7, 8}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 4, 8, 7}, {4, 1, 5, 8}}

--- A box centered on the origin, with sharp, chamfered or rounded edges.
---@param options table  {x, y, z, ...} or by name
---@option x number [m, > 0]  size along x
---@option y number [m, > 0]  size along y
---@option z number [m, > 0]  size along z
---@option chamfer? number [m, >= 0] = 0  width of the chamfers on each face
---@option rounding? number [m, >= 0] = 0  radius of the edges
---@option segments? integer [1 to 64] = 4  segments per quarter turn of a rounding
---@return table mesh
---@effect reads
return function(options)
  local o = read_options("box", options, {"x", "y", "z"})
  local x, y, z = o:get "x", o:get "y", o:get "z"
  local chamfer, rounding = o:get "chamfer", o:get "rounding"
  local segments = o:get "segments"
  o:done()
  if chamfer > 0 and rounding > 0 then o:fail "expected chamfer or rounding, got both" end
  if chamfer + rounding > 0 then
    local least = math.min(x, y, z)
    if 2 * (chamfer + rounding) > least * (1 + 1e-12) then
      o:fail("%s must be at most half of the smallest size, %.6g, got %.6g", chamfer > 0 and "chamfer" or "rounding",
             0.5 * least, chamfer + rounding)
    end
    return require "clench.shapes.rounded_box" {x, y, z, rounding = chamfer + rounding,
                                                segments = chamfer > 0 and 1 or segments}
  end
  local vertices, triangles = {}, {}
  for i, c in ipairs(corners) do vertices[i] = {c[1] * x / 2, c[2] * y / 2, c[3] * z / 2} end
  for _, f in ipairs(faces) do
    triangles[#triangles + 1] = {f[1], f[2], f[3]}
    triangles[#triangles + 1] = {f[1], f[3], f[4]}
  end
  return {vertices = vertices, triangles = triangles}
end
