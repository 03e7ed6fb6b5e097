--- Coordinate frames over the picture: the three axes of a pose, x vermilion, y green, z blue.
local camera = require "clench.view.camera"
local handles = require "clench.view.handles"
local frames = {}

local length = 0.05  -- length of an axis [m]

--- Draws the axes of a pose.
---@param name? string  drawn at its origin
function frames.draw(view, ui, pose, name)
  local x, y = camera.project(view.camera, ui.size, pose.position)
  if not x then return end
  for i, axis in ipairs {clench.vec3(1, 0, 0), clench.vec3(0, 1, 0), clench.vec3(0, 0, 1)} do
    local to_x, to_y = camera.project(view.camera, ui.size, pose * (axis * length))
    if to_x then
      ui:line({x, y, to_x, to_y}, {color = {1, 1, 1, 0.7}, width = 5})
      ui:line({x, y, to_x, to_y}, {color = handles.colors[i], width = 3})
      ui:label(to_x + 3, to_y - 8, ("xyz"):sub(i, i), {color = handles.colors[i]})
    end
  end
  if name then handles.label(ui, x + 6, y + 6, name) end
end

return frames
