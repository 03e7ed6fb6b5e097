-- Repeats the statements of a calls.lua, each whatever became of those before it, with the errors that they raise.
--   clench -q run tests/fuzz/repeat.lua calls.lua
local call = dofile((arg[0]:match "^(.*/)" or "") .. "call.lua")
clench.log.level "quiet"
local chunk = assert(loadfile(arg[1], "t", {call = function(...)
  local ok, message = call.run(...)
  if not ok then print(message) end
end}))
chunk()
os.exit(call.findings > 0 and 3 or 0, true)
