local described = require "clench.described"
local raise = require "clench.raise"

local subject = "devices.save_postures"

local function numbers(name, list, count)
  local words = {}
  for i = 1, count do
    local x = list[i] == nil and 0 or list[i]
    if type(x) ~= "number" or x - x ~= 0 then raise(("%s: %s[%d]: expected a finite number, got %s"):format(subject, name, i, described(x))) end
    words[i] = math.type(x) == "integer" and tostring(x) or ("%.17g"):format(x)
  end
  return table.concat(words, " ")
end

-- lines of one posture: size, distance, sensors, no map of sensors, joints, and a pose
local function lines_of(i, posture)
  local name = ("postures[%d]"):format(i)
  if type(posture) ~= "table" or type(posture.sensors) ~= "table" or #posture.sensors == 0 then
    raise(("%s: %s: expected {sensors, dofs or distance}, got %s"):format(subject, name, described(posture)))
  end
  local count, dofs, distance = #posture.sensors, posture.dofs, posture.distance
  for s, value in ipairs(posture.sensors) do
    if math.type(value) ~= "integer" then raise(("%s: %s.sensors[%d]: expected a whole number, got %s"):format(subject, name, s, described(value))) end
  end
  if dofs and #dofs > count then raise(("%s: %s: expected at most as many DOFs as sensors, %d, got %d"):format(subject, name, count, #dofs)) end
  if distance and not (type(distance) == "number" and distance >= 0 and distance < math.huge) then
    raise(("%s: %s.distance: expected a number >= 0 in m, got %s"):format(subject, name, described(distance)))
  end
  return {tostring(count), distance and ("%.17g"):format(distance * 1000) or "-1", "1 " .. numbers(name .. ".sensors", posture.sensors, count), "0",
          dofs and "1 " .. numbers(name .. ".dofs", dofs, count) or "0", "0 0 0 1", "0 0 0"}
end

--- Writes recorded postures of a glove in GraspIt!'s format, which `clench.files.glove_poses` reads: lengths become mm, and DOFs that are left out become 0.
---@param path string  file to write
---@param postures table[]  {sensors = raw values, dofs? = values of DOFs [rad], distance? = of two fingertips [m]}
---@effect files
--- > path = os.tmpname()
--- > clench.devices.save_postures(path, {{sensors = {50, 60}, dofs = {0.5, 1}}, {sensors = {70, 80}, distance = 0.017}})
--- > poses = clench.files.glove_poses(path)
--- > os.remove(path)  --> true
--- > poses[1].joints[2], poses[2].distance, poses[2].sensors[1]  --> 1.0, 0.017, 70
return function(path, postures)
  if type(path) ~= "string" or path == "" then raise(("%s: path: expected the name of a file, got %s"):format(subject, described(path))) end
  if type(postures) ~= "table" then raise(("%s: postures: expected a list of postures, got %s"):format(subject, described(postures))) end
  local lines = {tostring(#postures)}
  for i, posture in ipairs(postures) do
    for _, line in ipairs(lines_of(i, posture)) do lines[#lines + 1] = line end
  end
  clench.files.save_text(path, table.concat(lines, "\n") .. "\n")
end
