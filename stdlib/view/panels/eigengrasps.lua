--- Sliders for the amplitudes of the hand's eigengrasps, each of which can be fixed; a drag is one step of undo.
local dialog = require "clench.view.dialog"
local edit = require "clench.view.edit"

-- the eigengrasps of a view's hand that are fixed
local function fixed_of(view, hand)
  view.fixed_amplitudes = view.fixed_amplitudes or {}
  view.fixed_amplitudes[hand.name] = view.fixed_amplitudes[hand.name] or {}
  return view.fixed_amplitudes[hand.name]
end

local function set(view, hand, amplitudes, fixed, rigid)
  edit.begin(view, "EigenGrasp " .. hand.name)
  local numbers = {}
  for i = 1, #amplitudes do
    if fixed[i] then numbers[#numbers + 1] = i end
  end
  -- with a fixed amplitude, the posture consists of the amplitudes only
  hand:set_amplitudes(amplitudes, {keep = not (rigid or #numbers > 0), fixed = #numbers > 0 and numbers or nil})
  view.session:emit("changed", {gesture = true})
end

local function draw_sliders(ui, view, hand)
  local eigengrasps, amplitudes, fixed = hand.eigengrasps, hand.amplitudes, fixed_of(view, hand)
  for i = 1, eigengrasps.count do
    local low, high = table.unpack(eigengrasps.limits[i])
    ui:disabled(fixed[i] == true, function(ui)
      ui:width(-104 * view.scale)
      local value, changed, finished = ui:slider(("EG %d##eigengrasp"):format(i), amplitudes[i], {min = low, max = high, format = "%.3f"})
      if changed then
        local goal = {table.unpack(amplitudes)}
        goal[i] = value
        set(view, hand, goal, fixed, view.rigid)
      end
      if finished then edit.finish(view) end
    end)
    ui:same_line()
    local on, changed = ui:checkbox("fixed##eigengrasp" .. i, fixed[i] == true)
    if changed then fixed[i] = on or nil end
  end
end

local function go_to_origin(view, hand) view:run("grasp.dofs", {hand = view:address(hand), dofs = hand.eigengrasps.origin}) end

local function draw(ui, view)
  local hand = view.session.hand
  if not hand then return ui:text("No hand is current.", {color = {0.5, 0.5, 0.5}}) end
  draw_sliders(ui, view, hand)
  local rigid, changed = ui:checkbox("rigid", view.rigid == true)
  if changed then view.rigid = rigid end
  ui:tooltip "The posture consists of the amplitudes only; otherwise the part that they do not describe is kept."
  if ui:button "Go To Origin" then go_to_origin(view, hand) end
  ui:same_line()
  dialog.button(view, ui, "Set Origin", "grasp.set_origin")
  if ui:button "Close to Contacts" then view:run("grasp.autograsp", {hand = view:address(hand)}) end
  ui:same_line()
  dialog.button(view, ui, "Use Identity", "grasp.identity_eigengrasps")
  dialog.button(view, ui, "Load…", "grasp.load_eigengrasps")
  ui:same_line()
  dialog.button(view, ui, "Save…", "grasp.save_eigengrasps")
end

return {name = "EigenGrasps", place = "right", tab = true, draw = draw}
