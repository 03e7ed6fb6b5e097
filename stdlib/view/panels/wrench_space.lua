--- The wrench space of the current grasp, projected to three of its coordinates.
local projections = require "clench.view.projections"

local function draw(ui, view)
  view.projection = view.projection or projections.new "panel"
  if ui:button "Open in a Window" then projections.open(view, view.projection) end
  ui:tooltip "Several windows can be open, with other coordinates each."
  projections.draw(view, ui, view.projection, 240)
end

return {name = "Wrench Space", place = "right", tab = true, draw = draw}
