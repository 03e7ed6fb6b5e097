--- Asks about unsaved changes before the world is replaced or the program ends.
local ask_path = require "clench.view.ask_path"
local leave = {}

--- Calls a function that closes the world: at once if nothing is unsaved, otherwise after the question.
---@param view table
---@param purpose "exit"|"new"|"open"
---@param go fun()  closes the world
function leave.ask(view, purpose, go)
  if not view.session:is_modified() then return go() end
  view.leaving = {purpose = purpose, go = go}
  view:changed()
end

local function finish(view)
  local go = view.leaving.go
  view.leaving = nil
  go()
end

-- saves to the file of the world, or asks for one
local function save(view)
  local session, leaving = view.session, view.leaving
  if session.path then
    local ok, message = pcall(session.run, session, "world.save", {})
    if ok then return finish(view) end
    leaving.error = tostring(message)
    return
  end
  view.leaving = nil
  ask_path.open(view, "Save World", "world.wld", "world.save_as", function(path)
    session:run("world.save_as", {path = path})
    view.leaving = leaving
    finish(view)
  end)
end

--- Draws the question, if it is open.
function leave.draw(view, ui)
  local leaving = view.leaving
  if not leaving then return end
  ui:window("Unsaved changes", {width = 0, modal = true}, function(ui)
    ui:text(("%s has changed since it was saved."):format(view.session.path or "The world"))
    if leaving.error then ui:text(leaving.error, {color = {0.84, 0.37, 0}}) end
    if ui:button "Save" then save(view) end
    ui:same_line()
    if ui:button "Don't Save" then finish(view) end
    ui:same_line()
    if ui:button "Cancel##leave" then view.leaving = nil end
  end)
end

return leave
