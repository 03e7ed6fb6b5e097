-- Descriptions are correct: numbers just beyond a described range are rejected by name, and a described default changes nothing.
local test, clench = require "test", require "clench"

local function jaw()
  local world = clench.load "worlds/parallel_jaw_cube.wld"
  local hand, object = world.robots[1], world.objects[1]
  hand:autograsp()
  return hand, object, world
end

-- calls with one table of options; `base` has options that the call requires, or that make it fast
local function energy(name, base)
  return {base = base or {}, call = function(options, hand, object)
    options.hand, options.object = hand, name ~= "approach_cone" and object or nil
    return clench.energy[name](options)()
  end}
end

local function study(name, base)
  return {base = base, call = function(options, hand, object)
    options.hand, options.object = hand, object
    return clench.study[name](options)
  end}
end

local function shape(name, base)
  return {base = base, call = function(options) return clench.shapes[name](options) end}
end

local quick = {settle = 0.05, grip_seconds = 0.05, seconds = 0.05}
local square = {{0, 0}, {1, 0}, {1, 1}, {0, 1}}

local calls = {
  ["clench.annealing"] = {base = {}, call = function(options, hand, object)
    options.hand, options.object, options.energy = hand, object, clench.energy.contact {hand = hand, object = object}
    local search = clench.annealing(options)
    search:run(20)
    return {search.energy, search.counts}
  end},
  ["hand:autograsp"] = {base = {}, call = function(options, hand)
    hand:open()
    hand:autograsp(options)
    return hand.dofs
  end},
  ["hand:find_virtual_contacts"] = {base = {}, call = function(options, hand) return #hand:find_virtual_contacts(options) end},
  ["hand:ik"] = {base = {}, call = function(options, hand) return hand:ik(hand.links[1], hand.links[1].pose, options).dofs end},
  ["hand:move_dofs"] = {base = {}, call = function(options, hand)
    hand:move_dofs({0.02}, options)
    return hand.dofs
  end},
  ["hand:set_targets"] = {base = {}, call = function(options, hand) return hand:set_targets(hand.dofs, options) end},
  ["contact:fit_patch"] = {base = {}, call = function(options, hand, object, world)
    return world:contacts(hand, object)[1]:fit_patch(options) == nil
  end},
  ["world:on_step"] = {base = {}, call = function(options, _, _, world) world:on_step(print, options) end},
  ["world:log"] = {base = {quantities = {"energy"}}, call = function(options, _, _, world)
    local log = world:log(options)
    world:run(0.03)
    return log.rows
  end},
  ["world:record"] = {base = {}, call = function(options, _, _, world)
    local film = world:record(options)
    world:run(0.05)
    return #film.times
  end},
  ["clench.csv.write"] = {base = {}, call = function(options)
    clench.csv.write("build/ranges.csv", {{a = 1, b = 2}}, options)
    return clench.files.read_text "build/ranges.csv"
  end},
  ["clench.csv.read"] = {base = {}, call = function(options)
    clench.files.save_text("build/ranges.csv", "a,b\n1,2\n")
    return clench.csv.read("build/ranges.csv", options)
  end},
  ["clench.stats.histogram"] = {base = {}, call = function(options) return clench.stats.histogram({1, 2, 4}, options) end},
  ["clench.shapes.box"] = shape("box", {x = 1, y = 2, z = 3}),
  ["clench.shapes.capsule"] = shape("capsule", {radius = 1, length = 2}),
  ["clench.shapes.cone"] = shape("cone", {bottom = 1, height = 1}),
  ["clench.shapes.cylinder"] = shape("cylinder", {radius = 1, height = 1}),
  ["clench.shapes.lathe"] = shape("lathe", {profile = {{0, 0}, {1, 0}, {0, 1}}}),
  ["clench.shapes.outline"] = shape("outline", {{0, 0}, {1, 0}, {0, 1}}),
  ["clench.shapes.prism"] = shape("prism", {outline = square, height = 1}),
  ["clench.shapes.ring"] = shape("ring", {radius = 1}),
  ["clench.shapes.rounded_box"] = shape("rounded_box", {x = 1, y = 2, z = 3}),
  ["clench.shapes.sphere"] = shape("sphere", {radius = 1}),
  ["clench.shapes.torus"] = shape("torus", {radius = 2, tube = 1}),
  ["clench.shapes.tube"] = shape("tube", {path = {{0, 0, 0}, {0, 0, 1}}, radius = 0.1}),
  ["clench.study.compare"] = {base = {}, call = function(options, hand, object)
    return clench.study.compare({clench.grasp(hand, object)}, options).values
  end},
  ["clench.study.robustness"] = {base = {samples = 3}, call = function(options, hand, object)
    return clench.study.robustness(clench.grasp(hand, object), options)
  end},
  ["clench.study.predictors"] = {base = {measures = {"epsilon"}, shake = quick}, call = function(options, hand, object)
    options.hand, options.object = hand, object
    return clench.study.predictors({clench.grasp(hand, object)}, options).survived
  end},
  ["clench.study.planner_speed"] = {base = {energies = {"contact"}, steps = 20}, call = function(options, hand, object)
    options.hand, options.object = hand, object
    return clench.study.planner_speed(options)[1].accepted
  end},
  ["clench.study.resistible_wrenches"] = {base = {count = 3, max_force = 5}, call = function(options, hand, object)
    return clench.study.resistible_wrenches(clench.grasp(hand, object), options).area
  end},
  ["clench.study.shake"] = study("shake", quick),
  ["clench.study.shake_base"] = study("shake_base", quick),
  ["clench.study.lift"] = study("lift", {settle = 0.05, grip_seconds = 0.05, hold = 0.05, height = 0.01}),
  ["clench.study.fall_off"] = study("fall_off", {settle = 0.05, grip_seconds = 0.05, max_force = 2, rate = 40}),
  ["clench.energy.contact"] = energy "contact",
  ["clench.energy.potential_quality"] = energy "potential_quality",
  ["clench.energy.guided_potential_quality"] = energy "guided_potential_quality",
  ["clench.energy.autograsp_quality"] = energy "autograsp_quality",
  ["clench.energy.guided_autograsp_quality"] = energy "guided_autograsp_quality",
  ["clench.energy.strict_autograsp"] = energy "strict_autograsp",
  ["clench.energy.compliant"] = energy "compliant",
  ["clench.energy.approach_cone"] = energy("approach_cone", {axis = {0, 0, 1}}),
  ["clench.energy.dynamic"] = energy("dynamic", {shake = quick}),
}

-- entries with a described range or default whose calls are tested elsewhere
local elsewhere = {
  ["random:uniform"] = "numbers by position", ["mesh:sample"] = "numbers by position", ["search:run"] = "numbers by position",
  ["clench.stats.interval"] = "numbers by position", ["hand:approach_object"] = "the hand of this test approaches nothing",
  ["ui:progress"] = "numbers by position",
}
-- devices, ports and servers, whose options are tested with what they open
local elsewhere_of = {["^clench%.devices%."] = "devices_test", ["^clench%.port%."] = "port_test", ["^clench%.control%."] = "control_text_test"}

local function is_elsewhere(name)
  if elsewhere[name] or name:find "^clench%.plan%." then return true end
  for pattern in pairs(elsewhere_of) do
    if name:find(pattern) then return true end
  end
  return false
end

local function options_of(entry)
  for _, item in ipairs(entry.parameters) do
    if item.fields then return item.fields end
  end
  return {}
end

local function is_stated(option) return option.min or option.max or option.default ~= nil end

local function beyond(option)
  local step = option.type == "integer" and 1 or 1e-6
  local values = {}
  if option.min then values[#values + 1] = option.min_open and option.min or option.min - step * math.max(1, math.abs(option.min)) end
  if option.max then values[#values + 1] = option.max_open and option.max or option.max + step * math.max(1, math.abs(option.max)) end
  return values
end

local function with(base, more)
  local all = {}
  for _, from in ipairs {base, more} do
    for key, value in pairs(from) do all[key] = value end
  end
  return all
end

test("every entry whose options have ranges or defaults is called here, or tested elsewhere", function(t)
  local missing = {}
  for _, entry in ipairs(clench.describe()) do
    local stated = false
    for _, item in ipairs(entry.parameters) do stated = stated or is_stated(item) end
    for _, option in ipairs(options_of(entry)) do stated = stated or is_stated(option) end
    local known = calls[entry.name] or is_elsewhere(entry.name)
    if stated and not known then missing[#missing + 1] = entry.name end
  end
  t.equal(table.concat(missing, " "), "")
end)

local names = {}
for name in pairs(calls) do names[#names + 1] = name end
table.sort(names)

for _, name in ipairs(names) do
  local one = calls[name]
  test(name .. " refuses what is beyond a described range", function(t)
    local hand, object, world = jaw()
    for _, option in ipairs(options_of(clench.describe(name))) do
      for _, value in ipairs(option.type:find "^%a+$" and beyond(option) or {}) do
        local ok, message = pcall(one.call, with(one.base, {[option.name] = value}), hand, object, world)
        message = tostring(message)
        t.ok(not ok and message:find(option.name .. " must be", 1, true), ("%s = %s: %s"):format(option.name, value, message))
      end
    end
    t.ok(true)
  end)
  test(name .. " gives the same with its described defaults as without them", function(t)
    local function result(options)
      local hand, object, world = jaw()
      return require "clench.show"(one.call(options, hand, object, world), math.huge)
    end
    local defaults = {}
    for _, option in ipairs(options_of(clench.describe(name))) do
      if one.base[option.name] == nil then defaults[option.name] = option.default end
    end
    t.equal(result(with(one.base, defaults)), result(with(one.base, {})))
  end)
end
