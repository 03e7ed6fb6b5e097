local on_behalf_of = require "clench.on_behalf_of"
local new_job = require "clench.plan.job"
local new_run = require "clench.plan.run"
local batch = require "clench.plan.batch"
local starts = require "clench.plan.starts"
local opposition = require "clench.plan.opposition"
local primitive_source = require "clench.plan.primitive_source"
local primitive_starts = require "clench.plan.primitive_starts"

-- DOFs that closing does not move spread the fingers: at 0 they oppose the thumb, at a third of the range above 0 they form a circle
local function derived_preshapes(hand)
  local open, closes = starts.opened(hand)
  local shapes = {opposing = {}, circle = {}}
  for i, limit in ipairs(hand.dof_limits) do
    local low, high = limit[1], limit[2]
    local free = not closes[i] and high - low < math.huge
    local none = math.max(low, math.min(high, 0))
    shapes.opposing[i] = free and none or open[i]
    shapes.circle[i] = free and (none + (high - none) / 3) or open[i]
  end
  return shapes
end

local preshape_names = {opposing = true, circle = true}

-- the preshapes that are given, by name
local function read_preshapes(read, hand)
  local given = read:raw "preshapes"
  if given == nil then return {} end
  if type(given) ~= "table" then read:expected("preshapes", "a table {opposing = dofs, circle = dofs}", given) end
  for name, dofs in pairs(given) do
    if not preshape_names[name] then read:fail("preshapes: unknown key '%s'; it has 'opposing' and 'circle'", tostring(name)) end
    if type(dofs) ~= "table" or #dofs ~= #hand.dofs then
      read:expected("preshapes." .. name, ("%d numbers, one per DOF"):format(#hand.dofs), dofs)
    end
  end
  return given
end

-- the given preshapes, and those derived from a hand that no arm carries
local function preshapes_of(hand, given)
  local shapes = derived_preshapes(hand)
  for name, dofs in pairs(given) do shapes[name] = dofs end
  return shapes
end

local max_size = 10  -- larger numbers are probably millimeters [m]

local function check_size(read, place, size)
  if type(size) ~= "number" or not (size > 0 and size < math.huge) then read:expected(place, "a number > 0", size) end
  if size > max_size then
    read:fail("%s must be at most %g m, got %.6g: meters? clench.mm(%.6g) is %.4g", place, max_size, size, size, size / 1000)
  end
end

-- names of the sizes of each kind
local sizes = {sphere = {"radius"}, cylinder = {"radius", "height"}, cone = {"radius", "height"}}

local function check_primitive(read, place, p)
  local names = type(p) == "table" and sizes[p.kind]
  local is_box = type(p) == "table" and p.kind == "box" and clench.type(p.size) == "vec3"
  local sized = is_box
  for i, name in ipairs(names or {}) do sized = (i == 1 or sized) and p[name] ~= nil end
  if not sized or clench.type(p.pose) ~= "pose" then
    read:expected(place, "{kind = 'box', pose =, size =}, a sphere with radius, or a cylinder or cone with radius and height", p)
  end
  for _, name in ipairs(names or {}) do check_size(read, ("%s: %s"):format(place, name), p[name]) end
  for _, axis in ipairs(is_box and {"x", "y", "z"} or {}) do check_size(read, ("%s: size.%s"):format(place, axis), p.size[axis]) end
end

-- the list, and its source
local function read_primitives(read, object)
  local given, root = read:raw "primitives", read:raw "root"
  if root ~= nil and type(root) ~= "string" then read:expected("root", "a folder", root) end
  if given == nil then return primitive_source(read, object, root) end
  local source = "list"
  if type(given) == "string" then
    source, given = given, on_behalf_of(read.subject, clench.files.primitives, given, {root = root})
  end
  if type(given) ~= "table" or #given == 0 then
    read:expected("primitives", "a file, or a list {kind =, pose =, size = or radius =, height =}", given)
  end
  for i, p in ipairs(given) do check_primitive(read, ("primitives[%d]"):format(i), p) end
  return given, source
end

--- Represents an object by boxes, spheres, cylinders and cones, and approaches each from all sides (Miller, Knoop, Christensen and Allen 2003): the hand moves
--- to the first touch and closes; while the grasp has no force closure, it closes again from a step further back.
---@param options table  hand, object and settings of the search
---@like clench.plan.anneal  hand, object
---@option primitives? string|table  a file of clench.files.primitives, or such a list; by default primitives/<name>.iv in the folder of
---  the object's file or below root/models/objects, else the primitives in the object's file, else its bounding box; report.primitives names the source
---@option root? string  root folder of GraspIt!
---@option density? integer [1 to 100] = 2  density of the starts on each primitive
---@option preshapes? table  {opposing = dofs, circle = dofs}, derived from the hand by default
---@option thumb? vec3  direction to the thumb across the approach, in the frame of the base of the hand
---@option rule? "corrected"|"graspit" = "corrected"  graspit: sizes of boxes and limits as in GraspIt!
---@option count? integer [1 to 1000000]  number of grasps that ends the search, any number by default
---@like clench.plan.anneal  seconds, seed, threads, contacts, touch
---@option on_grasp? function  on_grasp(grasp) is called for each grasp that is found
---@like clench.plan.anneal  grasp, world, max_effort
---@return {grasps: grasps, report: table} # grasps in force closure, in order of decreasing epsilon
---@effect long, files
--- > list = {{kind = "cylinder", pose = clench.pose {}, radius = 0.03, height = 0.1}}
--- > clench.plan.primitive {hand = hand, object = flask, primitives = list, density = 1}.report.candidates  --> 12
--- > clench.plan.primitive {hand = hand, object = flask, density = 1}.report.primitives:match "[^/]*/[^/]*$"  --> primitives/flask.iv
--- > clench.plan.primitive {hand = hand, object = flask, primitives = {}}  --> error: primitives must be a file, or a list
return function(options)
  local own = {}
  local job = new_job("plan.primitive", options, function(read, job)
    own.primitives, own.source = read_primitives(read, options.object)
    own.density = read:get "density"
    own.rule = read:get "rule"
    own.preshapes = read_preshapes(read, options.hand)
    own.thumb = read:get "thumb"
    if type(own.thumb) == "table" then own.thumb = clench.vec3(table.unpack(own.thumb)) end
    own.count = read:get("count", 1000000)
    own.on_grasp = read:get "on_grasp"
  end)
  local hand = job.hand
  own.preshapes = preshapes_of(hand, own.preshapes)
  local thumb = own.thumb and hand.pose:rotate(own.thumb) or opposition.thumb(hand)
  if not thumb then require "clench.raise" "plan.primitive: thumb: it cannot be derived, as this hand has no two fingers; set this option" end
  local X_FH = opposition.base_in_frame(hand, hand.approach.point, thumb)
  local list, max_span = primitive_starts(own.primitives, own.density, own.rule)
  local function next_state(number)
    local at = list[number]
    if not at then return end
    return {pose = opposition.frame(at.position, at.direction, at.thumb) * X_FH, dofs = own.preshapes[at.preshape]}
  end
  local stats = {planner = "plan.primitive", primitives = own.source}
  if #list == 0 then
    stats.no_start = ("no primitive has a size that a hand can grasp: thumb and fingers span at most %g mm"):format(1000 * max_span)
  end
  local found = batch.try(job, stats, next_state, {planner = "primitive", limit = #list, count = own.count, on_grasp = own.on_grasp,
                                                  approach = 1, back = {count = 20, length = 0.004}})
  job:finish()
  return new_run(job, batch.sort(found), stats, {distance = 1e-9})
end
