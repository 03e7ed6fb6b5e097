-- Descriptions are correct: numbers just beyond a described range are rejected by name, and a described default changes nothing.
local test, clench = require "test", require "clench"

local function jaw()
  local world = clench.load "worlds/parallel_jaw_cube.wld"
  local hand, object = world.robots[1], world.objects[1]
  hand:autograsp()
  return hand, object, world
end

local calls = dofile "tests/lua/described_calls.lua"

local function study(name, base)
  return {base = base, call = function(options, hand, object)
    options.hand, options.object = options.hand or hand, options.object or object
    return clench.study[name](options)
  end}
end

local function shape(name, base)
  return {base = base, call = function(options) return clench.shapes[name](options) end}
end

local quick = {settle = 0.05, grip_seconds = 0.05, seconds = 0.05}
local square = {{0, 0}, {1, 0}, {1, 1}, {0, 1}}

local of_library = {
  ["clench.build_arch"] = {base = {}, call = function(options)
    local parts = clench.build_arch(clench.world(), options)
    return {#parts, parts[1].mass, parts[1].pose}
  end},
  ["clench.export_html"] = {base = {}, call = function(options, _, _, world)
    return clench.export_html(world, "build/ranges.html", options)
  end},
  ["clench.report.of"] = {base = {}, call = function(options)
    local report = clench.report.of("models/objects/cube.iv", options)
    if report.error then error(report.error, 0) end
    return report.kind
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
    options.hand, options.object = options.hand or hand, options.object or object
    return clench.study.predictors({clench.grasp(hand, object)}, options).survived
  end},
  ["clench.study.planner_speed"] = {base = {energies = {"contact"}, steps = 20}, call = function(options, hand, object)
    options.hand, options.object = options.hand or hand, options.object or object
    return clench.study.planner_speed(options)[1].accepted
  end},
  ["clench.study.resistible_wrenches"] = {base = {count = 3, max_force = 5}, call = function(options, hand, object)
    return clench.study.resistible_wrenches(clench.grasp(hand, object), options).area
  end},
  ["clench.study.shake"] = study("shake", quick),
  ["clench.study.shake_base"] = study("shake_base", quick),
  ["clench.study.lift"] = study("lift", {settle = 0.05, grip_seconds = 0.05, hold = 0.05, height = 0.01}),
  ["clench.study.fall_off"] = study("fall_off", {settle = 0.05, grip_seconds = 0.05, max_force = 2, rate = 40}),
  ["clench.energy.dynamic"] = {base = {shake = quick}, call = function(options, hand, object)
    options.hand, options.object = options.hand or hand, options.object or object
    return clench.energy.dynamic(options)()
  end},
}
for name, one in pairs(of_library) do calls[name] = one end

-- entries with a described range or default whose calls are tested elsewhere
local elsewhere = {
  ["random:uniform"] = "numbers by position", ["mesh:sample"] = "numbers by position", ["mesh:bounding_boxes"] = "numbers by position", ["search:run"] = "numbers by position",
  ["clench.stats.interval"] = "numbers by position", ["hand:approach_object"] = "the hand of this test approaches nothing",
  ["ui:progress"] = "numbers by position", ["clench.study.tendon_design"] = "the hand of this test has no tendons",
}
-- they share the options of reading with clench.files.read_text
for _, name in ipairs {"eigengrasps", "virtual_contacts", "primitives", "glove_calibration", "glove_poses"} do
  elsewhere["clench.files." .. name] = "clench.files.read_text"
end
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

-- is one of the alternatives of the type a number?
local function takes_number(option)
  for word in option.type:gmatch "[^|]+" do
    if word == "number" or word == "integer" or word == "index" then return true end
  end
  return false
end

local function beyond(option)
  if not takes_number(option) then return {} end
  local step = option.type:find "number" and 1e-6 or 1
  local low, values = option.min or option.type == "index" and 1, {}
  if low then values[#values + 1] = option.min_open and low or low - step * math.max(1, math.abs(low)) end
  if option.max then values[#values + 1] = option.max_open and option.max or option.max + step * math.max(1, math.abs(option.max)) end
  return values
end

-- a value of a type that the option does not take; nil if there is none among a string and a boolean
local function misfit(option)
  local kind = option.type
  if kind:find "any" then return nil end
  if not kind:find "string" and not kind:find '"' then return "misfit" end
  if not kind:find "boolean" then return true end
end

-- calls visit(option, wrap) for each option, and for those of tables that the call needs; wrap(value) is the table of options with it
local function each_option(one, options, visit)
  for _, option in ipairs(options) do
    visit(option, function(value) return {[option.name] = value} end)
    for _, inner in ipairs(type(one.base[option.name]) == "table" and not one.base[option.name][1] and option.fields or {}) do
      visit(inner, function(value)
        local table = {}
        for key, other in pairs(one.base[option.name]) do table[key] = other end
        table[inner.name] = value
        return {[option.name] = table}
      end)
    end
  end
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
  local function tried(options)
    local hand, object, world = jaw()
    local ok, message = pcall(one.call, with(one.base, options), hand, object, world)
    return ok and "no error" or tostring(message)
  end
  test(name .. " refuses what is beyond a described range, and values of other types", function(t)
    each_option(one, options_of(clench.describe(name)), function(option, wrap)
      for _, value in ipairs(beyond(option)) do
        local message = tried(wrap(value))
        t.ok(message:find(option.name .. " must be", 1, true), ("%s = %s: %s"):format(option.name, value, message))
      end
      local value = misfit(option)
      local message = value == nil and option.name or tried(wrap(value))
      t.ok(message ~= "no error" and message:find(option.name, 1, true), ("%s = %s: %s"):format(option.name, value, message))
    end)
  end)
  test(name .. " names all words of an option for another word, and describes what it reads", function(t)
    each_option(one, options_of(clench.describe(name)), function(option, wrap)
      if not option.type:find '^"[^|]*"|".*"$' then return end
      local message = tried(wrap "misfit")
      for word in option.type:gmatch '"([^"]*)"' do t.ok(message:find(word, 1, true), ("%s: %s: %s"):format(option.name, word, message)) end
    end)
    t.ok(tried({no_such_key = 1}):find("unknown key 'no_such_key'", 1, true), tried({no_such_key = 1}))
  end)
  test(name .. " gives the same with its described defaults as without them", function(t)
    local function result(options)
      local hand, object, world = jaw()
      return require "clench.show"(one.call(options, hand, object, world), math.huge)
    end
    local defaults = {}
    each_option(one, options_of(clench.describe(name)), function(option, wrap)
      if option.default == nil then return end
      for key, value in pairs(wrap(option.default)) do
        if one.base[key] == nil then
          defaults[key] = value
        elseif type(value) == "table" and value[option.name] ~= nil and one.base[key][option.name] == nil then
          defaults[key] = with(defaults[key] or one.base[key], value)
        end
      end
    end)
    t.equal(result(with(one.base, defaults)), result(with(one.base, {})))
  end)
end
