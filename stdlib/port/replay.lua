local check = require "clench.port.check"
local described = require "clench.described"
local loop = clench.loop
local new_options = require "clench.options"
local new_port = require "clench.port.port"
local open_pair = require "clench.open_pair"
local raise = require "clench.raise"
local recording = require "clench.port.recording"

-- a function that compares sent bytes with the recording
local function comparison(path, records)
  local expected, sent = {}, 0
  for _, record in ipairs(records) do
    if record.is_sent then expected[#expected + 1] = record.bytes end
  end
  expected = table.concat(expected)
  return function(bytes)
    local recorded = expected:sub(sent + 1, sent + #bytes)
    if bytes ~= recorded then
      raise(("port:write: the recording %s has %s here, got %s"):format(path, recorded == "" and "no more bytes" or described(recorded), described(bytes)))
    end
    sent = sent + #bytes
  end
end

-- plays the device's side: each answer follows when the bytes that precede it in the recording have been sent
local function play(other, records, speed)
  local before = 0
  for _, record in ipairs(records) do
    if record.is_sent then
      if not other:read(#record.bytes) then return end
    else
      loop.sleep((record.time - before) / speed)
      if not other:write(record.bytes) then return end
    end
    before = record.time
  end
  other:drain()
  other:close()
end

--- A port that plays the device's side of a recording made by `port:record`. Bytes arrive at their recorded times, but not before the program has
--- sent the bytes that precede them in the recording. The program must send the same bytes, otherwise its write fails. At the end the port is closed.
---@param path string  file to read
---@param options? table
---@option speed? number [> 0] = 1  `math.huge`: without pauses
---@return port
---@effect files
--- > a, b = clench.port.pair()
--- > path = os.tmpname()
--- > a:record(path)
--- > a:write "?" b:write "ready\n"
--- > a:read_line(1)  --> ready
--- > a:close()
--- > device = clench.port.replay(path)
--- > device:write "?"
--- > device:read_line(1)  --> ready
--- > device:read_line(1)  --> nil, closed
--- > os.remove(path)  --> true
return function(path, options)
  check.string("clench.port.replay", "path", path)
  local o = new_options("clench.port.replay", options or {})
  local speed = o:raw "speed"
  o:done()
  if speed ~= nil and not (type(speed) == "number" and speed > 0) then o:expected("speed", "a number > 0", speed) end
  local records = recording.read(path)
  local ours, others = open_pair()
  local other = new_port(others)
  local port = new_port(ours, {name = "replay of " .. path, check_sent = comparison(path, records), on_close = function() other:close() end})
  loop.spawn(function() play(other, records, speed or 1) end)
  return port
end
