--- A text that is equal for worlds with the same bodies and shapes, wherever they are.
local fingerprint = require "clench.fingerprint"

---@param world world
---@return string
return function(world)
  local parts = {}
  for i, body in ipairs(world.bodies) do
    local mesh = body.visual_mesh
    parts[i] = ("%s\0%s\0%s"):format(body.name, body.kind, mesh and mesh.fingerprint or "")
  end
  return fingerprint(table.concat(parts, "\0"))
end
