-- The live page in Chromium: it shows the world, follows it while clients move it, and moves it where the server allows that.
local test, clench = require "test", require "clench"
local browser = dofile "tests/lua/browser.lua"
local find_three = require "clench.page.three"
local loop = clench.loop

local three, missing = find_three()

-- a world of a hand and a mug, its server, and a browser that shows it
local function show(t, options)
  if not three then t.skip(missing) end
  if not browser.is_installed() then t.skip "chromium is not installed" end
  local world = clench.load("worlds/barrett_mug.wld", {root = "."})
  options = options or {}
  options.world, options.port, options.http = world, 0, 0
  local server = clench.control.server(options)
  local ok, page = pcall(browser.open, server.url, test.path())
  if not ok then
    server:close()
    error(page, 0)
  end
  page:await("document.documentElement.dataset.drawn !== undefined", 60)
  return server, world, page
end

-- waits until the page shows the world as it is now
local function settle(page)
  page:evaluate [[new Promise(resolve => requestAnimationFrame(() => requestAnimationFrame(resolve)))]]
end

-- red, green, blue and opacity of points of the view in a grid of 60 x 60, in a list
local sampler = [[(() => {
  draw();
  const gl = renderer.getContext(), w = gl.drawingBufferWidth, h = gl.drawingBufferHeight, all = new Uint8Array(4 * w * h), out = [];
  gl.readPixels(0, 0, w, h, gl.RGBA, gl.UNSIGNED_BYTE, all);
  for (let y = 0; y < 60; ++y) for (let x = 0; x < 60; ++x) {
    const at = 4 * (w * Math.floor(h * (y + 0.5) / 60) + Math.floor(w * (x + 0.5) / 60));
    out.push(...all.slice(at, at + 4));
  }
  return out;
})()]]

local function samples(page)
  settle(page)
  return page:evaluate(sampler)
end

local function changed(a, b)
  local count = 0
  for i = 1, #a, 4 do
    local most = 0
    for k = 0, 3 do most = math.max(most, math.abs(a[i + k] - b[i + k])) end
    if most > 30 then count = count + 1 end
  end
  return count
end

local function dof_of(page) return page:evaluate "latest.robots[0].dofs" end

test("in Chromium the live page shows a hand, and moves with it when a client moves a DOF", function(t)
  local server <close>, world, page = show(t)
  local hand = world.robots[1]
  local _ <close> = page
  page:evaluate "void scene.remove(grid)"
  local before = samples(page)
  t.equal(changed(before, samples(page)), 0)  -- nothing moves by itself
  local drawn = 0
  for i = 4, #before, 4 do drawn = drawn + (before[i] > 0 and 1 or 0) end
  t.ok(drawn > 150 and drawn < 2500, drawn)

  local client = clench.port.connect("127.0.0.1", server.port)
  client:write "moveDOFs 0 4 0 1.2 1.2 1.2 0.05 0.05 0.05 0.05\n"
  for _ = 1, #hand.dofs do t.ok(client:read_line(10)) end
  browser.await(function() return math.abs(dof_of(page)[2] - hand.dofs[2]) < 1e-12 end, 10, "the new DOFs")
  local after = samples(page)
  t.ok(changed(before, after) > 20, changed(before, after))
  -- back where it was, it looks as before
  client:write "moveDOFs 0 4 0 0.5 0.5 0.5 0.05 0.05 0.05 0.05\n"
  for _ = 1, #hand.dofs do t.ok(client:read_line(10)) end
  browser.await(function() return math.abs(dof_of(page)[2] - hand.dofs[2]) < 1e-12 end, 10, "the old DOFs")
  t.ok(changed(before, samples(page)) < 4)

  -- contacts that the simulation presses: cones, arrows and rows
  hand:autograsp()
  hand.controller = "position"
  hand:set_targets {0, 2, 2, 2}
  world:run(0.05)
  page:await("latest.contacts.length >= 2 && Math.max(...latest.contacts.map(c => magnitude(c.force))) > 0.01")
  settle(page)
  t.equal(page:evaluate "cones.children.length", 2 * page:evaluate "latest.contacts.length")
  t.ok(page:evaluate "arrows.children.length" >= 2)
  t.equal(page:evaluate "document.querySelectorAll('#touches tr').length", 1 + page:evaluate "latest.contacts.length")
  t.ok(page:evaluate "document.getElementById('scale').textContent":find "^longest arrow: %d")
  t.equal(page:faults(), "")
  local picture = os.getenv "CLENCH_PAGE_PICTURE"
  if picture then clench.files.save_text(picture, page:picture()) end
end)

