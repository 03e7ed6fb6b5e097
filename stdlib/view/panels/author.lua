--- Authors grasps: frames, pregrasp, closing phases, a tug test, name, confidence and notes; the list of authored grasps is saved in any format.
local ask_path = require "clench.view.ask_path"
local edit = require "clench.view.edit"
local frames = require "clench.view.frames"
local phases = require "clench.session.phases"
local replay = require "clench.view.replay"
local stereo = require "clench.view.stereo"
local units = require "clench.view.units"

local gray, orange = {0.5, 0.5, 0.5}, {0.84, 0.37, 0}

-- the first of grasp_1, grasp_2, … that is not used
local function free_name(session)
  local taken = {}
  for _, grasp in ipairs(session.authored or {}) do taken[grasp.labels.name or ""] = true end
  local i = 1
  while taken["grasp_" .. i] do i = i + 1 end
  return "grasp_" .. i
end

local function heading(ui, text, tip)
  ui:spacing()
  ui:text(text, {color = gray})
  if tip then ui:tooltip(tip) end
end

local function place_of(session)
  local hand, object = session.hand, session.object
  return {pose = object.pose:inverse() * hand.pose, dofs = hand.dofs}
end

local function draw_frames(view, ui, state)
  local session = view.session
  local hand, object = session.hand, session.object
  heading(ui, "Frames", "The pose of a grasp is that of the hand's base in the object's frame.")
  state.frames = ui:checkbox("show frames", state.frames ~= false)
  if state.frames then
    stereo.over(view, ui, function()
      for _, thing in ipairs {object, hand} do
        local there = replay.shown(view, thing)
        if there then frames.draw(view, ui, there.pose, thing.name) end
      end
    end)
  end
  local pose = place_of(session).pose
  local p, angles = pose.position, pose.rpy
  ui:text(("%s, %s, %s"):format(units.text(view, p.x, "m"), units.text(view, p.y, "m"), units.text(view, p.z, "m")))
  ui:tooltip "Position of the hand in the object"
  ui:text(("%s, %s, %s"):format(units.text(view, angles[1], "rad"), units.text(view, angles[2], "rad"), units.text(view, angles[3], "rad")))
  ui:tooltip "Roll, pitch and yaw of the hand in the object"
end

local function show_pregrasp(view, state, phases)
  return view:run("grasp.close_in_phases", {pregrasp = state.pregrasp, phases = phases})
end

local function draw_pregrasp(view, ui, state)
  heading(ui, "Pregrasp", "The hand before it approaches and closes")
  if ui:button "Set Pregrasp" then state.pregrasp = place_of(view.session) end
  ui:tooltip "The present pose in the object, and the present DOFs"
  ui:same_line()
  ui:disabled(not state.pregrasp, function(ui)
    if ui:button "Show Pregrasp" then show_pregrasp(view, state, {}) end
  end)
end

