-- Signatures as data: the grammar of a doc, and the description of every entry.
local test, clench = require "test", require "clench"
local signature = require "clench.signature.grammar"

local text = [[
Closes the fingers.
@param hand robot  the one that closes
@param options? table  how it closes
@option speed? number [m/s, > 0] = 1.5  pace
@option count? integer [1 to 1000000] = 100  how many
@option share? number [>= 0, < 1]
@option mode? "slow"|"fast" = "slow"  manner
@option verify? boolean|table = true  checks afterwards
@option verify.lift? number [m, >= 0] = 0.1  height
@option axis? vec3 = {0, 0, 1}  direction
@param force? number  at most so much [N]
@return table result  `moved`
@effect edits
> hand:autograsp().moved  --> true]]

local function field(list, name)
  for _, item in ipairs(list) do
    if item.name == name then return item end
  end
end

test("an option has the type, unit, range, default and prose of its line", function(t)
  local parsed = signature.parse(text)
  local hand, options, force = table.unpack(parsed.parameters)
  t.equal(hand, {name = "hand", optional = false, type = "robot", text = "the one that closes"})
  t.equal(field(options.fields, "speed"),
          {name = "speed", optional = true, type = "number", unit = "m/s", min = 0, min_open = true, default = 1.5, text = "pace"})
  t.equal(field(options.fields, "count"),
          {name = "count", optional = true, type = "integer", min = 1, max = 1000000, default = 100, text = "how many"})
  t.equal(field(options.fields, "share"),
          {name = "share", optional = true, type = "number", min = 0, max = 1, max_open = true, text = ""})
  t.equal(field(options.fields, "mode").default, "slow")
  t.equal(field(options.fields, "mode").type, '"slow"|"fast"')
  t.equal(field(options.fields, "axis").default, {0, 0, 1})
  t.equal(field(field(options.fields, "verify").fields, "lift").unit, "m")
  t.equal(force, {name = "force", optional = true, type = "number", unit = "N", text = "at most so much [N]"})
  t.equal(parsed.effect, "edits")
  t.equal(signature.parse("@effect long, files").files, true)
  t.equal(parsed.returns, {{type = "table result", text = "`moved`"}})
end)

