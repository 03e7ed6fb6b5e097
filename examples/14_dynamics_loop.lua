-- The loop of GraspIt!'s manual, section 13.2, in which a script makes every step: bodies move, velocities are solved for, and the hand's motors
-- get new forces from the contact forces at its fingertips. world:run with the same controller gives the same trajectory.
--   clench run examples/14_dynamics_loop.lua [LOG.csv]
local clench = require "clench"

local function scene()
  local world = clench.load("worlds/barrett_glass_table.wld", {root = "."})
  local hand = world.robots[1]
  hand.controller = "none"  -- motors exert only the forces of set_forces
  return world, hand
end

-- each finger closes with 0.2 N m until its tip is in contact, then with half of that
local function controller(world, hand)
  local tips = {}
  for i, chain in ipairs(hand.chains) do tips[i] = chain.links[#chain.links] end
  return function()
    local forces = {0}
    for i, tip in ipairs(tips) do forces[i + 1] = #world:average_contacts(tip) > 0 and 0.1 or 0.2 end
    hand:set_forces(forces)
  end
end

-- the loop of the manual
local seconds = 0.5
local world, hand = scene()
local set_forces, steps = controller(world, hand), 0
local step = world.time_step
while seconds - world.time > 1e-9 do
  set_forces()
  -- a collision ends a step early; the next step is its remainder, as in a run
  local left = math.min((math.floor(world.time / step + 1e-6) + 1) * step, seconds) - world.time
  local passed = world:move_bodies(math.abs(left - step) < 1e-6 * step and step or left)
  world:solve_velocities(passed)
  steps = steps + 1
end
print(("%d steps by hand: fingers at %s"):format(steps, clench.json.encode(hand.dofs)))

-- the same by world:run, with a log
local other, same = scene()
other:on_step(controller(other, same))
local log = other:log {rate = 100, quantities = {same, "energy", "contacts"}}
other:run(seconds)
print(("%d steps by run:  fingers at %s"):format(other.report.steps, clench.json.encode(same.dofs)))
log:save(arg and arg[1] or "build/dynamics_loop.csv")

local off = 0
for i, value in ipairs(hand.dofs) do off = math.max(off, math.abs(value - same.dofs[i])) end
print(("they differ by %.3g rad"):format(off))
assert(off < 1e-9 and #log.rows == 51)
