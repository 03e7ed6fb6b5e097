local class = require "clench.class"
local described = require "clench.described"
local device = require "clench.devices.device"
local new_options = require "clench.options"
local of_glove = require "clench.devices.calibration"
local raise = require "clench.raise"

local subject = "devices.cyberglove"
local Glove = class "cyberglove"

local record_size = 24  -- the echo, 22 sensors, and a byte 0

function Glove:__tostring() return "CyberGlove at " .. self.port.name end

-- the value in the answer to a command, which ends in a byte 0; nil and the reason if there is none. parse: returns nil if the answer is damaged
local function exchange(self, command, parse)
  local _ <close> = device.use(self)
  self.port:discard()
  local ok, why = self.port:write(command, self.timeout)
  if not ok then return nil, why end
  local answer
  answer, why = device.read_until(self.port, "\0", self.timeout)
  if not answer then return nil, why end
  return parse(answer), "damaged"
end

local function ask(self, command, parse) return device.ask(self, command, exchange, command, parse) end

-- sensors of a record; nil if it is damaged
local function parse_record(record)
  if #record ~= record_size - 1 or record:sub(1, 1) ~= "G" then return nil end
  return {record:byte(2, -1)}
end

--- Is the glove connected and initialized?
---@return boolean
function Glove:is_ready()
  return ask(self, "?G", function(answer)
    local state = answer:match "^%?G([\0-\3])$"
    return state and {state:byte() == 3}
  end)[1]
end

--- Raw values of the 22 sensors, 1 to 255. A record has no checksum: with `readings` > 1 each value is the median of that number of records.
---@return integer[]
function Glove:read()
  local records = {}
  for i = 1, self.readings do records[i] = ask(self, "G", parse_record) end
  return device.median(records)
end

-- the range of a DOF; nil: it is not limited
local function range_of(limits, d)
  local range = limits[d]
  local fits = range == nil or type(range) == "table" and type(range[1]) == "number" and type(range[2]) == "number"
  if not fits then raise(("cyberglove:read_dofs: limits[%d]: expected a range {low, high}, got %s"):format(d, described(range))) end
  return range
end

--- Values of DOFs computed by a calibration: DOF = intercept + slopes * raw.
---@param calibration {slopes: number[][], intercepts: number[]}  in the form of `clench.files.glove_calibration` or `hand.glove`
---@param limits? number[][]  in the form of hand.dof_limits; values are clamped to them
---@return number[] [rad]
function Glove:read_dofs(calibration, limits)
  of_glove.check("cyberglove:read_dofs", calibration)
  if limits ~= nil and type(limits) ~= "table" then raise("cyberglove:read_dofs: limits: expected ranges {low, high}, got " .. described(limits)) end
  local raw, out = self:read(), {}
  for d in ipairs(calibration.slopes) do
    local value = of_glove.dof("cyberglove:read_dofs", calibration, d, raw)
    local range = limits and range_of(limits, d)
    out[d] = range and math.max(range[1], math.min(range[2], value)) or value
  end
  return out
end

--- Closes the port.
function Glove:close() device.close(self) end

Glove.__close = function(self) self:close() end

--- Driver of a CyberGlove with 22 sensors.
---@param options table
---@option port string|port  path of its serial line, or a port
---@option baud? integer [bit/s, 1 to 10000000] = 38400
---@option timeout? number [s, > 0, <= 3600] = 0.5  for an answer
---@option attempts? integer [1 to 1000] = 100  maximum number of attempts to get a correct answer; ten if the glove sends nothing
---@option readings? integer [1 to 99] = 1  records of which each value is the median
---@return cyberglove glove # `read`, `read_dofs`, `is_ready`, `close`
---@effect edits
--- > simulated = clench.devices.simulated.cyberglove {sensors = {10, 20, 30}}
--- > glove = clench.devices.cyberglove {port = simulated.path}
--- > glove:is_ready()  --> true
--- > raw = glove:read()
--- > simulated:close()
--- > raw[2], #raw  --> 20, 22
return function(options)
  local o = new_options(subject, options)
  return setmetatable(device.new(subject, o, {max_silent = 10, readings = o:get "readings"}), Glove)
end