test("options in a type are fields with the prose of their name", function(t)
  local parsed = signature.parse '@param options? {a: number, b?: "x"|"y, z", c?: fun(a: number, b: number), d?: {e?: integer}}  a: one [m]; b, c: two'
  local fields = parsed.parameters[1].fields
  t.equal(#fields, 4)
  t.equal(fields[1], {name = "a", optional = false, type = "number", text = "one [m]", unit = "m"})
  t.equal(fields[2].type, '"x"|"y, z"')
  t.equal(fields[2].text, "two")
  t.equal(fields[3].text, "two")
  t.equal(fields[4].fields[1].name, "e")
end)

test("limits are parsed as written", function(t)
  for _, limits in ipairs {"[m/s, > 0] = 1.5", "[1 to 1000000] = 100", "[>= 0, < 1]", '= "slow"', "[N]"} do
    local item = signature.parse("@param x number " .. limits).parameters[1]
    t.equal(signature.limits(item), limits)
    t.equal(item.type, "number")
  end
end)

test("the type of a table is made from the lines of its options", function(t)
  t.equal(signature.type_of(signature.parse "@param o table\n@option a? integer = 1\n@option b vec3 [m]".parameters[1]),
          "{a?: integer, b: vec3}")
  t.equal(signature.type_of(signature.parse "@param o mesh|table[]\n@option a? integer".parameters[1]), "mesh|{a?: integer}[]")
end)

test("a faulty description is rejected with its fault", function(t)
  t.fails(function() signature.parse "@parm x number" end, "unknown tag @parm")
  t.fails(function() signature.parse "@option x? number" end, "the option x follows no @param")
  t.fails(function() signature.parse "@param o table\n@option a.b? number" end, "there is no option a before it")
  t.fails(function() signature.parse "@param o table\n@option a? number\n@option a? number" end, "the option a is described twice")
  t.fails(function() signature.parse "@param x number [m, N]" end, "x has two units, 'm' and 'N'")
  t.fails(function() signature.parse "@param x number = tall" end, "the default of x is not a value: tall")
  t.fails(function() signature.parse "@effect writes" end, "reads, edits, files or long, or one of these and files, got 'writes'")
  t.fails(function() signature.parse "@effect files, long" end, "got 'files, long'")
end)

test("functions, methods and fields are described by value or by name", function(t)
  local world = clench.world()
  t.equal(clench.describe(clench.rad).name, "clench.rad")
  t.equal(clench.describe(world.body), clench.describe "world:body")
  t.equal(clench.describe(clench.plan.sample), clench.describe "clench.plan.sample")
  t.equal(clench.describe "hand.dofs".kind, "field")
  t.equal(clench.describe "hand.dofs".effect, "reads")
  t.equal(clench.describe "hand.pose".settable, true)
  t.equal(clench.describe "hand.bodies".settable, false)
  t.fails(function() clench.describe "clench.rda" end, "there is no entry 'clench.rda'; did you mean 'clench.rad'?")
  t.fails(function() clench.describe(print) end, "this function is not an entry of clench")
  t.fails(function() clench.describe(5) end, "expected a function or the name of an entry, got 5")
end)

-- a value just beyond each bound of an option
local function beyond(option)
  local step = option.type == "integer" and 1 or 1e-9 * math.max(1, math.abs(option.max or option.min or 1))
  local values = {}
  if option.min then values[#values + 1] = option.min_open and option.min or option.min - step end
  if option.max then values[#values + 1] = option.max_open and option.max or option.max + 1e-6 * math.max(1, math.abs(option.max)) end
  return values
end

-- calls a planner with one option and an unknown key, so that no search begins
local function try(planner, given)
  given.no_such_key = 1
  local ok, message = pcall(clench.plan[planner], given)
  return not ok and tostring(message) or "no error"
end

test("planners reject numbers beyond a described range, and accept its bounds, its default, and every option", function(t)
  local world = clench.load "worlds/parallel_jaw_cube.wld"
  local hand, object, tried, defaults = world.robots[1], world.objects[1], 0, 0
  for _, planner in ipairs {"anneal", "antipodal", "guided", "list", "loop", "online", "primitive", "random", "sample"} do
    local function visit(option, wrap)
      local function call(value)
        local given = wrap(value)
        given.hand, given.object, given.states = hand, object, given.states or planner == "list" and {{pose = hand.pose, dofs = hand.dofs}} or nil
        return try(planner, given)
      end
      for _, value in ipairs(beyond(option)) do
        local message = call(value)
        t.ok(message:find(option.name, 1, true) and message:find("must be", 1, true), ("%s: %s = %s: %s"):format(planner, option.name, value, message))
        tried = tried + 1
      end
      local taken = {option.default}
      if option.min and not option.min_open then taken[#taken + 1] = option.min end
      if option.max and not option.max_open then taken[#taken + 1] = option.max end
      for _, value in ipairs(taken) do
        local message = call(value)
        t.ok(message:find("unknown key 'no_such_key'", 1, true), ("%s: %s = %s: %s"):format(planner, option.name, tostring(value), message))
        defaults = defaults + 1
      end
    end
    local options = clench.describe("clench.plan." .. planner).parameters[1].fields
    local known = try(planner, {hand = hand, object = object, states = planner == "list" and {{pose = hand.pose, dofs = hand.dofs}} or nil})
    for _, option in ipairs(options) do
      t.ok(known:find(option.name, 1, true), ("%s does not read %s: %s"):format(planner, option.name, known))
      visit(option, function(value) return {[option.name] = value} end)
      for _, inner in ipairs(option.fields or {}) do
        visit(inner, function(value) return {[option.name] = {[inner.name] = value}} end)
      end
    end
  end
  t.ok(tried > 60, tried)
  t.ok(defaults > 80, defaults)
end)

test("an explicitly given default gives the same grasps", function(t)
  local world = clench.load "worlds/parallel_jaw_cube.wld"
  for _, planner in ipairs {"random", "sample", "antipodal"} do
    local function search(more)
      local options = {hand = world.robots[1], object = world.objects[1], count = 2, candidates = 300}
      for name, value in pairs(more) do options[name] = value end
      return clench.json.encode(clench.plan[planner](options).grasps)
    end
    local defaults = {}
    for _, option in ipairs(clench.describe("clench.plan." .. planner).parameters[1].fields) do
      if option.default ~= nil and option.name ~= "count" and option.name ~= "candidates" then defaults[option.name] = option.default end
      for _, inner in ipairs(option.fields or {}) do
        if inner.default ~= nil then
          defaults[option.name] = type(defaults[option.name]) == "table" and defaults[option.name] or {}
          defaults[option.name][inner.name] = inner.default
        end
      end
    end
    t.equal(search(defaults), search {})
  end
end)

test("every entry has a name of its own", function(t)
  local seen = {}
  for _, entry in ipairs(clench.describe()) do
    t.ok(not seen[entry.name], entry.name)
    seen[entry.name] = true
  end
end)

test("every entry has an effect", function(t)
  local effects, missing = {reads = 0, edits = 0, files = 0, long = 0}, {}
  for _, entry in ipairs(clench.describe()) do
    if effects[entry.effect] then effects[entry.effect] = effects[entry.effect] + 1 else missing[#missing + 1] = entry.name end
    if entry.effect == "files" then t.equal(entry.files, true) end
  end
  t.equal(table.concat(missing, " "), "")
  for _, count in pairs(effects) do t.ok(count > 10) end
  t.equal(clench.describe("clench.plan.primitive").effect, "long")
  t.equal(clench.describe("clench.plan.primitive").files, true)
  t.equal(clench.describe("clench.rad").files, nil)
end)

test("what only reads leaves the world as it is", function(t)
  local world = clench.load "worlds/parallel_jaw_cube.wld"
  local hand, object = world.robots[1], world.objects[1]
  hand:autograsp()
  local before = world:hash()
  local receivers = {world = world, hand = hand, body = object, grasp = clench.grasp(hand, object), contact = world:contacts(hand, object)[1], mesh = object.mesh}
  local called = 0
  for _, entry in ipairs(clench.describe()) do
    local owner, name = entry.name:match "^([^.:]+)[.:]([^.:]+)$"
    local receiver = receivers[owner]
    if receiver and entry.effect == "reads" and entry.kind == "field" then
      local _ = receiver[name]
      called = called + 1
    elseif receiver and entry.effect == "reads" and entry.kind == "method" and not (entry.parameters[1] and not entry.parameters[1].optional) then
      pcall(receiver[name], receiver)
      called = called + 1
    end
  end
  t.ok(called > 60, called)
  t.equal(world:hash(), before)
end)

test("every parameter of every entry has a type, and a text or fields", function(t)
  local all, missing = clench.describe(), {}
  for _, entry in ipairs(all) do
    for _, p in ipairs(entry.parameters) do
      if p.type == "" or p.text == "" and not p.fields then missing[#missing + 1] = entry.name .. "/" .. p.name end
    end
  end
  t.ok(#all > 400, #all)
  t.equal(table.concat(missing, " "), "")
end)
