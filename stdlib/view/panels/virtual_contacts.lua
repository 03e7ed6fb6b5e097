--- Virtual contacts of the current hand: marks in the picture, and buttons that find, mark, load and save them.
local camera = require "clench.view.camera"
local dialog = require "clench.view.dialog"
local stereo = require "clench.view.stereo"

local green = {0, 0.62, 0.45, 1}

-- a dot at each virtual contact, with a line along its normal
local function draw_marks(ui, view, contacts)
  for _, contact in ipairs(contacts) do
    local x, y = camera.project(view.camera, ui.size, contact.point)
    local to_x, to_y = camera.project(view.camera, ui.size, contact.point + contact.normal * 0.012)
    if x then ui:circle(x, y, 4, {color = green, filled = true}) end
    if x and to_x then ui:line({x, y, to_x, to_y}, {color = green, width = 2}) end
  end
end

local function draw(ui, view)
  local hand = view.session.hand
  if not hand then return ui:text("No hand is current.", {color = {0.5, 0.5, 0.5}}) end
  local contacts = hand.virtual_contacts
  ui:text(("%d on %s, %s"):format(#contacts, hand.name, hand.has_own_virtual_contacts and "of a file or the user" or "found on its surface"))
  local on, changed = ui:checkbox("show", view.shows_virtual ~= false)
  if changed then view.shows_virtual = on end
  if view.shows_virtual ~= false then stereo.over(view, ui, function() draw_marks(ui, view, contacts) end) end
  dialog.button(view, ui, "Find", "grasp.find_virtual")
  ui:same_line()
  dialog.button(view, ui, "Mark Contacts", "grasp.mark_virtual")
  ui:same_line()
  dialog.button(view, ui, "Clear", "grasp.clear_virtual")
  dialog.button(view, ui, "Load…", "grasp.load_virtual")
  ui:same_line()
  dialog.button(view, ui, "Save…", "grasp.save_virtual")
end

return {name = "Virtual Contacts", place = "right", tab = true, draw = draw}
