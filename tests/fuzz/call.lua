-- Runs one statement of the API's fuzzer, and checks its outcome: a message or a warning that is not a sentence, a number that is not finite, or a
-- call that takes seconds is printed as `FINDING <statement> <signature>`, once.
local here = debug.getinfo(1, "S").source:match "^@(.*/)" or ""
local deadline = require "clench.deadline"
local judge = dofile(here .. "judge.lua")
local env = dofile(here .. "values.lua").environment()

-- time limit of a call of the engine, as the time limit of a search [s]
local patience = 5
-- a call that takes longer, even under sanitizers, which slow it down tenfold, is a finding [s]
local max_seconds = 30

local impatience = "the statement takes too long"

local call = {findings = 0, number = 0, v = env.v}
local said = {}

local function finding(what, text)
  local signature = judge.signature(what, text)
  if said[signature] then return end
  said[signature] = true
  call.findings = call.findings + 1
  print(("FINDING %d %s"):format(call.number, signature))
end

-- messages that the engine logs are checked; a script's own messages are not
local function listen(name)
  clench.log.level "info"
  clench.log.sink(function(_, text, about)
    local bad = about and judge.text(text)
    if bad then finding("message", name .. ": " .. bad) end
  end)
end

---@param text string
---@param name string  of the called entry
---@param target? integer  index of v that it sets
---@param sensible? boolean  whether all arguments are finite and as documented
---@return boolean ok
---@return any result  the value, or the message
function call.run(text, name, target, sensible)
  call.number = call.number + 1
  local chunk = assert(load(text, "=fuzz", "t", env))
  listen(name)
  local began = os.clock()
  local limit = deadline(patience)
  -- stops loops of the statement itself, outside of engine calls
  debug.sethook(function()
    if os.clock() - began > patience then error(impatience, 0) end
  end, "", 1000000)
  local ok, message = pcall(chunk)
  debug.sethook()
  limit:close()
  if os.clock() - began > max_seconds then finding("slow", name) end
  clench.log.sink()
  if not ok then
    local bad = message ~= impatience and judge.message(message)
    if bad then finding("message", name .. ": " .. bad) end
    return false, message
  end
  local value = target and env.v[target]
  local bad = sensible and judge.value(value, name)
  if bad then finding("not finite", bad) end
  return true, value
end

return call
