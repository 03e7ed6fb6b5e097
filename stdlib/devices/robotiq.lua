local class = require "clench.class"
local device = require "clench.devices.device"
local gripper = require "clench.devices.gripper"
local new_options = require "clench.options"
local raise = require "clench.raise"

local subject = "devices.robotiq"
local Robotiq = class "robotiq"

local objects = {[0] = "moving", [1] = "opening", [2] = "closing", [3] = "none"}  -- motion in which the fingers were stopped by an object

function Robotiq:__tostring() return "Robotiq gripper at " .. self.port.name end

local function send(self, action, position, speed, force) gripper.send(self, string.char(action, 0, 0, position, speed, force)) end

local function read_status(self)
  local status, _, fault, echo, position, current = gripper.status(self, 3):byte(1, 6)
  return {status = status, fault = fault, echo = echo, position = position, current = current}
end

local function is_active(status) return status.status & 0x01 == 1 and status.status >> 4 & 3 == 3 end

--- Activates the gripper: it opens and closes once to find its ends of travel.
function Robotiq:activate()
  send(self, 0, 0, 0, 0)
  send(self, 1, 0, 0, 0)
  gripper.wait_for(self, "activation", read_status, is_active)
end

-- position, from 0 (open) to 255 (closed), for an opening
local function count_of(self, opening) return math.floor(255 * (1 - opening / self.stroke) + 0.5) end

--- Moves the fingers until they have the given opening, or until an object stops them.
---@param opening number  distance of the fingers [m]
---@param speed? number  fraction of the maximum speed, 1 by default
---@param force? number  fraction of the maximum force, 0.5 by default
---@return table state  as of read
function Robotiq:move(opening, speed, force)
  device.check_numbers("robotiq:move", {opening}, {"opening"}, {0}, {self.stroke}, "m")
  local count = count_of(self, opening)
  speed, force = gripper.byte_of("robotiq:move", "speed", speed, 1), gripper.byte_of("robotiq:move", "force", force, 0.5)
  if not is_active(read_status(self)) then raise("robotiq:move: the gripper is not active; call activate first", "stale") end
  send(self, 0x09, count, speed, force)
  gripper.wait_for(self, "motion", read_status, function(status) return status.echo == count and status.status >> 6 ~= 0 end)
  return self:read()
end

--- The state: opening [m], is_moving, object ("opening" or "closing": one has stopped the fingers in that motion), fault (0: none), current [A].
---@return {opening: number, is_moving: boolean, is_active: boolean, object?: string, fault: integer, current: number}
function Robotiq:read()
  local status = read_status(self)
  local object = objects[status.status >> 6]
  return {opening = self.stroke * (1 - status.position / 255), is_active = is_active(status), is_moving = object == "moving",
          object = (object == "opening" or object == "closing") and object or nil, fault = status.fault & 0x0F, current = status.current / 100}
end

function Robotiq:stopping() return "\1\0\0\0\0\0" end

gripper.complete(Robotiq)

--- Driver of a two-finger Robotiq gripper, by Modbus RTU. Openings are checked before they are sent. When the program ends, the fingers are stopped;
--- but if it is killed, a motion continues to its end, as the gripper has no watchdog.
---@param options table
---@option port string|port  path of its serial line, or a port
---@option stroke? number [m, > 0] = 0.085  largest opening
---@option slave? integer [1 to 247] = 9
---@option baud? integer [bit/s, 1 to 10000000] = 115200
---@option timeout? number [s, > 0, <= 3600] = 0.1  for an answer
---@option move_timeout? number [s, > 0, <= 3600] = 10  for activation and motions
---@option poll? number [s, >= 0] = 0.02  between two queries for the end of a motion
---@option attempts? integer [1 to 1000] = 50  maximum number of attempts to get a correct answer; 20 if the gripper sends nothing
---@return robotiq gripper # `activate`, `move`, `read`, `stop`, `close`
---@effect edits
--- > simulated = clench.devices.simulated.robotiq {}
--- > gripper = clench.devices.robotiq {port = simulated.path}
--- > gripper:activate()
--- > math.abs(gripper:move(0.04).opening - 0.04) < 2e-4  --> true
--- > simulated:close()
--- > gripper:move(0.1)  --> error: opening: expected 0 to 0.085 m, got 0.1
return function(options)
  local o = new_options(subject, options)
  return setmetatable(gripper.new(subject, o, {stroke = o:get "stroke"}), Robotiq)
end
