local class = require "clench.class"
local described = require "clench.described"
local device = require "clench.devices.device"
local loop = clench.loop
local new_options = require "clench.options"
local packet = require "clench.devices.dynamixel_packet"
local raise = require "clench.raise"

local subject = "devices.dynamixel"
local Bus = class "dynamixel"

-- registers of the X series: address, and size in bytes
local registers = {
  operating_mode = {11, 1}, max_position = {48, 4}, min_position = {52, 4}, torque_enable = {64, 1}, hardware_error = {70, 1}, bus_watchdog = {98, 1},
  goal_current = {102, 2}, profile_velocity = {112, 4}, goal_position = {116, 4}, present_current = {126, 2}, present_velocity = {128, 4},
  present_position = {132, 4}, present_temperature = {146, 1},
}
local modes = {current = 0, velocity = 1, position = 3, extended_position = 4, current_position = 5, pwm = 16}
local ticks_per_turn, center = 4096, 2048
local velocity_unit = 0.229 * 2 * math.pi / 60  -- of a tick [rad/s]
local watchdog_unit = 0.02                      -- [s]

function Bus:__tostring() return ("%d Dynamixel motors at %s"):format(#self.ids, self.port.name) end

local function radians_of(ticks) return (ticks - center) * 2 * math.pi / ticks_per_turn end
local function ticks_of(radians) return math.floor(radians * ticks_per_turn / (2 * math.pi) + center + 0.5) end

local function format_of(size) return size == 1 and "<i1" or size == 2 and "<i2" or "<i4" end
local function unsigned_format_of(size) return size == 1 and "<I1" or size == 2 and "<I2" or "<I4" end

-- Is it too late to continue with the bytes that have arrived? A device that never pauses would keep the exchange busy.
local function is_late(self, last) return loop.time() > last + self.timeout end

-- Sends a packet, and collects answers by id until all ids have answered or the timeout has passed.
local function exchange(self, bytes, ids)
  local _ <close> = device.use(self)
  self.port:discard()
  local ok, why = self.port:write(bytes, self.timeout)
  if not ok then return nil, why end
  local answers, left, last = {}, #ids, loop.time() + self.timeout
  local wanted, received, from = {}, "", 1
  for _, id in ipairs(ids) do wanted[id] = true end
  while left > 0 do
    if is_late(self, last) then return answers, "timeout" end
    local found, next_from, damaged = packet.decode(received, from)
    from = next_from
    if found then
      if found.instruction == packet.instructions.status and wanted[found.id] and not answers[found.id] then
        answers[found.id], left = found, left - 1
      end
    elseif not damaged then
      local more
      more, why = self.port:read_some(math.max(0, last - loop.time()))
      if not more then return answers, why end
      received = received .. more
    end
  end
  return answers
end

-- Sends a fast sync read, and returns the answers of all motors by id, or none.
local function exchange_fast(self, bytes, ids, size)
  local _ <close> = device.use(self)
  self.port:discard()
  local ok, why = self.port:write(bytes, self.timeout)
  if not ok then return nil, why end
  local received, last = "", loop.time() + self.timeout
  while true do
    local answers, damaged = packet.decode_fast(received, ids, size)
    if answers or damaged or is_late(self, last) then return answers or {} end
    local more
    more, why = self.port:read_some(math.max(0, last - loop.time()))
    if not more then return {}, why end
    received = received .. more
  end
end

local wrong_checksum = 3  -- error code of a motor that has received a damaged packet

-- the answer of one motor to an instruction; nil and the reason if there is none, or if the motor has not understood it
local function exchange_one(self, id, bytes)
  local answers, why = exchange(self, bytes, {id})
  local answer = answers and answers[id]
  if answer and answer.error & 0x7F ~= wrong_checksum then return answer end
  return nil, why ~= "timeout" and why or "damaged"  -- a damaged request has no answer either
end

-- sends one instruction to one motor, until it is answered
local function ask(self, id, instruction, parameters, doing)
  local answer = device.ask(self, ("motor %d: %s"):format(id, doing), exchange_one, id, packet.encode(id, instruction, parameters))
  local code = answer.error & 0x7F
  if code ~= 0 then raise(("%s: motor %d reports error %d: %s"):format(subject, id, code, doing), "stale") end
end

local function register_of(name) return table.unpack(registers[name] or raise(("%s: there is no register '%s'"):format(subject, tostring(name)))) end

-- answers of some motors to one query of a register
local function ask_some(self, ids, address, size, is_fast)
  local list = {}
  for i, id in ipairs(ids) do list[i] = string.char(id) end
  local parameters = string.pack("<I2 I2", address, size) .. table.concat(list)
  if is_fast then return exchange_fast(self, packet.encode(packet.broadcast, "fast_sync_read", parameters), ids, size) end
  return exchange(self, packet.encode(packet.broadcast, "sync_read", parameters), ids)
end

-- values of a register of all motors, by id; signed
local function read_all(self, name)
  local address, size = register_of(name)
  local missing, values = {table.unpack(self.ids)}, {}
  for attempt = 1, self.attempts do
    -- on a noisy line single packets may arrive when one for all motors does not
    local answers, why = ask_some(self, missing, address, size, self.is_fast and attempt % 2 == 1)
    device.check_lost(self, why)
    local still = {}
    for _, id in ipairs(missing) do
      local answer = answers and answers[id]
      if answer and #answer.parameters == size then
        values[id] = string.unpack(format_of(size), answer.parameters)
      else
        still[#still + 1] = id
      end
    end
    missing = still
    if #missing == 0 then return values end
  end
  device.fail(self, "timeout", ("motors %s: reading %s"):format(table.concat(missing, ", "), name))
end

-- Do all motors answer fast sync reads? Those with old firmware do not.
local function answers_fast(self)
  local address, size = register_of "present_position"
  for _ = 1, 3 do
    local answers, why = ask_some(self, self.ids, address, size, true)
    device.check_lost(self, why)
    if answers and next(answers) then return true end
  end
  return false
end

-- writes a register of all motors at once, which none answers
local function write_all(self, name, values)
  local address, size = register_of(name)
  local list = {string.pack("<I2 I2", address, size)}
  for _, id in ipairs(self.ids) do list[#list + 1] = string.char(id) .. string.pack(format_of(size), values[id]) end
  local ok, why = self.port:write(packet.encode(packet.broadcast, "sync_write", table.concat(list)), self.timeout)
  if not ok then device.fail(self, why, "writing " .. name) end
end

-- the same, read back and repeated until all motors have the value
local function set_all(self, name, values)
  for _ = 1, self.attempts do
    write_all(self, name, values)
    local now, same = read_all(self, name), true
    for _, id in ipairs(self.ids) do same = same and now[id] == values[id] end
    if same then return end
    self:reset_watchdog()
  end
  device.fail(self, "timeout", "writing " .. name)
end

local function for_all(self, value)
  local values = {}
  for _, id in ipairs(self.ids) do values[id] = value end
  return values
end

local function write_one(self, id, name, value)
  local address, size = register_of(name)
  ask(self, id, "write", string.pack("<I2", address) .. string.pack(unsigned_format_of(size), value), "writing " .. name)
end

--- Restarts the bus watchdogs. A motor that receives no packet for longer than the watchdog time stops, and then rejects goals.
function Bus:reset_watchdog()
  for _, id in ipairs(self.ids) do
    write_one(self, id, "bus_watchdog", 0)
    if self.watchdog > 0 then write_one(self, id, "bus_watchdog", self.watchdog) end
  end
end

--- Switches the torque of all motors on or off.
function Bus:set_torque(is_on)
  if type(is_on) ~= "boolean" then raise("dynamixel:set_torque: expected true or false, got " .. described(is_on)) end
  set_all(self, "torque_enable", for_all(self, is_on and 1 or 0))
end

--- Positions of the motors; 0 is the center of their range.
---@return number[] [rad]
function Bus:read_positions()
  local ticks, out = read_all(self, "present_position"), {}
  for i, id in ipairs(self.ids) do out[i] = radians_of(ticks[id]) end
  return out
end

--- Velocities of the motors.
---@return number[] [rad/s]
function Bus:read_velocities()
  local ticks, out = read_all(self, "present_velocity"), {}
  for i, id in ipairs(self.ids) do out[i] = ticks[id] * velocity_unit end
  return out
end

--- Sets the goals of all motors at once. They are checked here, read back and repeated until all motors have them.
---@param positions number[] [rad]
function Bus:write_positions(positions)
  device.check_numbers("dynamixel:write_positions", positions, self.names, self.low, self.high, "rad")
  local goal = {}
  for i, id in ipairs(self.ids) do goal[id] = ticks_of(positions[i]) end
  set_all(self, "goal_position", goal)
end

--- Faults that motors report, as bits; 0: none.
---@return integer[]
function Bus:read_faults()
  local values, out = read_all(self, "hardware_error"), {}
  for i, id in ipairs(self.ids) do out[i] = values[id] & 0xFF end
  return out
end

-- the bytes that switch all torque off
local function torque_off(ids)
  local list = {string.pack("<I2 I2", registers.torque_enable[1], 1)}
  for _, id in ipairs(ids) do list[#list + 1] = string.char(id, 0) end
  return packet.encode(packet.broadcast, "sync_write", table.concat(list))
end

-- attempts to switch the torque off, each for the motors that have not confirmed an earlier one
local function new_stop(self)
  local left = self.ids
  local address, size = register_of "torque_enable"
  return function()
    local ok, why = self.port:write(torque_off(left), self.timeout)
    if not ok then return false, why end
    local answers
    answers, why = ask_some(self, left, address, size, false)
    local still = {}
    for _, id in ipairs(left) do
      local answer = answers and answers[id]
      if not answer or answer.parameters ~= "\0" then still[#still + 1] = id end
    end
    left = still
    return #left == 0, why
  end
end

--- Switches the torque off and closes the port. A stop that a motor does not confirm is repeated for at most three seconds.
---@return boolean stopped  false: some motor has not confirmed it
function Bus:close() return device.stop_and_close(self, new_stop(self), torque_off(self.ids)) end

Bus.__close = function(self) self:close() end
Bus.__gc = function(self) device.send_last(self, torque_off(self.ids)) end

local function check_ids(o)
  local ids, seen = o:raw "ids", {}
  if type(ids) ~= "table" or #ids == 0 or #ids > 252 then o:expected("ids", "a list of 1 to 252 numbers", ids) end
  for i, id in ipairs(ids) do
    if math.type(id) ~= "integer" or id < 0 or id > 252 or seen[id] then o:expected(("ids[%d]"):format(i), "a number from 0 to 252, different from the others", id) end
    seen[id] = true
  end
  return {table.unpack(ids)}
end

local packet_doc = [[
@param options table
@option id? integer [0 to 254] = 0  of a motor
@option instruction string  its name
@option parameters? string  bytes]]

-- the packet with this {id, instruction, parameters}
local function packet_of(options)
  local o = new_options("dynamixel.packet", options, nil, nil, packet_doc)
  local id, instruction, parameters = o:get "id", o:raw "instruction", o:raw "parameters"
  o:done()
  if type(instruction) ~= "string" or not packet.instructions[instruction] then o:expected("instruction", "the name of an instruction", instruction) end
  if parameters ~= nil and type(parameters) ~= "string" then o:expected("parameters", "bytes", parameters) end
  return packet.encode(id, instruction, parameters)
end

-- finds all motors, reads their limits, and prepares them
local function connect(self)
  for _, id in ipairs(self.ids) do ask(self, id, "ping", "", "ping") end
  if self.is_fast == nil then self.is_fast = answers_fast(self) end
  local low, high = read_all(self, "min_position"), read_all(self, "max_position")
  for i, id in ipairs(self.ids) do
    if low[id] < 0 or high[id] >= ticks_per_turn or low[id] > high[id] then
      raise(("%s: motor %d: expected limits from 0 to %d, got %d to %d"):format(subject, id, ticks_per_turn - 1, low[id], high[id]), "stale")
    end
    self.names[i], self.low[i], self.high[i] = "motor " .. id, radians_of(low[id]), radians_of(high[id])
  end
  self:reset_watchdog()
  if self.mode then
    self:set_torque(false)  -- the mode can be changed only without torque
    set_all(self, "operating_mode", for_all(self, modes[self.mode]))
  end
  if self.current then set_all(self, "goal_current", for_all(self, self.current)) end
  if self.velocity then set_all(self, "profile_velocity", for_all(self, math.max(1, math.floor(self.velocity / velocity_unit + 0.5)))) end
  self:set_torque(true)
end

--- Driver of Dynamixel motors of the X series on one bus, by protocol 2.0: positions of all motors are read and written together. Goals are checked
--- against the limits of the motors. The watchdog of a motor stops it if packets cease, for example because the program was killed. When the program ends,
--- the torque is switched off.
---@param options table
---@option port string|port  path of the serial line, or a port
---@option ids integer[]  of the motors
---@option baud? integer [bit/s, 1 to 10000000] = 57600
---@option mode? string  "position", "current_position" (as LEAP hands use), "velocity", ...; default: as the motors are
---@option current? integer [-2047 to 2047]  goal current of all motors, in their unit
---@option velocity? number [rad/s, > 0]  maximum velocity of motions to goals
---@option watchdog? number [s, 0 to 2.54] = 2  0: none
---@option fast? boolean  read by fast sync read, which all motors answer with one packet; default: if all motors support it
---@option timeout? number [s, > 0, <= 3600] = 0.05  for answers
---@option attempts? integer [1 to 1000] = 50  maximum number of attempts to get a correct answer
---@return dynamixel bus # `read_positions`, `write_positions`, `read_velocities`, `read_faults`, `set_torque`, `reset_watchdog`, `packet`, `close`
---@effect edits
--- > simulated = clench.devices.simulated.dynamixel {ids = {1, 2}}
--- > bus = clench.devices.dynamixel {port = simulated.path, ids = {1, 2}}
--- > bus.packet {id = 1, instruction = "ping"} == "\xFF\xFF\xFD\x00\x01\x03\x00\x01\x19\x4E"  --> true
--- > simulated:close()
--- > bus:write_positions {0.5, 4}  --> error: motor 2: expected -3.14159 to 3.14006 rad, got 4
return function(options)
  local o = new_options(subject, options)
  local mode = o:raw "mode"
  if mode ~= nil and not modes[mode] then o:expected("mode", "the name of an operating mode", mode) end
  local bus = {ids = check_ids(o), names = {}, low = {}, high = {}, packet = packet_of, mode = mode,
               is_fast = o:get "fast", current = o:get "current", velocity = o:get "velocity",
               watchdog = math.ceil(o:get "watchdog" / watchdog_unit)}
  bus = setmetatable(device.new(subject, o, bus), Bus)
  connect(bus)
  return bus
end