-- a row of the list; returns true if the phase is to be removed
local function draw_phase(view, ui, phase, i)
  local dropped = ui:button("x##phase" .. i)
  ui:tooltip "Remove this phase"
  ui:same_line()
  ui:text(("%d  %s%s"):format(i, phase.kind, phase.kind == "approach" and " by" or phase.kind == "posture" and (" of %d DOFs"):format(#phase.dofs) or ""))
  if phase.kind ~= "approach" then return dropped end
  local factor, unit, format = units.of(view, "m")
  ui:same_line()
  ui:width(80 * view.scale)
  local value = edit.number(view, ui, ("%s##phase%d"):format(unit, i), "phase reach " .. i, phase.reach * factor, {speed = factor * 1e-3, min = 0, max = factor * 2, format = format})
  ui:tooltip "Longest travel"
  if value then phase.reach = math.max(0, value / factor) end
  return dropped
end

local function draw_phases(view, ui, state)
  heading(ui, "Closing phases", "From the pregrasp to the grasp; each phase stops at contact.")
  local dropped
  for i, phase in ipairs(state.phases) do
    if draw_phase(view, ui, phase, i) then dropped = i end
  end
  if dropped then table.remove(state.phases, dropped) end
  local function add(phase) state.phases[#state.phases + 1] = phase end
  if ui:button "+ Approach" then add {kind = "approach", reach = 0.1} end
  ui:tooltip "Moves along the hand's approach direction until it touches"
  ui:same_line()
  if ui:button "+ Posture" then add {kind = "posture", dofs = view.session.hand.dofs} end
  ui:tooltip "Moves the DOFs to their present values"
  if ui:button "+ Close" then add {kind = "close"} end
  ui:tooltip "Closes the hand"
  ui:same_line()
  ui:disabled(#state.phases == 0, function(ui)
    if ui:button "Play Phases" then show_pregrasp(view, state, state.phases) end
  end)
  ui:tooltip(state.pregrasp and "From the pregrasp, as one step of undo" or "From the present posture, as one step of undo")
end

-- the verdict of the tug test, if nothing has moved since
local function verdict_of(view, state)
  local job = state.tug_job
  if not job or job.state ~= "done" or state.tug_hash ~= view.session.world:hash() then return nil end
  return job:result()
end

local function text_of_tug(view, state)
  local job = state.tug_job
  if not job then return "not tested" end
  if job.state == "failed" then return select(2, pcall(job.result, job)), orange end
  if job.state ~= "done" then return job.state end
  local verdict = verdict_of(view, state)
  if not verdict then return "Something has moved since." end
  if not verdict.settled.held then return "lost before the test, by the grip alone", orange end
  return ("held in %d of %d directions"):format(verdict.held, #verdict.directions), not verdict.survived and orange or {0, 0.5, 0.35}
end

local function draw_tug(view, ui, state)
  heading(ui, "Tug test", "In a copy of the world, a force pulls at the object along six directions in turn.")
  ui:width(90 * view.scale)
  local value = edit.number(view, ui, "force [N]##tug", "tug force", state.force, {speed = 0.05, min = 0.01, max = 1000, format = "%.3g"})
  if value then state.force = math.max(0.01, value) end
  ui:same_line()
  local busy = state.tug_job and (state.tug_job.state == "running" or state.tug_job.state == "queued") or false
  ui:disabled(busy, function(ui)
    if ui:button "Pull" then state.tug_job, state.tug_hash, state.tug_force = view:run("grasp.tug", {force = state.force}), view.session.world:hash(), state.force end
  end)
  local text, color = text_of_tug(view, state)
  ui:text(tostring(text), {color = color or gray, wrap = true})
end

local function add_grasp(view, state)
  local verdict = verdict_of(view, state)
  local grasp = view:run("grasp.author", {name = state.name, notes = state.notes ~= "" and state.notes or nil, confidence = state.confidence, pregrasp = state.pregrasp,
                         phases = #state.phases > 0 and state.phases or nil, tug = verdict and {force = state.tug_force, held = verdict.held}})
  if grasp then state.name = free_name(view.session) end
end

local function draw_notes(view, ui, state)
  heading(ui, "Name and notes")
  ui:width(-90 * view.scale)
  state.name = ui:text_input("name##author", state.name)
  ui:width(-90 * view.scale)
  local value, changed = ui:slider("confidence", state.confidence, {min = 0, max = 1, format = "%.2f"})
  if changed then state.confidence = math.max(0, math.min(1, value)) end
  state.notes = ui:text_input("##notes", state.notes, {lines = 3, hint = "notes"})
  ui:disabled(state.name == "", function(ui)
    if ui:button "Add Grasp" then add_grasp(view, state) end
  end)
  ui:tooltip "Adds the present grasp to the list below; one of the same name is replaced."
end

-- the phases of a grasp; none if they are damaged, which is reported
local function phases_of(view, grasp)
  local ok, list = pcall(function()
    local list = clench.json.decode(grasp.labels.phases or "[]")
    phases.check(("grasp '%s'"):format(grasp.labels.name), list)
    return list
  end)
  if ok then return list end
  view:fail(list)
  return {}
end

-- shows an authored grasp, and fills the fields with its texts
local function take(view, state, grasp)
  view:run("grasp.apply", {grasp = grasp})
  local labels = grasp.labels
  state.name, state.notes, state.confidence, state.pregrasp = labels.name or "", labels.notes or "", grasp.info.confidence or 1, grasp.pregrasp
  state.phases = phases_of(view, grasp)
end

local function draw_list(view, ui, state)
  local session = view.session
  if #(session.authored or {}) == 0 then return end
  heading(ui, "Authored grasps", "The gallery shows them, too.")
  local forgotten
  for i, grasp in ipairs(session.authored) do
    if ui:selectable(("%s  %.4f##authored%d"):format(grasp.labels.name, grasp.epsilon, i), false) then take(view, state, grasp) end
    ui:tooltip "Name and epsilon; a click shows the grasp, and its phases and notes above."
    ui:context_menu("authored" .. i, function(ui)
      if ui:menu_item "Forget" then forgotten = grasp.labels.name end
    end)
  end
  if forgotten then view:run("grasp.forget", {name = forgotten}) end
  if ui:button "Save…##author" then
    ask_path.open(view, "Save Grasps", "authored.jsonl", "grasp.save_grasps", function(path) session:run("grasp.save_grasps", {path = path, grasps = session.authored}) end)
  end
  ui:tooltip "All of them: .jsonl keeps everything; .yaml is isaac_grasp; .csv, .npz"
end

local function draw(ui, view)
  local session = view.session
  if not (session.hand and session.object) then return ui:text("A hand and an object are needed.", {color = gray, wrap = true}) end
  view.author = view.author or {phases = {}, notes = "", name = free_name(session), force = 1, confidence = 1}
  local state = view.author
  ui:text(("%s on %s"):format(session.hand.name, session.object.name))
  draw_frames(view, ui, state)
  draw_pregrasp(view, ui, state)
  draw_phases(view, ui, state)
  draw_tug(view, ui, state)
  draw_notes(view, ui, state)
  draw_list(view, ui, state)
end

return {name = "Author", place = "right", tab = true, tall = true, draw = draw}
