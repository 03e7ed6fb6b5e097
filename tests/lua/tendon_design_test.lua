-- Tendon routes that hold a grasp: two mirrored fingers, whose torques must be equal: their contacts are opposite, so friction
-- along the fingers would turn the object.
local test, clench = require "test", require "clench"

-- a finger along x, beside the x axis by y [mm], with a box whose far edge presses
local function chain(number, y, turn)
  return ([[<chain><transform><translation>0 %g 0</translation><rotation>%d x</rotation></transform>
    <joint type="Revolute"><theta>d%d</theta><d>0</d><a>50</a><alpha>0</alpha><minValue>-10</minValue><maxValue>90</maxValue></joint>
    <link dynamicJointType="Revolute">link.iv</link></chain>]]):format(y, turn, number)
end

-- from the base to the link, past the joint on the side of the object
local function tendon(number, sign)
  return ([[<tendon name="t%d"><stiffness>0</stiffness>
    <insertionPoint><chain>-1</chain><link>-1</link><position>-20 %g 0</position></insertionPoint>
    <insertionPoint><chain>%d</chain><link>0</link><position>-40 5 0</position></insertionPoint></tendon>]]):format(number, sign * 15, number)
end

local dof = [[<dof type="r"><defaultVelocity>1</defaultVelocity><maxEffort>1e10</maxEffort></dof>]]

-- two fingers that close on a box between them
local function closed_hand()
  local folder = test.folder()
  assert(os.execute("mkdir " .. folder .. "/iv"))
  clench.files.save_text(folder .. "/iv/palm.iv", "#Inventor V2.1 ascii\nSeparator { Translation { translation -30 0 0 } Cube { width 10 height 10 depth 10 } }")
  clench.files.save_text(folder .. "/iv/link.iv", "#Inventor V2.1 ascii\nSeparator { Translation { translation -20 0 0 } Cube { width 20 height 4 depth 10 } }")
  clench.files.save_text(folder .. "/hand.xml", '<robot type="Hand"><palm>palm.iv</palm>' .. dof .. dof .. chain(0, -20, 0) .. chain(1, 20, 180)
                         .. tendon(0, -1) .. tendon(1, 1) .. "</robot>")
  local world = clench.world()
  local hand = world:add_robot(folder .. "/hand.xml")
  local object = world:add_object(clench.shapes.box {0.03, 0.035, 0.01}, {pose = {xyz = {0.03, 0, 0}}})
  world:set_friction(object.material, hand.links[1].material, {static = 0.05, kinetic = 0.05})
  hand:autograsp()
  return hand, object
end

test("torques of mirrored fingers become equal: moment arms in inverse proportion to the pulls", function(t)
  local hand, object = closed_hand()
  local grasp = clench.grasp(hand, object)
  t.ok(#grasp.contacts >= 2)
  local found = clench.study.tendon_design(grasp, {pulls = {t0 = 5, t1 = 8}})
  t.ok(found.first_error > 1e-3, found.first_error)
  t.equal(found.status, "balanced")
  -- the DOFs close with one sense, so equal torques press equally
  t.close(found.torques[1], found.torques[2], 1e-5)
  local routes = require "clench.tendon_routes"
  local arms = {}
  for i, name in ipairs {"t0", "t1"} do arms[i] = routes.arms(hand, {points = found.points[name]})[i] end
  t.close(arms[1] * 5, arms[2] * 8, 1e-5)
  for i, shift in ipairs(found.shifts) do
    t.ok(shift.value >= -0.005 and shift.value <= 0.005)
    t.equal(#shift.points, 2, i)
  end
  local stable = grasp:equilibrium {torques = found.torques}
  t.ok(stable.status == "stable" or stable.residual and stable.residual < 1e-3, stable.status)
end)

test("where no route balances the joints, the nearest is at the end of its range", function(t)
  local hand, object = closed_hand()
  local grasp = clench.grasp(hand, object)
  local only = {{tendon = "t0", points = {1, 2}, range = {-0.001, 0.001}}}
  local found = clench.study.tendon_design(grasp, {pulls = {t0 = 1, t1 = 20}, shifts = only})
  t.equal(found.status, "nearest")
  t.close(math.abs(found.shifts[1].value), 0.001, 1e-9)
  t.ok(found.error < found.first_error)
  -- two torques nearest to a, b that are equal are both their mean
  t.close(found.error, math.abs(found.torques[1] - found.torques[2]) / math.sqrt(2), 1e-6)
  t.equal(clench.study.tendon_design(grasp, {load = {0, 9, 0, 0, 0, 0}, max_force = 1}).status, "infeasible")
end)

test("wrong tendons and shifts are reported", function(t)
  local hand, object = closed_hand()
  local grasp = clench.grasp(hand, object)
  local function fails(options, ...) local words = {...} t.fails(function() clench.study.tendon_design(grasp, options) end, table.unpack(words)) end
  fails({pulls = {t7 = 1}}, "pulls: there is no tendon 't7'")
  fails({pulls = {t0 = -1}}, "pulls: expected forces >= 0")
  fails({shifts = {{tendon = "t0", points = {3}}}}, "shifts[1]: points: expected numbers from 1 to 2, got 3")
  fails({shifts = {{tendon = "t0", points = {1}, range = {1, 0}}}}, "shifts[1]: range")
  fails({shifts = {{tendon = "x", points = {1}}}}, "shifts[1]: there is no tendon 'x'")
  fails({shiffs = {}}, "unknown key 'shiffs'")
  t.fails(function() clench.study.tendon_design(3) end, "expected a grasp, got 3")
end)

test("the panel Tendons finds the routes of the study, with the pulls that it shows", function(t)
  local hand, object = closed_hand()
  local session = clench.session(hand.world)
  session.hand, session.object = hand, object
  local view = clench.view.offscreen {session = session, size = {1070, 1100}}
  view:frame()
  view:click_label "Tendons"
  view:frame()
  view.tendons.pulls = {t0 = 5, t1 = 8}
  view:click_label "Find Routes"
  local found = view.tendons.found
  local grasp = clench.grasp(hand, object)
  local wanted = clench.study.tendon_design(grasp, {pulls = {t0 = 5, t1 = 8}})
  t.equal(found.status, "balanced")
  for i, shift in ipairs(wanted.shifts) do t.close(found.shifts[i].value, shift.value, 1e-12) end
  view:frame()
  local said = false
  for _, item in ipairs(view:items()) do said = said or item.label:find "^balanced, unbalanced torque" ~= nil end
  t.ok(said)
  view:close()
end)
