-- Repeats the statements of a calls.lua, continuing after errors, and prints the errors.
--   clench -q run tests/fuzz/repeat.lua calls.lua
local call = dofile((arg[0]:match "^(.*/)" or "") .. "call.lua")
clench.log.level "quiet"
local chunk = assert(loadfile(arg[1], "t", {call = function(...)
  local ok, message = call.run(...)
  if not ok then print(message) end
end}))
chunk()
os.exit(call.findings > 0 and 3 or 0, true)