test("in Chromium frames arrive while the world runs, and plots, tree and camera answer the reader", function(t)
  local server <close>, world, page = show(t)
  local _ <close> = page
  local frames = tonumber(page:evaluate "document.documentElement.dataset.frames")
  page:evaluate "choice.value = 'mug: z [m]'; document.getElementById('plot').click()"
  local last = loop.time() + 20
  repeat
    world:run(0.01)
    loop.sleep(0.02)
    local now = tonumber(page:evaluate "document.documentElement.dataset.frames")
  until now > frames + 10 or loop.time() > last
  t.ok(tonumber(page:evaluate "document.documentElement.dataset.frames") > frames + 10)
  t.ok(page:evaluate "plots.get('mug: z [m]').points.length" > 5)
  page:await("latest.time === " .. ("%.17g"):format(world.time))
  t.equal(page:evaluate "document.querySelector('#view .shown').textContent", ("%.3f s"):format(world.time))

  t.equal(page:evaluate "[...document.querySelectorAll('#dofs label span')].map(one => one.textContent)", world.robots[1].dof_names)
  local names = page:evaluate "[...document.querySelectorAll('#bodies label')].map(one => one.textContent.trim())"
  t.equal(#names, #world.bodies)
  local before = samples(page)
  page:evaluate "[...document.querySelectorAll('#bodies details input')].forEach(one => one.click())"
  t.ok(changed(before, samples(page)) > 100)  -- the hand is hidden
  page:evaluate "document.getElementById('top').click()"
  t.close(page:evaluate "orbit.elevation", 1.55, 1e-12)

  -- without control no request of the page moves anything, and its sliders are still
  t.ok(page:evaluate "rows.get('barrett').inputs.every(one => one.disabled)")
  local hash = world:hash()
  t.ok(page:evaluate("call('grasp.dofs', {hand: 'barrett', dofs: [0, 1, 1, 1]}).then(() => '', error => error.message)"):find("shows the world only", 1, true))
  t.equal(world:hash(), hash)
  -- another shape needs another page, which comes without being asked for; so does the connection, if it is lost
  world:add_obstacle(clench.shapes.box {0.1, 0.1, 0.1}, {name = "<b>box</b>", pose = {xyz = {0.3, 0, 0}}})
  server.session:emit("changed", {command = "test"})
  browser.await(function()
    return page:evaluate "document.documentElement && document.documentElement.dataset.drawn !== undefined && data.parts.some(part => part.name === '<b>box</b>')"
  end, 60, "the new page")
  t.equal(page:evaluate "document.querySelectorAll('#bodies b').length", 0)
  for _, client in ipairs {table.unpack(server.clients)} do client:close() end
  page:await "stats.connected === 'false'"
  page:await("stats.connected === 'true'", 30)
  t.equal(page:faults(), "")
end)

test("in Chromium a slider moves a DOF where the server has control", function(t)
  local server <close>, world, page = show(t, {control = true})
  local _ <close> = page
  local hand = world.robots[1]
  local before = hand.dofs
  page:evaluate [[(() => { const input = rows.get("barrett").inputs[1]; input.value = 1; input.dispatchEvent(new Event("input")); })()]]
  browser.await(function() return math.abs(hand.dofs[2] - 1) < 1e-6 end, 20, "the DOF")
  t.equal(hand.dofs[3], before[3])
  page:await "Math.abs(latest.robots[0].dofs[1] - 1) < 1e-6"
  page:evaluate "[...document.querySelectorAll('#dofs button')][0].click()"
  browser.await(function() return hand.dofs[2] == before[2] end, 20, "the undo")
  t.equal(#server.session.history.done, 0)
  t.equal(page:faults(), "")
end)

test("in Chromium a page of another origin cannot connect", function(t)
  local reasons = {}
  local server <close>, _, page = show(t, {token = false, on_close = function(client) reasons[client.reason] = true end})
  local _ <close> = page
  -- a frame of a page in a sandbox has the origin "null"; the page's policy lets it try
  local refused = page:evaluate(([[new Promise(resolve => {
    const frame = document.createElement("iframe");
    frame.srcdoc = "<script>const s = new WebSocket('ws://127.0.0.1:%d/socket'); s.onopen = () => parent.postMessage('open', '*'); s.onerror = () => parent.postMessage('refused', '*');</scr" + "ipt>";
    frame.sandbox = "allow-scripts";
    window.addEventListener("message", event => resolve(event.data));
    document.body.append(frame);
  })]]):format(server.http))
  t.equal(refused, "refused")
  t.ok(reasons["Origin: another page may not connect"], clench.json.encode(reasons))
end)
