-- Clients that send short requests to the server of tests/bench/serve.lua without pause: half of them one at a time, the others twenty at a time.
--   clench -q run tests/bench/serve_load.lua PORT TOKEN COUNT    until the server is closed, or a signal
local clench = require "clench"
local requests = dofile "tests/bench/serve_requests.lua"

local port, token, count = tonumber(arg[1]), arg[2], tonumber(arg[3])
for i = 1, count do
  local case, depth = requests.small[i % #requests.small + 1], i % 2 == 0 and 20 or 1
  local client = requests.connect(port, case.rpc and token)
  clench.loop.spawn(function()
    while true do
      client:write(case.line:rep(depth))
      for _ = 1, depth * case.lines do
        if not client:read_line(10) then return end
      end
    end
  end)
end
print "ready"
io.stdout:flush()
clench.loop.run()
