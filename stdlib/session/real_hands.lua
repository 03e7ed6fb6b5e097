--- Drivers of real hands for a session. All have one form: `read` and `move` with a list of numbers, `stop` and `close`.
local raise = require "clench.raise"
local real_hands = {}

local timeout = 1  -- for an answer; the loop may be late while a frame is drawn [s]

-- Dynamixel motors have no command that stops them: their goals become their positions
local function bus_hand(bus)
  local function move(_, values) bus:write_positions(values) end
  local function stop()
    local values = bus:read_positions()
    for i, value in ipairs(values) do values[i] = math.max(bus.low[i], math.min(bus.high[i], value)) end
    bus:write_positions(values)
  end
  return {read = function() return bus:read_positions() end, move = move, stop = stop, close = function() bus:close() end}
end

-- a gripper, as fractions by which it is closed
local function gripper_hand(gripper, read, move)
  return {read = read, move = function(_, values) move(values) end, stop = function() gripper:stop() end, close = function() gripper:close() end}
end

local function open_barrett(port)
  local hand = clench.devices.barrett {port = port, timeout = timeout}
  return hand, function() hand:initialize() end
end

local function open_bus(port, ids, options)
  if not ids then raise "sensors.connect_hand: ids: expected the numbers of the motors, {1, 2, 3}" end
  return bus_hand(clench.devices.dynamixel {port = port, ids = ids, mode = options and options.mode, current = options and options.current}), function() end
end

-- the number of a gripper on its line
local function slave_of(ids)
  if ids and (#ids ~= 1 or next(ids, 1)) then raise "sensors.connect_hand: ids: expected one number for a gripper, {9}" end
  return ids and ids[1]
end

local function open_two_fingers(port, ids)
  local gripper = clench.devices.robotiq {port = port, slave = slave_of(ids), timeout = timeout}
  local function read() return {1 - gripper:read().opening / gripper.stroke} end
  local function move(values) gripper:move(gripper.stroke * (1 - values[1])) end
  return gripper_hand(gripper, read, move), function() gripper:activate() end
end

local function open_three_fingers(port, ids)
  local gripper = clench.devices.robotiq_3f {port = port, slave = slave_of(ids), timeout = timeout}
  local function read() return {table.unpack(gripper:read().closing, 1, 3)} end
  return gripper_hand(gripper, read, function(values) gripper:move(values) end), function() gripper:activate() end
end

--- Drivers by name. baud: of the line; fractions: values are from 0, open, to 1, closed; open(port, ids): returns the driver, and a function that prepares
--- the hand, which may move then.
real_hands.drivers = {
  barrett = {title = "Barrett hand", baud = 9600, takes_no_ids = true, open = open_barrett},
  dynamixel = {title = "Dynamixel motors", baud = 57600, open = open_bus},
  leap = {title = "LEAP hand", baud = 4000000,
          open = function(port, ids)
            local all = {}
            for id = 0, 15 do all[id + 1] = id end
            return open_bus(port, ids or all, {mode = "current_position", current = 350})
          end},
  robotiq = {title = "Robotiq gripper", baud = 115200, fractions = true, open = open_two_fingers},
  robotiq_3f = {title = "three-finger Robotiq gripper", baud = 115200, fractions = true, open = open_three_fingers},
}

--- Their names, in the order of menus.
real_hands.names = {"barrett", "leap", "dynamixel", "robotiq", "robotiq_3f"}

--- Raises an error if options do not fit a driver.
function real_hands.check(name, ids)
  local driver = real_hands.drivers[name]
  if ids and driver.takes_no_ids then raise(("sensors.connect_hand: ids: a %s has no number"):format(driver.title)) end
  for i, id in ipairs(ids or {}) do
    if math.type(id) ~= "integer" then raise(("sensors.connect_hand: ids[%d]: expected a whole number, got %s"):format(i, require "clench.described"(id))) end
  end
  if name == "dynamixel" and (not ids or #ids == 0) then raise "sensors.connect_hand: ids: expected the numbers of the motors, {1, 2, 3}" end
  if driver.fractions then slave_of(ids) end
  return driver
end

--- A device whose values are DOFs of the hand instead of fractions by which a gripper is closed.
---@param device table  with `read` and `move`
---@param hand robot
---@param dofs integer[]  of the hand, one for each value
function real_hands.scaled(device, hand, dofs)
  local limits, info = hand.dof_limits, hand.dof_info
  for _, d in ipairs(dofs) do
    if not (limits[d][2] > limits[d][1]) then raise(("session: DOF %d of %s has no range in which a gripper could move it"):format(d, hand.name)) end
  end
  local function range_of(i)
    local low, high = limits[dofs[i]][1], limits[dofs[i]][2]
    if info[dofs[i]].default_velocity < 0 then return high, low end
    return low, high
  end
  local function read()
    local out = {}
    for i, fraction in ipairs(device:read()) do
      local open, closed = range_of(i)
      out[i] = open + fraction * (closed - open)
    end
    return out
  end
  local function move(_, values)
    local out = {}
    for i, value in ipairs(values) do
      local open, closed = range_of(i)
      out[i] = math.max(0, math.min(1, (value - open) / (closed - open)))
    end
    device:move(out)
  end
  return {read = read, move = move}
end

return real_hands
