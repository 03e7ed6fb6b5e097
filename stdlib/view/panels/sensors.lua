--- Devices: their states and readings, and buttons of the commands that connect them, move hands by them and calibrate a glove.
local birds = require "clench.session.birds"
local dialog = require "clench.view.dialog"
local real_hands = require "clench.session.real_hands"
local serial_lines = require "clench.session.serial_lines"
local units = require "clench.view.units"

local gray, orange = {0.5, 0.5, 0.5}, {0.84, 0.37, 0}

local function button(view, ui, label, name)
  dialog.button(view, ui, label .. "##" .. name, "sensors." .. name)
end

local function pose_text(view, pose)
  local p, angles = pose.position, pose.rpy
  return ("%s, %s, %s\n%s, %s, %s"):format(units.text(view, p.x, "m"), units.text(view, p.y, "m"), units.text(view, p.z, "m"), units.text(view, angles[1], "rad"),
                                           units.text(view, angles[2], "rad"), units.text(view, angles[3], "rad"))
end

-- texts of readings, in a few lines
local shown = {
  glove = function(_, raw)
    local lines = {}
    for i = 1, #raw, 8 do lines[#lines + 1] = table.concat(raw, " ", i, math.min(i + 7, #raw)) end
    return table.concat(lines, "\n")
  end,
  tracker = function(view, poses)
    local lines = {}
    for bird, pose in ipairs(poses) do
      local one = birds.of(view.session, bird)
      local name = one and one.target == "hand" and view.session.hand and view.session.hand.name or one and one.target
      lines[bird] = ("bird %d: %s\n%s"):format(bird, one and ("%s, %s"):format(name, one.mode) or "moves nothing", pose_text(view, pose))
    end
    return table.concat(lines, "\n")
  end,
  hand = function(view, values)
    local unit = real_hands.drivers[view.session.sensors.hand.options.driver].fractions and "1" or "rad"
    local texts = {}
    for i, value in ipairs(values) do texts[i] = units.text(view, value, unit) end
    return table.concat(texts, ", ")
  end,
}

local function draw_device(view, ui, title, kind)
  local sensor = view.session.sensors[kind]
  ui:spacing()
  ui:text(title)
  ui:same_line()
  if not sensor then return button(view, ui, "Connect…", "connect_" .. kind) end
  if ui:button("Disconnect##" .. kind) then view:run("sensors.disconnect", {device = kind}) end
  local driver = kind == "hand" and real_hands.drivers[sensor.options.driver].title .. ", " or ""
  ui:text(("%s%s, %s"):format(driver, sensor.state, sensor.path), {color = gray})
  if sensor.problem then ui:text(sensor.problem, {color = orange, wrap = true}) end
  if sensor.reading then ui:text(shown[kind](view, sensor.reading), {wrap = true}) end
end

local hint_interval = 2  -- between two searches for serial lines [s]

-- without any device: the lines to which one could be connected
local function draw_hint(view, ui)
  local connected = view.session.sensors
  if connected.glove or connected.tracker or connected.hand then return end
  local now = clench.loop.time()
  if not view.lines_hint or now > view.lines_hint.time + hint_interval then view.lines_hint = {time = now, text = serial_lines.hint()} end
  ui:text("serial lines: " .. view.lines_hint.text, {color = gray, wrap = true})
end

local function draw_motion(view, ui)
  ui:spacing()
  button(view, ui, "Move Hand", "apply")
  ui:same_line()
  button(view, ui, view.session.following and "Stop Following" or "Follow", "follow")
  button(view, ui, "Tracker Mode…", "tracker_mode")
end

-- residuals of a calibration: the largest one and its DOF, and that of fingertips; nil: it was read from a file
local function residual_text(view, calibration)
  if calibration.tips then return ("fingertips within %s"):format(units.text(view, calibration.tips.max, "m")) end
  local largest, dof
  for d = 1, calibration.report and #calibration.slopes or 0 do
    local row = calibration.report[d]
    if row and not (largest and largest >= row.max) then largest, dof = row.max, d end
  end
  return dof and ("residuals within %s (DOF %d)"):format(units.text(view, largest, "rad"), dof)
end

local function posture_text(postures)
  local tips = 0
  for _, posture in ipairs(postures) do tips = tips + (posture.distance and 1 or 0) end
  return ("%d postures%s"):format(#postures, tips > 0 and (", %d of fingertips"):format(tips) or "")
end

local function draw_calibration(view, ui)
  local state = view.session.sensors
  ui:spacing()
  ui:text(("%s, %s"):format(posture_text(state.postures), state.calibration and "calibrated" or "not calibrated"), {color = gray})
  button(view, ui, "Record…", "record_posture")
  ui:same_line()
  button(view, ui, "Clear", "clear_postures")
  button(view, ui, "Calibrate…", "calibrate")
  ui:same_line()
  button(view, ui, "Fingertips…", "calibrate_tips")
  button(view, ui, "Load…", "load_calibration")
  ui:same_line()
  button(view, ui, "Save…", "save_calibration")
  local text = state.calibration and residual_text(view, state.calibration)
  if text then ui:text(text, {color = gray}) end
end

local function draw(ui, view)
  draw_hint(view, ui)
  draw_device(view, ui, "Glove", "glove")
  draw_calibration(view, ui)
  draw_device(view, ui, "Tracker", "tracker")
  draw_motion(view, ui)
  draw_device(view, ui, "Real hand", "hand")
  button(view, ui, "From Real Hand", "pull")
  ui:same_line()
  button(view, ui, "To Real Hand…", "push")
  ui:same_line()
  button(view, ui, "Stop", "stop")
end

return {name = "Sensors", place = "right", tab = true, tall = true, draw = draw}
