local new_line = require "clench.devices.simulated.line"

local full = 0.9144  -- position of a full word [m]

-- two bytes of seven bits; the two lowest bits of a word are not sent
local function word_bytes(value)
  local bits = math.max(-32768, math.min(32764, math.floor(value + 0.5))) & 0xFFFF
  bits = math.min((bits + 2) >> 2, bits >= 0x8000 and 0x3FFF or 0x1FFF)
  return string.char(bits & 0x7F, bits >> 7)
end

local function record_of(pose, mode)
  local p, values = pose.position, nil
  if mode == "Y" then
    local turns = pose.rpy
    values = {turns[3] / math.pi, turns[2] / math.pi, turns[1] / math.pi}
  else
    local x, y, z = pose:rotate {1, 0, 0}, pose:rotate {0, 1, 0}, pose:rotate {0, 0, 1}
    values = {x.x, y.x, z.x, x.y, y.y, z.y, x.z, y.z, z.z}
  end
  local parts = {word_bytes(p.x / full * 32768), word_bytes(p.y / full * 32768), word_bytes(p.z / full * 32768)}
  for _, value in ipairs(values) do parts[#parts + 1] = word_bytes(value * 32768) end
  local bytes = table.concat(parts)
  return string.char(bytes:byte(1) | 0x80) .. bytes:sub(2)
end

-- processes one byte of a command
local function obey(flock, state, byte)
  local code = byte:byte()
  if state.skip > 0 then
    state.skip = state.skip - 1
  elseif code >= 0xF0 then
    state.bird = code - 0xF0
  elseif byte == "P" then
    state.skip = 2  -- the parameter and its value
  elseif byte == "Y" or byte == "Z" then
    state.modes[state.bird] = byte
  elseif byte == "B" then
    local pose = flock.poses[state.bird]
    if pose then flock:send(record_of(pose, state.modes[state.bird] or "Z")) end
  end
end

local function serve(flock)
  local state = {bird = 1, skip = 0, modes = {}}
  while true do
    local bytes = flock:receive()
    if not bytes then return end
    for byte in bytes:gmatch "." do obey(flock, state, byte) end
  end
end

--- Simulates a Flock of Birds on a pseudo-terminal.
---@param options? table
---@option birds? integer [1 to 3] = 1
---@option poses? pose[]  of the birds, in the frame of the transmitter; the field `poses` of the result can be changed
---@option flip_bytes? number [0 to 1] = 0  fraction of the bytes in which a bit is changed
---@option lose_bytes? number [0 to 1] = 0  fraction of the bytes that are lost
---@option delay? number [s, >= 0] = 0  before each record
---@option seed? integer [0 to 9007199254740992] = 1
---@return table flock # `path`, `poses`, `unplug()`, `close()`
---@effect edits
--- > simulated = clench.devices.simulated.flock {birds = 2}
--- > #simulated.poses  --> 2
--- > simulated:close()
--- > simulated.path:find "^/dev/" ~= nil  --> true
return function(options)
  return new_line("flock", options, function(o)
    local birds, given, poses = o:get "birds", o:raw "poses" or {}, {}
    if type(given) ~= "table" or #given > 3 then o:expected("poses", "a list of poses", given) end
    for i = 1, math.max(birds, #given) do
      local pose = given[i] or clench.pose {}
      if clench.type(pose) ~= "pose" then o:expected(("poses[%d]"):format(i), "a pose", pose) end
      poses[i] = pose
    end
    return {poses = poses}
  end, serve)
end
