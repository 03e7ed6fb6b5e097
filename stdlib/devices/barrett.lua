local class = require "clench.class"
local described = require "clench.described"
local device = require "clench.devices.device"
local new_options = require "clench.options"
local raise = require "clench.raise"

local subject = "devices.barrett"
local Barrett = class "barrett"

-- motors in the order of the hand's DOFs: spread, then fingers
local letters = {"S", "1", "2", "3"}
local names = {"spread", "finger 1", "finger 2", "finger 3"}
local max_spread, max_finger = 3150, 17800                   -- ends of travel [counts]
local spread_angle, finger_angle = math.pi, 2.51327          -- the same [rad]
local max_counts = {max_spread, max_finger, max_finger, max_finger}
local max_angles = {spread_angle, finger_angle, finger_angle, finger_angle}
local all = "123S"                 -- the order in which the hand reports values
local order_of_all = {4, 1, 2, 3}  -- position of each DOF in that order

function Barrett:__tostring() return "Barrett hand at " .. self.port.name end

-- one exchange: the reply between echo and prompt; nil and the reason if there is none
local function exchange(self, command, seconds)
  self.port:discard()
  local ok, why = self.port:write(command .. "\r", seconds)
  if not ok then return nil, why end
  local text
  text, why = device.read_until(self.port, "=> ", seconds)
  if not text then return nil, why end
  -- a different or longer echo: the hand has received another command, or the reply is damaged
  if text:sub(1, #command) ~= command or not text:find("^[\r\n]", #command + 1) or text:find "[^\r\n\t -~]" then return nil, "damaged" end
  return text:sub(#command + 1)
end

local function error_of(reply) return reply and reply:match "ERR%s*(%d+)" end

local function check_reply(command, reply)
  local code = error_of(reply)
  if code then raise(("%s: the hand reports error %s after %s"):format(subject, code, command), "stale") end
  return reply
end

-- Sends a command until it is answered. An error may be that of a command that was damaged on its way: it is accepted once it is repeated.
local function ask(self, command, seconds)
  local last
  return check_reply(command, device.ask(self, command, function()
    local reply, why = exchange(self, command, seconds)
    local code = error_of(reply)
    if code and code ~= last then reply, why = nil, "damaged" end
    last = code
    return reply, why
  end))
end

-- sends a command that must not be repeated, as a repetition would have a further effect
local function ask_once(self, command, seconds)
  local reply, why = exchange(self, command, seconds)
  if reply then return check_reply(command, reply) end
  device.check_lost(self, why)
  device.fail(self, "timeout", command)
end

-- the numbers of a reply, from 0 to their maxima; nil: the reply is damaged
local function parse_numbers(reply, max)
  local numbers = {}
  for word in reply:gmatch "%S+" do
    local value, largest = word:match "^%d+$" and tonumber(word), max[#numbers + 1]
    if not value or not largest or value > largest then return nil end
    numbers[#numbers + 1] = value
  end
  return #numbers == #max and numbers or nil
end

-- Numbers of the reply to a command, from 0 to their maxima. No checksum protects them: they are accepted once two replies agree.
local function ask_numbers(self, command, max)
  local seen = {}
  return device.ask(self, command, function()
    local numbers = parse_numbers(ask(self, command, self.timeout), max)
    if not numbers then return nil end
    local key = table.concat(numbers, " ")
    if seen[key] then return numbers end
    seen[key] = true
  end)
end

local function counts_of(angles)
  local counts = {}
  for i, angle in ipairs(angles) do counts[i] = math.floor(angle / max_angles[i] * max_counts[i] + 0.5) end
  return counts
end

-- letters of the motors in the arguments, which precede a command; without arguments those of all motors
local function prefix_of(method, motors)
  if motors == nil then return "" end
  if type(motors) ~= "string" or not motors:find "^[123S]+$" then
    raise(("barrett:%s: motors: expected letters of 1, 2, 3 and S, as in '12S', got %s"):format(method, described(motors)))
  end
  return motors
end

--- Initializes the hand: it finds the ends of travel of all motors. Afterwards the spread moves smoothly.
function Barrett:initialize()
  ask(self, "HI", self.move_timeout)
  for _, setting in ipairs {"SAMPLE 50", "ACCEL 1", "MCV 18", "MOV 18"} do ask(self, "SFSET " .. setting, self.timeout) end
end

--- Moves all motors, or the given ones, to their home positions.
function Barrett:home(motors) ask(self, prefix_of("home", motors) .. "HOME", self.move_timeout) end

--- Opens all motors, or the given ones, until something stops them.
function Barrett:open(motors) ask(self, prefix_of("open", motors) .. "O", self.move_timeout) end

--- Closes all motors, or the given ones, until something stops them.
function Barrett:close_fingers(motors) ask(self, prefix_of("close_fingers", motors) .. "C", self.move_timeout) end

--- Opens or closes by a number of counts. A command that is not answered is not repeated, because it may have been executed.
---@param counts integer  > 0 closes, < 0 opens
function Barrett:increment(counts, motors)
  local whole = type(counts) == "number" and math.tointeger(counts)
  if not whole or whole == 0 or math.abs(whole) > max_finger then
    raise(("barrett:increment: counts: expected a whole number other than 0, from -%d to %d, got %s"):format(max_finger, max_finger, described(counts)))
  end
  ask_once(self, ("%s%s %d"):format(prefix_of("increment", motors), whole > 0 and "IC" or "IO", math.abs(whole)), self.move_timeout)
end

--- Closes or opens with constant torque.
---@param direction "close"|"open"
function Barrett:torque(direction, motors)
  if direction ~= "close" and direction ~= "open" then raise("barrett:torque: direction: expected 'close' or 'open', got " .. described(direction)) end
  ask(self, prefix_of("torque", motors) .. (direction == "close" and "TC" or "TO"), self.move_timeout)
end

--- Switches the motors off.
function Barrett:stop(motors) ask(self, prefix_of("stop", motors) .. "T", self.timeout) end

--- Moves all motors together. Positions are checked, sent and read back before the motion is started.
---@param angles number[]  spread and fingers [rad]
function Barrett:move(angles)
  device.check_numbers("barrett:move", angles, names, {0, 0, 0, 0}, max_angles, "rad")
  local goal = counts_of(angles)
  for i, letter in ipairs(letters) do
    device.ask(self, "FSET DP", function()
      ask(self, ("%sFSET DP %d"):format(letter, goal[i]), self.timeout)
      return ask_numbers(self, letter .. "FGET DP", {max_counts[i]})[1] == goal[i] or nil
    end)
  end
  ask(self, all .. "M", self.move_timeout)
end

--- Positions of the motors: spread and fingers.
---@return number[] [rad]
function Barrett:read()
  local counts = ask_numbers(self, all .. "FGET P", {max_finger, max_finger, max_finger, max_spread})
  local angles = {}
  for i, place in ipairs(order_of_all) do angles[i] = counts[place] / max_counts[i] * max_angles[i] end
  return angles
end

--- Breakaways of the fingers: whether each has broken away, and at which position [rad].
---@return {broken: boolean, position: number}[]
function Barrett:breakaways()
  local detected = ask_numbers(self, "123FGET BD", {1, 1, 1})
  local at = ask_numbers(self, "123FGET BP", {max_finger, max_finger, max_finger})
  local out = {}
  for i = 1, 3 do out[i] = {broken = detected[i] == 1, position = at[i] / max_finger * finger_angle} end
  return out
end

local function try_stop(self, seconds)
  local reply, why = exchange(self, "T", seconds)
  return reply ~= nil and not error_of(reply), why
end

--- Switches the motors off and closes the port. A stop that the hand does not confirm is repeated for at most three seconds.
---@return boolean stopped  false: the hand has not confirmed it
function Barrett:close() return device.stop_and_close(self, try_stop, "T\r") end

Barrett.__close = function(self) self:close() end
Barrett.__gc = function(self) device.send_last(self, "T\r") end

--- Driver of a Barrett hand BH8-262. Angles are checked before they are sent. When the program ends, the motors are switched off; but if it is
--- killed, the hand stays as it is, because it has no watchdog.
---@param options table
---@option port string|port  path of its serial line, or a port
---@option baud? integer [bit/s, 1 to 10000000] = 9600
---@option timeout? number [s, > 0, <= 3600] = 0.5  for replies to queries and settings
---@option move_timeout? number [s, > 0, <= 3600] = 20  for the ends of motions
---@option attempts? integer [1 to 1000] = 100  maximum number of attempts to get a correct reply; ten if the hand sends nothing
---@return barrett hand # `initialize`, `move`, `read`, `open`, `close_fingers`, `home`, `increment`, `torque`, `stop`, `breakaways`, `close`
---@effect edits
--- > simulated = clench.devices.simulated.barrett {}
--- > barrett = clench.devices.barrett {port = simulated.path}
--- > barrett:initialize()
--- > barrett:move {0.5, 1, 1, 1}
--- > math.abs(barrett:read()[2] - 1) < 2e-4  --> true
--- > simulated:close()
--- > barrett:move {9, 0, 0, 0}  --> error: spread: expected 0 to 3.14159 rad, got 9
return function(options)
  local o = new_options(subject, options)
  return setmetatable(device.new(subject, o, {max_silent = 10, move_timeout = o:get "move_timeout"}), Barrett)
end
