-- Manipulators of the viewer, dragged by synthetic input and compared with the equivalent calls.
local test, clench = require "test", require "clench"

local function open(select, tool, options)
  local session = clench.session()
  session:open("worlds/barrett_mug.wld", {root = "."})
  local view = clench.view.offscreen {session = session, size = {640, 480}}
  view.panels_visible = false
  session.world:body("mug").pose = clench.pose {xyz = {0, 0, 0.4}}
  view:home(true)
  view:tool(tool)
  if select then view:select(select) end
  return session, view
end

local function handle_of(view, name)
  for _, handle in ipairs(view:handles()) do
    if handle.name == name then return handle end
  end
  error("there is no handle " .. name)
end

local function press(view, code, down) view.ui:input {kind = "key", code = code, down = down} end

-- drags a handle so that the point of the world under it moves by a shift
local function pull(view, handle, shift)
  local depth_point = handle.center + handle.axis * 0
  local x0, y0 = view:project(depth_point)
  local x1, y1 = view:project(depth_point + shift)
  view:drag(handle.x, handle.y, handle.x + x1 - x0, handle.y + y1 - y0, {steps = 2})
end

test("an arrow moves only along its axis, and stops at contact, like move_to", function(t)
  local session, view = open("mug", "Translate")
  local mug = session.world:body "mug"
  local before, start = session.world:hash(), mug.pose.position
  pull(view, handle_of(view, "x"), clench.vec3(0.03, 0, 0))
  local shift = mug.pose.position - start
  t.ok(shift.x > 0.02 and shift.x < 0.04, shift.x)
  t.close(shift.y, 0, 1e-12)
  t.close(shift.z, 0, 1e-12)
  session:undo()
  t.equal(session.world:hash(), before)
  pull(view, handle_of(view, "z"), clench.vec3(0, 0, -0.4))
  local other = session.world:clone()
  local copy = mug:in_world(other)
  copy.pose = clench.pose {xyz = start}
  copy:move_to {xyz = start - clench.vec3(0, 0, 0.3)}
  t.close(mug.pose.position.z, copy.pose.position.z, 1e-3)
  t.ok(view.status:find "touches", view.status)
  -- the displacement that contact has left
  t.close(tonumber(view.status:match "^z ([+-][%d.]+) mm") / 1000, mug.pose.position.z - start.z, 1e-4)
  t.equal(#session.history.done, 2)
  view:close()
end)

test("Ctrl snaps to 10 mm and to 15 degrees, Shift keeps to one axis", function(t)
  local session, view = open("mug", "Translate")
  local mug = session.world:body "mug"
  local start = mug.pose.position
  press(view, 341, true)
  pull(view, handle_of(view, "x"), clench.vec3(0.033, 0, 0))
  press(view, 341, false)
  local shift = (mug.pose.position - start).x
  t.close(shift, math.floor(shift / 0.01 + 0.5) * 0.01, 1e-12)
  t.ok(shift > 0.005, shift)
  start = mug.pose.position
  local x, y = view:project(mug.pose * mug.com)
  press(view, 340, true)
  view:drag(x, y, x + 40, y + 13)
  press(view, 340, false)
  shift = mug.pose.position - start
  local count = 0
  for i = 1, 3 do count = count + (math.abs(shift[i]) > 1e-9 and 1 or 0) end
  t.equal(count, 1)
  view:tool "Rotate"
  local ring = handle_of(view, "turn z")
  press(view, 345, true)
  view:drag(ring.x, ring.y, ring.x + 40, ring.y)
  press(view, 345, false)
  local degrees = clench.deg(mug.pose:angle())
  t.close(degrees, math.floor(degrees / 15 + 0.5) * 15, 1e-9)
  t.ok(degrees > 10, degrees)
  view:close()
end)

test("a ring turns about its axis through the center of mass", function(t)
  local session, view = open("mug", "Rotate")
  local mug = session.world:body "mug"
  local center = mug.pose * mug.com
  for _, name in ipairs {"x", "y", "z"} do
    local ring = handle_of(view, "turn " .. name)
    local before = mug.pose
    local line = ring.line
    view:drag(ring.x, ring.y, line[#line - 1], line[#line], {steps = 20})
    local turn = mug.pose * before:inverse()
    t.ok(turn:angle() > 0.3, turn:angle())
    t.close((turn:rotate(ring.axis) - ring.axis):norm(), 0, 1e-9)
    t.close(math.abs(tonumber(view.status:match "([+-][%d.]+)°")), clench.deg(turn:angle()), 0.06)
    t.close((mug.pose * mug.com - center):norm(), 0, 1e-9)
    session:undo()
  end
  view:close()
end)

test("the script of a session with drags makes the same world", function(t)
  local session, view = open(nil, "Translate")
  session:open("worlds/barrett_mug.wld", {root = "."})
  view:select "barrett"
  pull(view, handle_of(view, "z"), clench.vec3(0, 0, 0.05))
  t.ok(session.world:robot("barrett").pose.position.z > 0.15, session.world:robot("barrett").pose)
  local lines = session:script()
  t.ok(lines:find("pose", 1, true), lines)
  view:key "ctrl+z"
  t.close(session.world:robot("barrett").pose.position.z, 0.133, 1e-9)
  view:close()
end)

test("a hand on an arm is dragged by the arm", function(t)
  local session = clench.session()
  session:open("worlds/puma_barrett_glass.wld", {root = "."})
  local view = clench.view.offscreen {session = session, size = {640, 480}}
  view.panels_visible = false
  local hand
  for _, robot in ipairs(session.world.robots) do hand = robot.parent and robot or hand end
  local arm, before = hand.parent, session.world:hash()
  local start = hand.pose
  view:tool "Translate"
  view:select(hand.name)
  view.camera = clench.camera(session.world, {size = {640, 480}, frame = "all"})
  pull(view, handle_of(view, "z"), clench.vec3(0, 0, 0.05))
  local shift = hand.pose.position - start.position
  t.ok(shift.z > 0.02, shift)
  t.close(shift.x, 0, 1e-4)
  t.close(shift.y, 0, 1e-4)
  t.close((hand.pose * start:inverse()):angle(), 0, 1e-4)
  t.equal(hand.parent == arm, true)
  view:key "ctrl+z"
  t.equal(session.world:hash(), before)
  view:close()
end)

test("a click with the Translate tool on a link shows its joints, whose arcs set the DOFs within their limits", function(t)
  local session, view = open(nil, "Translate")
  local robot = session.world:robot "barrett"
  local link = robot:link "chain0_link1"
  local x, y = view:project(link.pose * link.com)
  local hit = view:pick(x, y)
  view:click(x, y)
  t.equal(session.selection[1] == hit.body, true)
  view:select "barrett/barrett_chain0_link1"
  local names = {}
  for i, handle in ipairs(view:handles()) do names[i] = handle.name end
  t.equal(table.concat(names, " "), robot.dof_names[1] .. " " .. robot.dof_names[2])
  local before = session.world:hash()
  local arc = handle_of(view, robot.dof_names[2])
  t.close(arc.value, 0.5, 1e-12)
  -- to the end of the arc and beyond: the upper limit
  local line = arc.line
  view:drag(arc.x, arc.y, line[#line - 1], line[#line], {steps = 8})
  local high = robot.dof_limits[2][2]
  t.ok(robot.dofs[2] > 0.9, robot.dofs[2])
  t.ok(robot.dofs[2] <= high, robot.dofs[2])
  t.close(robot.dofs[1], 0, 1e-12)
  t.close(robot.dofs[3], 0.5, 1e-12)
  -- like the command
  local other = clench.session(session.world:clone())
  other.world:robot("barrett").dofs = {0, 0.5, 0.5, 0.5}
  other:run("grasp.move_dofs", {hand = "barrett", dofs = robot.dofs})
  for i = 1, 4 do t.close(other.world:robot("barrett").dofs[i], robot.dofs[i], 1e-4) end
  view:key "ctrl+z"
  t.equal(session.world:hash(), before)
  view:close()
end)

test("the axis of a joint handle is that of the joint, and Ctrl snaps the DOF", function(t)
  local session, view = open("barrett/barrett_chain2_link0", "Translate")
  local robot = session.world:robot "barrett"
  local arc = handle_of(view, robot.dof_names[4])
  local link = robot:link "chain2_link0"
  local before = link.pose
  robot.dofs = {0, 0.5, 0.5, 0.8}
  local turn = link.pose * before:inverse()
  t.close((turn * arc.center - arc.center):norm(), 0, 1e-9)
  t.close((turn:rotate(arc.axis) - arc.axis):norm(), 0, 1e-9)
  arc = handle_of(view, robot.dof_names[4])
  press(view, 341, true)
  view:drag(arc.x, arc.y, arc.line[1], arc.line[2], {steps = 6})
  press(view, 341, false)
  local degrees = clench.deg(robot.dofs[4])
  t.close(degrees, math.floor(degrees / 15 + 0.5) * 15, 1e-9)
  t.ok(math.abs(robot.dofs[4] - 0.8) > 0.02, degrees)
  view:close()
end)

test("a prismatic joint has an arrow between its limits", function(t)
  local session = clench.session()
  session:open("worlds/parallel_jaw_cube.wld", {root = "."})
  local view = clench.view.offscreen {session = session, size = {640, 480}}
  view.panels_visible = false
  local robot = session.world.robots[1]
  robot:open()
  view.camera = clench.camera(session.world, {size = {640, 480}, frame = "all"})
  view:tool "Translate"
  view:select(view:address(robot.links[1]))
  local arrow = view:handles()[1]
  local start = robot.dofs[arrow.dof]
  local line = arrow.line
  view:drag(arrow.x, arrow.y, (line[1] + line[3]) / 2, (line[2] + line[4]) / 2, {steps = 6})
  local low, high = robot.dof_limits[arrow.dof][1], robot.dof_limits[arrow.dof][2]
  t.ok(math.abs(robot.dofs[arrow.dof] - start) > 0.1 * (high - low), robot.dofs[arrow.dof])
  t.close(robot.dofs[arrow.dof], (low + high) / 2, 0.25 * (high - low))
  view:close()
end)

test("a drag that starts in collision is refused in the status bar, and nothing moves", function(t)
  local session, view = open("mug", "Translate")
  local mug, hand = session.world:body "mug", session.hand
  mug.pose = hand.bodies[1].pose
  view:home(true)
  view:frame()
  local before = session.world:hash()
  for _, name in ipairs {"x", "y", "z"} do
    pull(view, handle_of(view, name), clench.vec3(0.01, 0.01, 0.01))
    t.ok(view.status:find "the motion starts in collision", view.status)
    t.equal(session.world:hash(), before)
  end
  view:close()
end)
