-- The panel Tendons: lengths, passive forces and torques by closed formulas.
local test, clench = require "test", require "clench"

-- a link of 50 mm that turns about z; the tendon leads from (0, 10, 0) on the base to 51 mm along the link
local function load_hand(world)
  local folder = test.folder()
  assert(os.execute("mkdir " .. folder .. "/iv"))
  clench.files.save_text(folder .. "/iv/part.iv", "#Inventor V2.1 ascii\nCube { }")
  clench.files.save_text(folder .. "/hand.xml", [[<robot type="Hand">
    <palm>part.iv</palm>
    <dof type="r"><defaultVelocity>1</defaultVelocity></dof>
    <chain>
      <joint type="Revolute"><theta>d0</theta><d>0</d><a>50</a><alpha>0</alpha><minValue>0</minValue><maxValue>90</maxValue></joint>
      <link dynamicJointType="Revolute">part.iv</link>
    </chain>
    <tendon name="flexor"><stiffness>2</stiffness><restLength>40</restLength>
      <insertionPoint><chain>-1</chain><link>-1</link><position>0 10 0</position></insertionPoint>
      <insertionPoint><chain>0</chain><link>0</link><position>1 0 0</position></insertionPoint>
    </tendon></robot>]])
  return world:add_robot(folder .. "/hand.xml")
end

local function length_at(angle) return math.sqrt(0.051 ^ 2 + 0.01 ^ 2 - 2 * 0.051 * 0.01 * math.sin(angle)) end

test("length, passive force and moment arm follow the joint", function(t)
  local routes = require "clench.tendon_routes"
  local hand = load_hand(clench.world())
  for _, angle in ipairs {0, 0.3, 1.2} do
    hand:set_dofs {angle}
    local tendon = hand.tendons[1]
    t.close(routes.length(tendon), length_at(angle), 1e-12)
    t.close(routes.passive_force(tendon), 2000 * (length_at(angle) - 0.04), 1e-8)
    -- the rate at which it becomes shorter
    t.close(routes.arms(hand, tendon)[1], 0.051 * 0.01 * math.cos(angle) / length_at(angle), 1e-12)
  end
end)

test("a pull becomes the constant torque of panel Forces, and a hand without tendons says so", function(t)
  local session = clench.session(clench.world())
  local hand = load_hand(session.world)
  session.hand, session.object = hand, session.world:add_object(clench.shapes.box {0.01, 0.01, 0.01}, {pose = {xyz = {1, 0, 0}}})
  local view = clench.view.offscreen {session = session, size = {1070, 937}}
  view:frame()
  view:click_label "Tendons"
  view.tendons.pulls.flexor = 5
  local row
  view:frame()
  for _, item in ipairs(view:items()) do row = item.label == "flexor" and item or row end
  view:click(row.x + 5, row.y + 5)
  t.equal(view.tendons.chosen, "flexor")
  view:click_label "Use as Constant Torques"
  t.close(view.forces.torques[1], 5 * 0.051 * 0.01 / length_at(0), 1e-12)
  t.equal(view.front.right, "Forces")
  view:close()
  local other = clench.session()
  other:open("worlds/barrett_mug.wld", {root = "."})
  view = clench.view.offscreen {session = other, size = {1070, 937}}
  view:frame()
  view:click_label "Tendons"
  view:frame()
  local said = false
  for _, item in ipairs(view:items()) do said = said or item.label:find "has no tendons" ~= nil end
  t.ok(said)
  view:close()
end)
