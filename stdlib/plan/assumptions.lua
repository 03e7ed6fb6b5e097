--- Assumptions under which grasps are judged: friction, mass, normal forces and efforts, each with its source.
local name_list = require "clench.name_list"
local assumptions = {}

local function file_name(path) return path:match "[^/]*$" end

-- The source of a value of a body, or of the bodies of a hand, named by `field`: "assumed" if it is assumed for any of them.
local function source_of(thing, field, bodies)
  local from
  for _, body in ipairs(bodies) do
    if body.mesh and from ~= "assumed" then from = body[field] end
  end
  if from == "script" then return "set by the script" end
  if from == "file" then return "from its file" end
  return thing.source == "" and "assumed" or ("assumed, as %s states none"):format(file_name(thing.source))
end

-- Coefficients between the hand's materials and that of the object, the lowest first.
local function frictions(hand, object)
  local world, seen, list = hand.world, {}, {}
  for _, body in ipairs(hand.bodies) do
    if body.mesh and not seen[body.material] then
      seen[body.material] = true
      list[#list + 1] = {mu = world:friction(body.material, object.material), material = body.material}
    end
  end
  table.sort(list, function(a, b)
    if a.mu ~= b.mu then return a.mu < b.mu end
    return a.material < b.material
  end)
  return list
end

-- Names of other bodies that have a material of the hand: coefficients belong to pairs of materials, so these bodies share them.
local function of_hand_material(hand, object)
  local is_hand, materials, names = {}, {}, {}
  for _, body in ipairs(hand.bodies) do
    is_hand[body.name] = true
    if body.mesh then materials[body.material] = true end
  end
  for _, body in ipairs(hand.world.bodies) do
    if body ~= object and not is_hand[body.name] and materials[body.material] then names[#names + 1] = body.name end
  end
  return names
end

local function friction_line(hand, object, given)
  local list, parts = frictions(hand, object), {}
  if #list == 0 then return nil, "friction: none, as the hand has no surface" end
  if given.friction then
    local text, others = ("friction %.3g between hand and object (--friction)"):format(list[1].mu), of_hand_material(hand, object)
    if #others > 0 then text = ("%s, and of %s on the object: of a material of the hand"):format(text, name_list(others)) end
    return list[1].mu, text
  end
  for i, pair in ipairs(list) do parts[i] = ("%.3g of %s on %s"):format(pair.mu, pair.material, object.material) end
  local of_object = given.material and "--material" or source_of(object, "material_from", {object})
  return list[1].mu, ("friction %s (material of the hand: %s; of the object: %s)"):format(name_list(parts),
    source_of(hand, "material_from", hand.bodies), of_object)
end

--- The mass of the object [kg], and a line with its source.
---@param object body
---@param given table<string, string>  options of the command line by name
---@return number, string
function assumptions.mass(object, given)
  return object.mass, ("mass %.4g kg (%s)"):format(object.mass, given.mass and "--mass" or source_of(object, "mass_from", {object}))
end

-- Minimum and maximum effort limit of the motors that close the hand [N m or N], and the number of motors without limits.
local function limits_of(hand)
  local low, high, free = math.huge, 0, 0
  for i, info in ipairs(hand.dof_info) do
    if info.default_velocity ~= 0 and info.driven then
      local range = hand.effort_ranges[i]
      local largest = math.max(math.abs(range[1]), math.abs(range[2]))
      if largest == math.huge then free = free + 1 else low, high = math.min(low, largest), math.max(high, largest) end
    end
  end
  return low, high, free
end

local function effort_line(hand, given)
  local low, high, free = limits_of(hand)
  if high == 0 then return free > 0 and "efforts: unlimited (none given)" or "efforts: no motor closes the hand" end
  local text = low == high and ("%.4g N or N m"):format(high) or ("%.4g to %.4g N or N m"):format(low, high)
  local source = given["max-effort"] and "from its file, else --max-effort" or "from its file"
  local unlimited = free > 0 and ("; %d motors unlimited (none given)"):format(free) or ""
  return ("efforts of closing motors at most %s (%s)%s"):format(text, source, unlimited)
end

local function force_line(verify, given)
  if not verify then return nil, "normal forces: not limited, as nothing is verified" end
  return verify.force_ratio, ("sum of normal forces at most %.4g times the weight (%s)"):format(verify.force_ratio,
    given["force-ratio"] and "--force-ratio" or "by default")
end

--- The assumptions of a search.
---@param hand robot
---@param object body
---@param verify table?  option of plan.sample, with its defaults; nil: nothing is verified
---@param given table<string, string>  options of the command line by name; {} for a script
---@return {friction?: number, mass: number, force_ratio?: number, lines: string[]}  friction: the lowest coefficient; force_ratio: [weights]; mass: [kg]
function assumptions.of(hand, object, verify, given)
  local out = {lines = {}}
  out.friction, out.lines[1] = friction_line(hand, object, given)
  out.mass, out.lines[2] = assumptions.mass(object, given)
  out.force_ratio, out.lines[3] = force_line(verify, given)
  out.lines[4] = effort_line(hand, given)
  return out
end

return assumptions
