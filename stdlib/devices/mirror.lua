local class = require "clench.class"
local described = require "clench.described"
local loop = clench.loop
local new_options = require "clench.options"
local raise = require "clench.raise"

local subject = "devices.mirror"
local Mirror = class "mirror"

function Mirror:__tostring() return ("mirror of %s at %s"):format(self.hand.name, tostring(self.device)) end

-- values of the real hand; those that a driver returns are checked
local function read_device(self)
  local device = self.device
  local method = device.read_positions and "read_positions" or "read"
  local values = device[method](device)
  if type(values) ~= "table" or #values ~= #self.dofs then
    raise(("%s: device: expected %d numbers from %s, got %s"):format(subject, #self.dofs, method, described(values)))
  end
  for i, value in ipairs(values) do
    if type(value) ~= "number" or value - value ~= 0 then
      raise(("%s: device: value %d of %s: expected a finite number, got %s"):format(subject, i, method, described(value)))
    end
  end
  return values
end

-- Values of the real hand before the first ones are sent. If it is far beyond the limits, no value can fulfill both the limits and the maximum speed.
local function start_of(self, reach)
  local values = read_device(self)
  for i, value in ipairs(values) do
    local range = self.limits[i]
    if value < range[1] - reach or value > range[2] + reach then
      raise(("%s: value %d of the device, %.6g, is beyond its limits %.6g to %.6g: bring it back first"):format(subject, i, value, range[1], range[2]), "stale")
    end
  end
  return values
end

local function write_device(device, values)
  if device.write_positions then return device:write_positions(values) end
  device:move(values)
end

-- values of the device as DOFs of the hand; the other DOFs keep their values
local function to_hand(self, values)
  local dofs = self.hand.dofs
  for i, d in ipairs(self.dofs) do dofs[d] = values[i] * self.signs[i] + self.offsets[i] end
  return dofs
end

local function to_device(self, dofs)
  local values = {}
  for i, d in ipairs(self.dofs) do values[i] = (dofs[d] - self.offsets[i]) * self.signs[i] end
  return values
end

--- Moves the simulated hand to the posture of the real one, until contact stops it.
---@return table result  as of hand:move_dofs
function Mirror:pull()
  local dofs, limits = to_hand(self, read_device(self)), self.hand.dof_limits
  for d, value in ipairs(dofs) do dofs[d] = math.max(limits[d][1], math.min(limits[d][2], value)) end
  return self.hand:move_dofs(dofs)
end

--- Moves the real hand towards the posture of the simulated one, within the limits, and by no more than the maximum speed permits since the last call.
--- The first call begins at the posture of the real hand, and moves it for at most `interval` at that speed.
---@return boolean done  true: the posture was sent completely; false: call it again
function Mirror:push()
  local now = loop.time()
  local seconds = self.pushed and math.min(now - self.pushed, self.interval) or self.interval
  local reach = self.max_speed * seconds
  local from = self.sent or start_of(self, reach)
  local goal, done = to_device(self, self.hand.dofs), true
  local out = {}
  for i, value in ipairs(goal) do
    local range = self.limits[i]
    value = math.max(range[1], math.min(range[2], value))
    out[i] = math.max(range[1], math.min(range[2], math.max(from[i] - reach, math.min(from[i] + reach, value))))
    done = done and math.abs(out[i] - value) < 1e-9
  end
  write_device(self.device, out)
  self.sent, self.pushed = out, now
  return done
end

local function numbers(o, name, count, default)
  local given, out = o:raw(name), {}
  if given ~= nil and (type(given) ~= "table" or #given ~= count) then o:expected(name, ("a list of %d numbers"):format(count), given) end
  for i = 1, count do
    local value = given and given[i] or default
    if type(value) ~= "number" or value - value ~= 0 then o:expected(("%s[%d]"):format(name, i), "a finite number", value) end
    out[i] = value
  end
  return out
end

local function read_dofs(o, hand)
  local given, out, seen = o:raw "dofs", {}, {}
  if given ~= nil and (type(given) ~= "table" or #given == 0) then o:expected("dofs", "a list of numbers of DOFs", given) end
  for i = 1, #(given or hand.dofs) do
    local d = given and given[i] or i
    if math.type(d) ~= "integer" or d < 1 or d > #hand.dofs or seen[d] then
      o:expected(("dofs[%d]"):format(i), ("a number from 1 to %d, different from the others"):format(#hand.dofs), d)
    end
    out[i], seen[d] = d, true
  end
  return out
end

-- ranges of the values of the device
local function read_limits(o, mirror)
  local given, out = o:raw "limits", {}
  if given ~= nil and (type(given) ~= "table" or #given ~= #mirror.dofs) then o:expected("limits", ("a list of %d ranges {low, high}"):format(#mirror.dofs), given) end
  for i, d in ipairs(mirror.dofs) do
    local range = given and given[i]
    if given then
      local fits = type(range) == "table" and type(range[1]) == "number" and type(range[2]) == "number" and range[1] <= range[2]
      if not fits then o:expected(("limits[%d]"):format(i), "a range {low, high}", range) end
    else
      local own = mirror.hand.dof_limits[d]
      local a, b = (own[1] - mirror.offsets[i]) * mirror.signs[i], (own[2] - mirror.offsets[i]) * mirror.signs[i]
      range = {math.min(a, b), math.max(a, b)}
    end
    out[i] = {range[1], range[2]}
  end
  return out
end

--- Mirrors a real hand: `pull()` moves the simulated hand to the posture of the real one, `push()` moves the real hand slowly to that of the simulated one.
---@param options table
---@option hand robot  the simulated hand
---@option device any  a driver with `read` and `move`, or `read_positions` and `write_positions`
---@option dofs? index[]  DOFs of the hand, one for each value of the device; all by default
---@option signs? number[]  1 or -1 for each value; DOF = sign * value + offset
---@option offsets? number[]  for each value [rad or m]
---@option limits? number[][]  ranges of values that are sent; those of the simulated hand by default
---@option max_speed? number [rad/s or m/s, > 0] = 1  maximum speed of each value that is sent
---@option interval? number [s, > 0] = 0.1  maximum duration of the motion of one call of push
---@return mirror mirror # `pull`, `push`
---@effect reads
--- > device = {read = function() return {0, 1, 1, 1} end, move = function() end}
--- > clench.devices.mirror {hand = hand, device = device, dofs = {1, 1}}  --> error: dofs[2] must be a number from 1 to 12, different from the others
return function(options)
  local o = new_options(subject, options)
  local mirror = {hand = o:get "hand", device = o:raw "device", max_speed = o:get "max_speed", interval = o:get "interval"}
  local device = mirror.device
  if type(device) ~= "table" or not (device.read and device.move or device.read_positions and device.write_positions) then
    raise(("%s: device: expected a driver with read and move, or read_positions and write_positions, got %s"):format(subject, described(device)))
  end
  mirror.dofs = read_dofs(o, mirror.hand)
  mirror.signs, mirror.offsets = numbers(o, "signs", #mirror.dofs, 1), numbers(o, "offsets", #mirror.dofs, 0)
  for i, sign in ipairs(mirror.signs) do
    if sign ~= 1 and sign ~= -1 then o:expected(("signs[%d]"):format(i), "1 or -1", sign) end
  end
  mirror.limits = read_limits(o, mirror)
  o:done()
  return setmetatable(mirror, Mirror)
end
