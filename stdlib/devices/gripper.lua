--- Functions shared by drivers of Robotiq grippers: registers of requests and of the status, waiting, and closing.
local described = require "clench.described"
local device = require "clench.devices.device"
local loop = clench.loop
local modbus = require "clench.devices.modbus"
local raise = require "clench.raise"
local gripper = {}

local request_address, status_address = 0x03E8, 0x07D0

--- Writes the registers of requests.
---@param bytes string  two per register
function gripper.send(self, bytes) modbus.write(self, request_address, bytes) end

--- Reads the bytes of the status.
---@param count integer  of registers
function gripper.status(self, count) return modbus.read(self, status_address, count) end

--- Reads states until one satisfies a condition.
function gripper.wait_for(self, doing, read, condition)
  local last = loop.time() + self.move_timeout
  while true do
    local state = read(self)
    if condition(state) then return state end
    if loop.time() > last then device.fail(self, "timeout", doing) end
    loop.sleep(self.poll)
  end
end

--- A fraction of the maximum speed or force, as a byte.
---@param subject string  "robotiq:move"
function gripper.byte_of(subject, name, value, default)
  if value == nil then value = default end
  if type(value) ~= "number" or not (value >= 0 and value <= 1) then
    raise(("%s: %s: expected a fraction from 0 to 1, got %s"):format(subject, name, described(value)))
  end
  return math.floor(255 * value + 0.5)
end

local function stop_frame(self) return modbus.write_frame(self, request_address, self:stopping()) end
local function try_stop(self, seconds) return modbus.try_write(self, request_address, self:stopping(), seconds) end

--- Adds the common methods to a class whose method `stopping` returns the registers that stop the fingers.
function gripper.complete(class)
  --- Stops the fingers.
  function class:stop() gripper.send(self, self:stopping()) end

  --- Stops the fingers and closes the port. A stop that the gripper does not confirm is repeated for at most three seconds.
  ---@return boolean stopped  false: the gripper has not confirmed it
  function class:close() return device.stop_and_close(self, try_stop, stop_frame(self)) end

  class.__close = function(self) self:close() end
  class.__gc = function(self) device.send_last(self, stop_frame(self)) end
end

--- As device.new, with the options that all grippers have.
function gripper.new(subject, o, fields)
  fields.slave, fields.move_timeout, fields.poll = o:get "slave", o:get "move_timeout", o:get "poll"
  fields.max_silent = 20  -- half of the requests may be damaged, and are not answered
  return device.new(subject, o, fields)
end

return gripper
