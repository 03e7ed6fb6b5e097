-- Several selected bodies and robots, dragged together by synthetic input.
local test, clench = require "test", require "clench"

-- two cubes that touch each other, the second one next to a wall, 50 mm away in +x
local function open(tool)
  local session = clench.session()
  local world = clench.world()
  local cube = clench.shapes.box {0.04, 0.04, 0.04}
  local a = world:add_object(cube, {name = "a", pose = {xyz = {-0.05, 0, 0}}})
  local b = world:add_object(cube, {name = "b", pose = {xyz = {-0.01, 0, 0}}})
  local wall = world:add_obstacle(clench.shapes.box {0.02, 0.3, 0.3}, {name = "wall", pose = {xyz = {0.07, 0, 0}}})
  session = clench.session(world)
  local view = clench.view.offscreen {session = session, size = {640, 480}}
  view.panels_visible = false
  view.camera = {eye = clench.vec3(-0.1, -0.6, 0.25), target = clench.vec3(0, 0, 0), up = clench.vec3(0, 0, 1), field_of_view = 0.6}
  view:tool(tool)
  session:run("world.select", {addresses = {"a", "b"}})
  view:frame()
  return session, view, a, b, wall
end

local function handle_of(view, name)
  for _, handle in ipairs(view:handles()) do
    if handle.name == name then return handle end
  end
  error("there is no handle " .. name)
end

-- drags a handle so that its center moves by a shift
local function pull(view, handle, shift)
  local x0, y0 = view:project(handle.center)
  local x1, y1 = view:project(handle.center + shift)
  view:drag(handle.x, handle.y, handle.x + x1 - x0, handle.y + y1 - y0, {steps = 3})
end

-- the displacements of bodies are one
local function same_displacement(t, bodies, starts)
  local first = bodies[1].pose * starts[1]:inverse()
  for i, body in ipairs(bodies) do
    local off = (body.pose * starts[i]:inverse()):inverse() * first
    t.close({off.position:norm(), off:angle()}, {0, 0}, 1e-9)
  end
  return first
end

test("an arrow moves all selected bodies by one displacement, as one step of undo that the script repeats", function(t)
  local session, view, a, b = open "Translate"
  local before, starts = session.world:hash(), {a.pose, b.pose}
  local steps = #session.history.done
  pull(view, handle_of(view, "z"), clench.vec3(0, 0, 0.03))
  local moved = same_displacement(t, {a, b}, starts)
  t.ok(math.abs(moved.position.z - 0.03) < 0.005, moved.position.z)
  t.close({moved.position.x, moved.position.y}, {0, 0}, 1e-9)
  t.equal(session.world:may_collide(a, b), true)
  t.equal(#session.history.done, steps + 1)
  t.equal(session.history.done[#session.history.done].label, "Translate a and 1 more")
  local after, lines = session.world:hash(), session.history.done[#session.history.done].lines
  session:undo()
  t.equal(session.world:hash(), before)
  load("local clench, world = ... " .. lines)(clench, session.world)
  t.equal(session.world:hash(), after)
  view:close()
end)

test("contact of one of them stops all of them", function(t)
  local session, view, a, b, wall = open "Translate"
  local starts = {a.pose, b.pose}
  pull(view, handle_of(view, "x"), clench.vec3(0.15, 0, 0))
  local moved = same_displacement(t, {a, b}, starts)
  local gap = session.world:distance(b, wall)
  t.ok(gap > 0 and gap <= session.world.contact_threshold, gap)
  t.close(moved.position.x, 0.05, session.world.contact_threshold + 1e-9)
  t.ok(view.status:find "b touches wall" or view.status:find "wall touches b", view.status)
  -- away from the wall, the nearer cube does not wait for the other
  pull(view, handle_of(view, "x"), clench.vec3(-0.05, 0, 0))
  t.ok(same_displacement(t, {a, b}, starts).position.x < 0.02, a.pose)
  view:close()
end)

test("a ring turns them about the center of mass of the one that is dragged", function(t)
  local _, view, a, b = open "Rotate"
  local starts = {a.pose, b.pose}
  local ring = handle_of(view, "turn y")
  view:drag(ring.x, ring.y, ring.x, ring.y - 40, {steps = 4})
  local moved = same_displacement(t, {a, b}, starts)
  t.ok(moved:angle() > 0.1, moved:angle())
  t.close((a.pose.position - starts[1].position):norm(), 0, 1e-9)
  t.close((b.pose.position - a.pose.position):norm(), 0.04, 1e-9)
  view:close()
end)

test("a free drag of one of several selected bodies moves all of them and keeps the selection; that of another body moves it alone", function(t)
  local session, view, a, b = open "Translate"
  local starts = {a.pose, b.pose}
  local other = session.world:add_object(clench.shapes.box {0.03, 0.03, 0.03}, {name = "c", pose = {xyz = {-0.1, 0, 0.08}}})
  local x, y = view:project(clench.vec3(-0.055, -0.02, -0.015))
  view:drag(x, y, x - 20, y + 15)
  t.ok(same_displacement(t, {a, b}, starts).position:norm() > 0.01)
  t.equal(#session.selection, 2)
  starts = {a.pose, b.pose}
  x, y = view:project(other.pose.position)
  view:drag(x, y, x + 20, y - 20)
  t.ok((other.pose.position - clench.vec3(-0.1, 0, 0.08)):norm() > 0.01)
  t.equal({(a.pose.position - starts[1].position):norm(), #session.selection}, {0, 1})
  view:close()
end)

test("an arm carries its hand along; a hand on an arm that is not selected is not dragged with others", function(t)
  local session = clench.session()
  session:open("worlds/puma_barrett_glass.wld", {root = "."})
  local view = clench.view.offscreen {session = session, size = {640, 480}}
  view.panels_visible = false
  view:tool "Translate"
  local hand
  for _, robot in ipairs(session.world.robots) do hand = robot.parent and robot or hand end
  local arm, glass, before = hand.parent, session.world.objects[1], session.world:hash()
  session:run("world.select", {addresses = {hand.name, glass.name}})
  view:home(true)
  view:frame()
  pull(view, handle_of(view, "z"), clench.vec3(0, 0, 0.1))
  t.equal(session.world:hash(), before)
  t.equal(view.status, ("%s is mounted on %s: select %s, too, or %s alone"):format(hand.name, arm.name, arm.name, hand.name))
  session:run("world.select", {addresses = {arm.name, hand.name, glass.name}})
  view:home(true)
  view:frame()
  local starts = {arm.pose, hand.pose, glass.pose}
  pull(view, handle_of(view, "z"), clench.vec3(0, 0, 0.1))
  t.ok(same_displacement(t, {arm, hand, glass}, starts).position.z > 0.05)
  view:close()
end)
