local new_line = require "clench.devices.simulated.line"

local count = 22

local function serve(glove)
  local before = ""
  while true do
    local bytes = glove:receive()
    if not bytes then return end
    for byte in bytes:gmatch "." do
      if before == "?" then
        glove:send("?" .. byte .. string.char(glove.state) .. "\0")
        byte = ""
      elseif byte == "G" then
        local record = {"G"}
        for i = 1, count do record[i + 1] = string.char(glove.sensors[i]) end
        glove:send(table.concat(record) .. "\0")
      end
      before = byte
    end
  end
end

-- random values of sensors that the options leave out
local function read_sensors(o)
  local given = o:raw "sensors" or {}
  if type(given) ~= "table" or #given > count then o:expected("sensors", "a list of at most 22 numbers", given) end
  local random, sensors = clench.random(o:get "seed"), {}
  for i = 1, count do
    local value = given[i] or random:integer(40, 220)
    if math.type(value) ~= "integer" or value < 1 or value > 255 then o:expected(("sensors[%d]"):format(i), "a whole number from 1 to 255", value) end
    sensors[i] = value
  end
  return sensors
end

--- Simulates a CyberGlove on a pseudo-terminal.
---@param options? table
---@option sensors? integer[]  values of sensors, 1 to 255; others are chosen by the seed
---@option flip_bytes? number [0 to 1] = 0  fraction of the bytes in which a bit is changed
---@option lose_bytes? number [0 to 1] = 0  fraction of the bytes that are lost
---@option delay? number [s, >= 0] = 0  before each reply
---@option seed? integer [0 to 9007199254740992] = 1
---@return table glove # `path`, `sensors`, `state` (3: ready), `unplug()`, `close()`
---@effect edits
--- > simulated = clench.devices.simulated.cyberglove {}
--- > #simulated.sensors, simulated.state  --> 22, 3
--- > simulated:close()
--- > simulated.path:find "^/dev/" ~= nil  --> true
return function(options) return new_line("cyberglove", options, function(o) return {sensors = read_sensors(o), state = 3} end, serve) end
