--- Identifies a search of `clench plan` by its scene and the options on which its grasps depend.
local fingerprint = require "clench.fingerprint"
local in_utf8 = require "clench.in_utf8"
local plan_options = require "clench.host.plan_options"
local identity = {}

-- grasps do not depend on these
local about_the_run = {"count", "format", "frame", "lines", "o", "overwrite", "quality", "report", "resume", "seconds", "sheet", "size", "table", "threads"}
-- covered by the fingerprint of the scene; compared only for the message
local about_the_scene = {"hand", "object", "obstacle", "pose", "obstacle-pose", "mass", "material", "friction", "close", "approach"}

local function set_of(names)
  local set = {}
  for _, name in ipairs(names) do set[name] = true end
  return set
end
local is_about_the_run, is_about_the_scene = set_of(about_the_run), set_of(about_the_scene)

-- deterministic, and exact for numbers
local function text_of(value)
  if math.type(value) == "float" then return ("%.17g"):format(value) end
  if type(value) ~= "table" then return tostring(value) end
  local keys = {}
  for key in pairs(value) do keys[#keys + 1] = key end
  table.sort(keys, function(a, b) return tostring(a) < tostring(b) end)
  for i, key in ipairs(keys) do keys[i] = tostring(key) .. "=" .. text_of(value[key]) end
  return "{" .. table.concat(keys, ",") .. "}"
end

-- equal text for equal numbers, such as "1e1" and "10"
local function plain(value)
  local number = tonumber(value)
  if not number then return value end
  local short = ("%.15g"):format(number)
  return tonumber(short) == number and short or ("%.17g"):format(number)
end

-- all options on which grasps depend: the given ones, and the defaults of others
local function complete(given)
  local options = {}
  for name, value in pairs(plan_options.defaults()) do
    if not is_about_the_run[name] then options[name] = plain(value) end
  end
  for name, value in pairs(given) do
    if not is_about_the_run[name] and not is_about_the_scene[name] then options[name] = plain(value) end
  end
  return options
end

local joint_fields = {"name", "kind", "dof", "axis", "ratio", "min", "max", "endless", "spring", "rest", "damping", "friction", "armature", "effort_range"}

-- A table per chain. The axes of the joints enter by the Jacobians of the links.
local function chains_of(hand)
  local chains = {}
  for c, chain in ipairs(hand.chains) do
    local joints, jacobians = {}, {}
    for j, joint in ipairs(chain.joints) do
      joints[j] = {}
      for _, field in ipairs(joint_fields) do joints[j][field] = joint[field] end
    end
    for l, link in ipairs(chain.links) do jacobians[l] = hand:jacobian(link) end
    chains[c] = {parent = chain.parent.name, joints = joints, jacobians = jacobians}
  end
  return chains
end

-- properties of the hand on which grasps depend and that the hash of the world does not cover
local function mechanics_of(hand)
  return {dof_info = hand.dof_info, effort_ranges = hand.effort_ranges, actuators = hand.actuators, joint_tendons = hand.joint_tendons,
          chains = chains_of(hand)}
end

--- Names of the given options that decide which grasps are found, sorted; without hand, object and seed.
---@param given table<string, string|string[]>
---@return string[]
function identity.sorted_names(given)
  local names = {}
  for name in pairs(given) do
    if name ~= "hand" and name ~= "object" and name ~= "seed" and (name == "count" or name == "seconds" or not is_about_the_run[name]) then
      names[#names + 1] = name
    end
  end
  table.sort(names)
  return names
end

--- The identity of the search for grasps in this world.
---@param given table<string, string|string[]>  options by name
---@param world world
---@param hand robot
---@return {scene: string, named: table, options: table}
function identity.of(given, world, hand)
  local named = {}
  for name, value in pairs(given) do
    if is_about_the_scene[name] then
      local text = type(value) == "table" and table.concat(value, " ") or value
      if text ~= "" then named[name] = text end
    end
  end
  return in_utf8 {scene = world:hash() .. fingerprint(text_of(mechanics_of(hand))), named = named, options = complete(given)}
end

local function sorted_keys(a, b)
  local set, keys = {}, {}
  for _, from in ipairs {a, b} do
    for key in pairs(from) do
      if not set[key] then keys[#keys + 1] = key end
      set[key] = true
    end
  end
  table.sort(keys)
  return keys
end

local words = {hand = "HAND", object = "OBJECT"}

-- "expected --seed '2', got '1'"; flags have the value "yes"
local function in_words(name, expected, got)
  local option = words[name] or "--" .. name
  local found = got == nil and "none" or got == "yes" and option or ("'%s'"):format(got)
  if expected == nil then return ("expected no %s, got %s"):format(option, found) end
  if expected == "yes" then return ("expected %s, got %s"):format(option, found) end
  return ("expected %s '%s', got %s"):format(option, expected, found)
end

local function first_difference(there, here, names)
  for _, name in ipairs(names) do
    if there[name] ~= here[name] then return in_words(name, here[name], there[name]) end
  end
end

local function table_at(value, key) return type(value[key]) == "table" and value[key] or {} end

--- The first difference of two searches, in words; nil: they are the same.
---@param there table  from the list on the disk
---@param here table  of this search
---@return string?
function identity.difference(there, here)
  local options = complete(table_at(there, "options"))
  local by_option = first_difference(options, here.options, sorted_keys(options, here.options))
  if there.scene == here.scene then return by_option end
  return first_difference(table_at(there, "named"), here.named, about_the_scene) or by_option
    or "the files of the hand, the object or the obstacles have changed"
end

return identity
