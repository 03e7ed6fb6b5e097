--- Recordings of ports: a text file, one line per piece: seconds since the start, ">" (sent) or "<" (received), the bytes in hexadecimal.
local raise = require "clench.raise"
local recording = {}

local first_line = "clench port recording 1"

--- Creates a file.
---@param path string
---@return fun(direction: string, bytes: string) # appends a line
function recording.create(path)
  clench.files.save_text(path, first_line .. "\n")
  local began = clench.loop.time()
  return function(direction, bytes)
    local digits = bytes:gsub(".", function(byte) return ("%02x"):format(byte:byte()) end)
    clench.files.append_text(path, ("%.6f %s %s"):format(clench.loop.time() - began, direction, digits))
  end
end

local function read_record(path, number, line)
  local seconds, direction, digits = line:match "^(%d+%.?%d*) ([<>]) (%x+)$"
  if not seconds or #digits % 2 ~= 0 then
    raise(("%s:%d: expected seconds, '<' or '>' and bytes in hexadecimal"):format(path, number), "file")
  end
  local bytes = digits:gsub("%x%x", function(pair) return string.char(tonumber(pair, 16)) end)
  return {time = tonumber(seconds), is_sent = direction == ">", bytes = bytes, line = number}
end

--- Reads a file.
---@param path string
---@return {time: number, is_sent: boolean, bytes: string, line: integer}[]
function recording.read(path)
  local records, number = {}, 0
  for line in clench.files.read_text(path):gmatch "([^\n]*)\n" do
    number = number + 1
    if number == 1 then
      if line ~= first_line then raise(("%s:1: expected '%s'"):format(path, first_line), "file") end
    else
      local record = read_record(path, number, line)
      local before = records[#records]
      if before and record.time < before.time then raise(("%s:%d: the time is before that of the line above"):format(path, number), "file") end
      records[#records + 1] = record
    end
  end
  if number == 0 then raise(("%s: expected a recording of a port"):format(path), "file") end
  return records
end

return recording
