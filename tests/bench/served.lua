-- The process that tests/bench/serve.lua measures: a server of a world, and beside it one that sends each line back over the same ports.
-- Prints both ports, the port of the live page (0 without three.js) and the token.
--   clench -q run tests/bench/served.lua [HZ]    HZ: the object is moved so often
local clench = require "clench"
local loop = clench.loop

local world = clench.load "worlds/barrett_mug.wld"
local http = require "clench.page.three"() and 0 or nil
local server = clench.control.server {world = world, port = 0, http = http, control = http and true, max_clients = 100}
local listener = clench.port.listen {port = 0}

local function echo(port)
  local watch
  watch = loop.on(port.stream:descriptor(), function()
    local _, ending = port:fill()
    local line = port:take_line()
    while line do
      port:send(line .. "\n")
      line = port:take_line()
    end
    if ending then
      watch:remove()
      port:close()
    end
  end)
end

loop.spawn(function()
  while true do echo(listener:accept()) end
end)

if arg[1] then
  local object, up = world.objects[1], false
  local low = object.pose
  local high = clench.pose {xyz = low.position + clench.vec3(0, 0, 0.01), quat = low.quat}
  loop.every(1 / tonumber(arg[1]), function()
    up = not up
    object.pose = up and high or low
  end)
end

print(server.port, listener.port, server.http or 0, server.token)
io.stdout:flush()
loop.run()
