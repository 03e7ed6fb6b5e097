local class = require "clench.class"
local described = require "clench.described"
local device = require "clench.devices.device"
local gripper = require "clench.devices.gripper"
local new_options = require "clench.options"
local raise = require "clench.raise"

local subject = "devices.robotiq_3f"
local Gripper = class "robotiq_3f"

local modes = {basic = 0, pinch = 1, wide = 2, scissor = 3}
local mode_names = {[0] = "basic", "pinch", "wide", "scissor"}
local axes = {"finger A", "finger B", "finger C", "scissor"}
local objects = {"opening", "closing"}

function Gripper:__tostring() return "Robotiq gripper of three fingers at " .. self.port.name end

local activate, go = 0x01, 0x08
local individual_fingers, individual_scissor = 0x04, 0x08

-- requests: actions, options, and position, speed and force of fingers A to C and of the scissor
local function request(self, actions, options, positions, speed, force)
  local bytes = {string.char(activate | modes[self.mode] << 1 | actions, options, 0)}
  for i = 1, 4 do bytes[i + 1] = string.char(positions[i] or 0, speed, force) end
  return table.concat(bytes) .. "\0"
end

local function send(self, ...) gripper.send(self, request(self, ...)) end

local function read_status(self)
  local bytes = gripper.status(self, 8)
  local first, object_bits, fault = bytes:byte(1, 3)
  local status = {is_active = first & 1 == 1 and first >> 4 & 3 == 3, mode = first >> 1 & 3, is_moving = first >> 3 & 1 == 1 and first >> 6 == 0,
                  fault = fault & 0x0F, echo = {}, positions = {}, currents = {}, objects = {}}
  for i = 1, 4 do
    status.echo[i], status.positions[i], status.currents[i] = bytes:byte(3 * i + 1, 3 * i + 3)
    status.objects[i] = object_bits >> 2 * (i - 1) & 3
  end
  return status
end

--- Activates the gripper in basic mode: it opens and closes to find its ends of travel.
function Gripper:activate()
  self.mode = "basic"
  gripper.send(self, ("\0"):rep(16))
  send(self, 0, 0, {}, 0, 0)
  gripper.wait_for(self, "activation", read_status, function(status) return status.is_active and status.mode == 0 end)
end

local function check_active(self, method)
  if not read_status(self).is_active then raise(("robotiq_3f:%s: the gripper is not active; call activate first"):format(method), "stale") end
end

--- Switches the fingers to a mode, for which they open.
---@param mode "basic"|"pinch"|"wide"|"scissor"
function Gripper:set_mode(mode)
  if not modes[mode] then raise("robotiq_3f:set_mode: expected basic, pinch, wide or scissor, got " .. described(mode)) end
  check_active(self, "set_mode")
  self.mode = mode
  send(self, 0, 0, {}, 0, 0)
  gripper.wait_for(self, "mode " .. mode, read_status, function(status) return status.is_active and status.mode == modes[mode] end)
end

-- positions of the axes in a motion, and the options that make the axes independent
local function goals_of(closing)
  local list = type(closing) == "table" and closing or {closing}
  local count = #list
  if count == 2 or count > 4 then raise("robotiq_3f:move: expected one number, one per finger, or those and the scissor's, got " .. described(closing)) end
  local low, high = {0, 0, 0, 0}, {1, 1, 1, 1}
  device.check_numbers("robotiq_3f:move", list, count == 1 and {"closing"} or {table.unpack(axes, 1, count)}, low, high, "(1: closed)")
  local goals = {}
  for i, part in ipairs(list) do goals[i] = math.floor(255 * math.max(0, math.min(1, part)) + 0.5) end
  return goals, (count > 1 and individual_fingers or 0) | (count > 3 and individual_scissor or 0)
end

--- Moves the fingers until they are closed by the given fractions, or until objects stop them.
---@param closing number|number[]  from 0, open, to 1: one number for all fingers, or one for each of the fingers A, B and C, optionally followed by that of the scissor
---@param speed? number  fraction of the maximum speed, 1 by default
---@param force? number  fraction of the maximum force, 0.5 by default
---@return table state  as of read
function Gripper:move(closing, speed, force)
  local goals, options = goals_of(closing)
  speed, force = gripper.byte_of("robotiq_3f:move", "speed", speed, 1), gripper.byte_of("robotiq_3f:move", "force", force, 0.5)
  check_active(self, "move")
  send(self, go, options, goals, speed, force)
  gripper.wait_for(self, "motion", read_status, function(status)
    for i, goal in ipairs(goals) do
      if status.echo[i] ~= goal then return false end
    end
    return not status.is_moving
  end)
  return self:read()
end

--- The state. Lists have an item for each of the fingers A, B, C and for the scissor: closing, from 0 to 1; objects: "opening" or "closing" if one stopped
--- that motion, else false; currents [A].
---@return {closing: number[], objects: (string|boolean)[], currents: number[], is_moving: boolean, is_active: boolean, mode: string, fault: integer}
function Gripper:read()
  local status = read_status(self)
  local closing, stopped_by, currents = {}, {}, {}
  for i = 1, 4 do closing[i], stopped_by[i], currents[i] = status.positions[i] / 255, objects[status.objects[i]] or false, status.currents[i] * 1e-4 end
  return {closing = closing, objects = stopped_by, currents = currents, is_moving = status.is_moving, is_active = status.is_active, mode = mode_names[status.mode], fault = status.fault}
end

function Gripper:stopping() return request(self, 0, 0, {}, 0, 0) end

gripper.complete(Gripper)

--- Driver of a three-finger Robotiq gripper, by Modbus RTU: moves all fingers together, or each finger and the scissor separately, in four modes. Values are
--- checked before they are sent. When the program ends, the fingers are stopped; but if it is killed, a motion continues to its end, as the gripper has no
--- watchdog.
---@param options table
---@option port string|port  path of its serial line, or a port
---@option slave? integer [1 to 247] = 9
---@option baud? integer [bit/s, 1 to 10000000] = 115200
---@option timeout? number [s, > 0, <= 3600] = 0.1  for an answer
---@option move_timeout? number [s, > 0, <= 3600] = 20  for activation, modes and motions
---@option poll? number [s, >= 0] = 0.02  between two queries for the end of a motion
---@option attempts? integer [1 to 1000] = 50  maximum number of attempts to get a correct answer; 20 if the gripper sends nothing
---@return robotiq_3f gripper # `activate`, `set_mode`, `move`, `read`, `stop`, `close`
---@effect edits
--- > simulated = clench.devices.simulated.robotiq_3f {}
--- > gripper = clench.devices.robotiq_3f {port = simulated.path}
--- > gripper:activate()
--- > gripper:set_mode "pinch"
--- > math.abs(gripper:move(0.6).closing[2] - 0.6) < 2e-3  --> true
--- > simulated:close()
--- > gripper:move {0, 1.1, 0}  --> error: finger B: expected 0 to 1 (1: closed), got 1.1
return function(options)
  local o = new_options(subject, options)
  return setmetatable(gripper.new(subject, o, {mode = "basic"}), Gripper)
end
