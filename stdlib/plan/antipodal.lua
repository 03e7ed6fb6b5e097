local new_job = require "clench.plan.job"
local new_run = require "clench.plan.run"
local crowd = require "clench.plan.crowd"
local starts = require "clench.plan.starts"
local opposition = require "clench.plan.opposition"

-- Two points of the surface that face each other along a line inside both friction cones, and the middle between them.
local function pair_at(world, object, at, friction, widest)
  local point, normal = object.pose * at.point, object.pose:rotate(at.normal)
  local hit = world:raycast(point - normal * 1e-5, -normal, widest)
  if not hit or hit.body ~= object then return end
  local line = hit.point - point
  local width = line:norm()
  if width < 1e-4 then return end
  line = line / width
  -- the ray leaves the object, so that its normal there looks along the line
  if math.abs(hit.normal:dot(line)) < math.cos(math.atan(friction)) then return end
  return (point + hit.point) * 0.5, line
end

--- For two jaws: a point of the surface, the one that the inward normal meets opposite, and the jaws about both, from any
--- side across that line.
---@param options {hand: robot, object: body, count?: integer, candidates?: integer, seconds?: number, seed?: integer, threads?: integer, friction?: number, width?: number, standoff?: number, distance?: number, on_grasp?: function, grasp?: table, world?: world}  count: of grasps, 100; candidates: at most, 20000; friction: the cones in which the line lies, 0.5; width: between the points at most, 0.2 [m]; standoff: before the grasp, 0.1 [m]
---@return {grasps: grasps, report: table} # in force closure, the largest epsilon first
--- > world = clench.world()
--- > jaws = world:add_robot "models/hands/parallel_jaw/parallel_jaw.cfg"
--- > bar = world:add_object(clench.shapes.box {0.03, 0.03, 0.1}, {pose = {xyz = {0, 0, 1}}})
--- > run = clench.plan.antipodal {hand = jaws, object = bar, count = 3}
--- > #run.grasps > 0 and run.grasps[1].epsilon > 0  --> true
return function(options)
  local own = {}
  local job = new_job("plan.antipodal", options, function(read)
    own.count = read:count("count", 100, 1, 1000000)
    own.limit = read:count("candidates", 20000, 1, 1e9)
    own.friction = read:positive("friction", 0.5)
    own.width = read:positive("width", 0.2)
    own.standoff = read:positive("standoff", 0.1)
    own.distance = read:not_negative("distance", 0.1)
    own.on_grasp = read:raw "on_grasp"
  end)
  local hand, object, world = job.hand, job.object, job.world
  local thumb = opposition.thumb(hand)
  if not thumb then require "clench.raise" "plan.antipodal: expected a hand of two fingers or more" end
  local X_FH, open = opposition.base_in_frame(hand, thumb), starts.opened(hand)
  local told = {planner = "plan.antipodal", pairs_rejected = 0}
  local X_OW = object.pose:inverse()

  local function next_state(number)
    for try = 1, 1000 do
      local random = clench.random(job.seed, number * 1000 + try)
      local middle, line = pair_at(world, object, object.mesh:sample(random, 1)[1], own.friction, own.width)
      if middle then
        local side = line:cross(random:direction())
        if side:norm() > 1e-3 then
          local direction = side / side:norm()
          local start = middle - direction * own.standoff
          local X_WH = opposition.frame(start, direction, line) * X_FH
          return {pose = X_OW * X_WH, dofs = open, reach = own.standoff}
        end
      end
      told.pairs_rejected = told.pairs_rejected + 1
    end
  end
  own.planner = "antipodal"
  local found = crowd.try(job, told, next_state, own)
  job:finish()
  return new_run(job, crowd.sort(found), told, {distance = own.distance})
end
