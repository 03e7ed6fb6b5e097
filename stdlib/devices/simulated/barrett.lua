local loop = clench.loop
local new_line = require "clench.devices.simulated.line"

local last = {["1"] = 17800, ["2"] = 17800, ["3"] = 17800, S = 3150}  -- largest position [counts]
local order = {"1", "2", "3", "S"}

local function new_motor() return {P = 0, DP = 0, BD = 0, BP = 0, SAMPLE = 10, ACCEL = 2, MCV = 100, MOV = 100} end

local function go_to(hand, letter, position)
  local motor = hand.motors[letter]
  motor.P = math.max(0, math.min(last[letter], position))
end

-- commands that move; each receives the motor's letter, and the number after the command
local motions = {
  HI = function(hand, letter) hand.is_ready = true go_to(hand, letter, 0) end,
  HOME = function(hand, letter) go_to(hand, letter, 0) end,
  O = function(hand, letter) go_to(hand, letter, 0) end,
  C = function(hand, letter) go_to(hand, letter, last[letter]) end,
  TO = function(hand, letter) go_to(hand, letter, 0) end,
  TC = function(hand, letter) go_to(hand, letter, last[letter]) end,
  IO = function(hand, letter, n) go_to(hand, letter, hand.motors[letter].P - (n or 500)) end,
  IC = function(hand, letter, n) go_to(hand, letter, hand.motors[letter].P + (n or 500)) end,
  M = function(hand, letter, n) go_to(hand, letter, n or hand.motors[letter].DP) end,
}

local function letters_of(prefix)
  local chosen = {}
  for _, letter in ipairs(order) do
    if prefix == "" or prefix:find(letter, 1, true) then chosen[#chosen + 1] = letter end
  end
  return chosen
end

-- the reply to a command: its text, and its duration [s]
local function obey(hand, command)
  local prefix, rest = command:match "^([123S]*)(.*)$"
  local chosen = letters_of(prefix)
  local name = rest:match "^FGET (%u+)$"
  if name then
    local values = {}
    for i, letter in ipairs(chosen) do values[i] = tostring(hand.motors[letter][name] or "?") end
    return hand.motors["1"][name] and table.concat(values, " ") or "ERR 8", 0
  end
  local setting, value = rest:match "^FSET (%u+) (%d+)$"
  if setting then
    if not hand.motors["1"][setting] or setting == "P" then return "ERR 8", 0 end
    for _, letter in ipairs(chosen) do
      if setting == "DP" and tonumber(value) > last[letter] then return "ERR 16", 0 end
      hand.motors[letter][setting] = tonumber(value)
    end
    return "", 0
  end
  if rest == "T" then hand.stops = hand.stops + 1 return "", 0 end
  local verb, number = rest:match "^(%u+) ?(%d*)$"
  local move = motions[verb]
  if not move then return "ERR 2", 0 end
  if not hand.is_ready and verb ~= "HI" then return "ERR 1", 0 end
  for _, letter in ipairs(chosen) do move(hand, letter, tonumber(number)) end
  return "", hand.move_time
end

local function serve(hand)
  local waiting = ""
  while true do
    local bytes = hand:receive()
    if not bytes then return end
    waiting = waiting .. bytes
    while true do
      local command, rest = waiting:match "^(.-)\r(.*)$"
      if not command then break end
      waiting = rest
      local reply, seconds = obey(hand, command)
      if seconds > 0 then loop.sleep(seconds) end
      hand:send(command .. "\r\n" .. (reply ~= "" and reply .. "\r\n" or "") .. "=> ")
    end
  end
end

--- Simulates a Barrett hand BH8-262 on a pseudo-terminal.
---@param options? table
---@option move_time? number [s, >= 0] = 0  of each motion
---@option flip_bytes? number [0 to 1] = 0  fraction of the bytes in which a bit is changed
---@option lose_bytes? number [0 to 1] = 0  fraction of the bytes that are lost
---@option delay? number [s, >= 0] = 0  before each reply
---@option seed? integer [0 to 9007199254740992] = 1
---@return table hand # `path`, `unplug()`, `close()`; `motors`, `stops`: number of times that the motors were switched off
---@effect edits
--- > simulated = clench.devices.simulated.barrett {}
--- > line = clench.port.serial {path = simulated.path}
--- > line:write "123SFGET P\r"
--- > line:read_until("=> ", 1):find "0 0 0 0" ~= nil  --> true
--- > simulated:close()
--- > simulated.path:find "^/dev/" ~= nil  --> true
return function(options)
  return new_line("barrett", options, function(o)
    local motors = {}
    for _, letter in ipairs(order) do motors[letter] = new_motor() end
    return {motors = motors, stops = 0, move_time = o:get "move_time"}
  end, serve)
end
