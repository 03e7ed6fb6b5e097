--- Facts of the open world, which the inspector shows while nothing is selected.
local units = require "clench.view.units"
local facts = {}

local gray = {0.5, 0.5, 0.5}

local function counted(list, word) return ("%d %s%s"):format(#list, word, #list == 1 and "" or "s") end

-- name and text of each fact
local function rows_of(view)
  local session, world = view.session, view.session.world
  local g, dofs = world.gravity, 0
  for _, robot in ipairs(world.robots) do dofs = dofs + #robot.dofs end
  return {
    {"file", session.path or "not saved yet"},
    {"robots", ("%s, %s"):format(counted(world.robots, "robot"), ("%d DOF%s"):format(dofs, dofs == 1 and "" or "s"))},
    {"bodies", ("%s, %s"):format(counted(world.objects, "object"), counted(world.obstacles, "obstacle"))},
    {"hand", session.hand and session.hand.name or "none"},
    {"object", session.object and ("%s, %.4g kg"):format(session.object.name, session.object.mass) or "none"},
    {"gravity", ("%g, %g, %g m/s²"):format(g.x, g.y, g.z)},
    {"time", ("%.3f s, in steps of %g s"):format(world.time, world.time_step)},
    {"touch", "within " .. units.text(view, world.contact_threshold, "m")},
    {"units", ("%s, %s (menu View)"):format(view.units.length, view.units.angle == "deg" and "degrees" or "rad")},
  }
end

--- Draws the facts, and how to select something.
function facts.draw(view, ui)
  if not view.session.world then return ui:text("No world is open: File/Open…, or drop a file on the window.", {color = gray, wrap = true}) end
  for _, row in ipairs(rows_of(view)) do
    ui:text(row[1], {color = gray})
    ui:same_line()
    ui:text(row[2], {wrap = true})
  end
  ui:spacing()
  ui:text("Nothing is selected: click in the tree, or in the picture with the tool Select.", {color = gray, wrap = true})
end

return facts
