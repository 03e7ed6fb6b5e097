-- Functions that no longer take part in a world's runs.
local test, clench = require "test", require "clench"

test("functions that are removed release what they hold, whether the world runs or not", function(t)
  local world = clench.world()
  local held = setmetatable({}, {__mode = "k"})
  local function something()
    local thing = {}
    held[thing] = true
    return thing
  end
  local called = {}
  local first = world:on("contact", function() end)
  for i = 1, 3 do
    local thing, other, third = something(), something(), something()
    local handles = {world:on("contact", function() return thing end), world:on_step(function() return other end),
                     world:spawn(function(task) local _ <close> = setmetatable({}, {__close = function() called[#called + 1] = i end}) task.wait(1) return third end)}
    if i == 2 then world:run(0.01) end
    if i == 3 then world:on_step(function() for _, handle in ipairs(handles) do handle:remove() end end) end
    if i == 3 then world:run(0.02) else for _, handle in ipairs(handles) do handle:remove() end end
    for _, handle in ipairs(handles) do t.equal(handle.status, "removed") handle:remove() end
  end
  t.equal(called, {2})  -- the others had not begun
  t.equal(first.status, "waiting")
  collectgarbage()
  local count = 0
  for _ in pairs(held) do count = count + 1 end
  t.ok(count <= 3, count)  -- the function that removed the last ones still holds their handles
end)
