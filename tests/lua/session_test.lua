-- Sessions: commands, undo and redo, and a log that is a script.
local test, clench = require "test", require "clench"

local function opened()
  local session = clench.session()
  session:open("worlds/barrett_mug.wld", {root = "."})
  return session
end

local function replayed(session) return assert(load(session:script() .. "\nreturn world", "=script", "t"))() end

test("a command changes the world, and is undone and redone bit-exactly", function(t)
  local session = opened()
  local first, changed = session.world:hash(), 0
  local unsubscribe = session:subscribe("changed", function() changed = changed + 1 end)
  session:run "grasp.autograsp"
  local second = session.world:hash()
  t.ok(second ~= first)
  t.equal(changed, 1)
  t.equal(session:undo(), "Auto Grasp")
  t.equal(session.world:hash(), first)
  t.equal(session:redo(), "Auto Grasp")
  t.equal(session.world:hash(), second)
  t.equal(session:redo(), nil)
  t.equal(changed, 3)
  unsubscribe()
  session:undo()
  t.equal(changed, 3)
  t.equal(session:undo(), "Open…")
  t.equal(session.world, nil)
  t.equal(session:undo(), nil)
end)

test("a drag that only stops what moves is logged", function(t)
  local session = opened()
  session:run "grasp.autograsp"
  session:run("dynamics.run", {seconds = 0.05})
  for _, name in ipairs {"hand", "object"} do
    local thing = session[name]
    session:begin_gesture "Drag"
    thing:move_to(thing.pose)
    session:end_gesture()
  end
  t.equal(#session.history.done, 5)
  t.equal(replayed(session):hash(), session.world:hash())
end)

test("handles of a script stay valid after undo, including those of removed bodies", function(t)
  local session = opened()
  local mug, hand, world = session.object, session.hand, session.world
  local pose = mug.pose
  session:run("body.move", {body = mug.name, pose = {xyz = {1, 2, 3}}})
  session:run("body.remove", {body = mug.name})
  t.equal(session.object, nil)
  t.fails(function() return mug.pose end, "was removed")
  session:undo()
  t.equal(mug.pose.position, clench.vec3(1, 2, 3))
  session:undo()
  t.equal(mug.pose, pose)
  t.ok(session.world == world and session.object == mug and session.hand == hand)
end)

test("the history is a script of plain calls that makes the same world", function(t)
  local session = opened()
  session:run("world.import_obstacle", {path = "models/objects/plate.iv"})
  session:run("body.move", {body = "plate", pose = {xyz = {0.3, 0, 0}, rpy = {0.1, 0.2, 0.3}}})
  session:run("body.mass", {body = "mug", mass = 0.4})
  session:run("grasp.approach", {reach = 0.1})
  session:run "grasp.autograsp"
  session:run("dynamics.run", {seconds = 0.02})
  session:run("body.remove", {body = "plate"})
  local script = session:script()
  t.ok(not script:find "session", script)
  t.ok(script:find('clench.load("worlds/barrett_mug.wld", {root = "."})', 1, true), script)
  t.ok(script:find('world:robot("barrett"):autograsp()', 1, true), script)
  t.equal(replayed(session):hash(), session.world:hash())
  -- it contains no undone commands
  session:undo()
  session:undo()
  t.ok(not session:script():find "run")
  t.equal(replayed(session):hash(), session.world:hash())
end)

test("a custom command is checked by its parameters and logged as the resulting state", function(t)
  local session = opened()
  session:command {name = "mine.lift", label = "Lift", parameters = {{name = "height", type = "number", unit = "m", min = 0, max = 1, default = 0.1, text = "how far"}},
    run = function(s, args) s.object.pose = clench.pose {xyz = {0, 0, args.height}} * s.object.pose return args.height end}
  local z, results = session.object.pose.position.z, {}
  session:subscribe("result", function(value) results[#results + 1] = value.result end)
  t.equal(session:run "mine.lift", 0.1)
  t.equal(session:run("mine.lift", {height = 0.25}), 0.25)
  t.equal(results, {0.1, 0.25})
  t.close(session.object.pose.position.z - z, 0.35, 1e-12)
  t.equal(replayed(session):hash(), session.world:hash())
  t.fails(function() session:run("mine.lift", {height = -1}) end, "session:run: mine.lift: height: expected a number from 0 to 1 m, got -1")
  t.fails(function() session:run("mine.lift", {height = "high"}) end, "height: expected a number, got 'high'")
  t.fails(function() session:run("mine.lift", {hight = 1}) end, "unknown argument 'hight', expected height; did you mean 'height'?")
  t.fails(function() session:run("mine.lift", 3) end, "expected a table of arguments, got 3")
  t.fails(function() session:command {name = "lift", run = print} end, "session:command: name: expected 'group.verb', got 'lift'")
  t.fails(function() session:command {name = "a.b"} end, "run: expected a function, got nothing")
  t.fails(function() session:command {name = "a.b", run = print, parameters = {{name = "x", type = "float"}}} end, "type: expected one of number")
  t.fails(function() session:command {name = "a.b", run = print, parameters = {{name = "x", type = "number", minimum = 1}}} end, "unknown key 'minimum'")
end)

test("a command that fails leaves the session unchanged", function(t)
  local session = opened()
  session:command {name = "mine.break", run = function(s)
    s.world:remove(s.object)
    s.hand.dofs = {0, 1, 1, 1}
    error "broken"
  end}
  local hash, mug = session.world:hash(), session.object
  t.fails(function() session:run "mine.break" end, "broken")
  t.equal(session.world:hash(), hash)
  t.ok(session.object == mug and mug.pose ~= nil)
  t.equal(#session.history.done, 1)
  -- commands run by a command are part of it
  session:command {name = "mine.half", run = function(s)
    s:run "grasp.autograsp"
    error "half"
  end}
  t.fails(function() session:run "mine.half" end, "half")
  t.equal(session.world:hash(), hash)
  t.equal(#session.history.done, 1)
  session:command {name = "mine.whole", run = function(s)
    s:run "grasp.autograsp"
    s:run("body.mass", {body = "mug", mass = 0.2})
  end}
  session:run "mine.whole"
  t.equal(replayed(session):hash(), session.world:hash())
  session:undo()
  t.equal(session.world:hash(), hash)
  -- changes of state that the log cannot record are rejected, and so are new bodies
  session:command {name = "mine.gravity", run = function(s) s.world.gravity = {0, 0, -1} end}
  t.fails(function() session:run "mine.gravity" end, "needs a field script, which returns its lines of Lua")
  session:command {name = "mine.more", run = function(s) s.world:add_object(clench.shapes.box {0.1, 0.1, 0.1}, {pose = {xyz = {9, 0, 0}}}) end}
  t.fails(function() session:run "mine.more" end, "needs a field script")
  t.equal(session.world:hash(), hash)
  t.fails(function() session:command {name = "a.b", run = print, lable = "x"} end, "unknown key 'lable'")
  t.fails(function() session:run("body.mass", {body = "mug", mas = 1}) end, "unknown argument 'mas'", "did you mean 'mass'?")
  t.fails(function() session:run("world.open", {path = "no/such.wld"}) end, "no such file")
  t.equal(session.world:hash(), hash)
  t.fails(function() session:run "grasp.autogasp" end, "there is no command 'grasp.autogasp'", "did you mean 'grasp.autograsp'?")
  t.fails(function() session:run("body.remove", {body = "mgu"}) end, "there is no body or robot 'mgu'", "did you mean 'mug'?")
  t.fails(function() clench.session():run "grasp.autograsp" end, "the command cannot run now: no hand is current")
  t.fails(function() session:run "dynamics.pop" end, "dynamics.pop: the command cannot run now: no state was pushed")
  session:command {name = "mine.closed", run = print, enabled = function() return false end}
  t.fails(function() session:run "mine.closed" end, "mine.closed: the command cannot run now")
  session:command {name = "mine.self", run = function(s) s:run "mine.self" end}
  t.fails(function() session:run "mine.self" end, "mine.self: commands that run commands are nested more than 20 deep; does one run itself?")
  t.equal(session.world:hash(), hash)
  session:run("body.mass", {body = "mug", mass = 0.3})  -- the depth is counted again
  session:undo()
  local function nothing() end
  t.fails(function() session:command {name = "grasp.open", run = nothing} end, "there is a command 'grasp.open' already; replace = true")
  session:command {name = "grasp.open", run = nothing, replace = true}
  session:run "grasp.open"
  t.equal(session.world:hash(), hash)
  session:undo()
  t.fails(function() session:subscribe("change", print) end, "expected 'changed'")
  t.fails(function() clench.session(3) end, "clench.session: expected a world, got 3")
end)

test("what belongs to another world, or is no body at all, is refused", function(t)
  local session, other = opened(), opened()
  local hash = other.world:hash()
  for name, args in pairs {["body.move"] = {body = other.object, pose = {xyz = {1, 0, 0}}}, ["body.mass"] = {body = other.object, mass = 1}, ["grasp.autograsp"] = {hand = other.hand},
                           ["grasp.select_object"] = {object = other.object}, ["world.select"] = {addresses = {other.object}}, ["body.distance"] = {a = "mug", b = other.hand}} do
    t.fails(function() session:run(name, args) end, "belongs to another world")
  end
  t.equal(other.world:hash(), hash)
  t.equal(#session.history.done, 1)
  session:run("body.move", {body = session.hand, pose = {xyz = {0, 0, 1}}})  -- a handle does as well as an address
  t.equal(session.hand.pose.position.z, 1)
  session:undo()
  for _, junk in ipairs {5, {}, true, print} do
    t.fails(function() session:run("world.select", {addresses = {junk}}) end, "expected a body or robot, or its address, got ")
    t.fails(function() session:find(junk) end, "expected a body or robot, or its address, got ")
  end
  t.fails(function() session:run("world.select", {addresses = {a = "mug"}}) end, "addresses: expected a list, got a table with names")
  t.equal(#session.selection, 0)
  t.fails(function() session:find(("x"):rep(1000)) end, "there is no body or robot 'xxx", "xx...'")
  t.fails(function() session:find(("x"):rep(1e6)) end, "session: an address has at most 1000 bytes, got 1000000")
end)

test("arguments that cannot be logged or counted are refused in a sentence", function(t)
  local session = opened()
  local circle = {}
  circle[1] = circle
  t.fails(function() session:run("grasp.dofs", {dofs = circle}) end, "nested more than 100 deep cannot be logged; does it contain itself?")
  t.fails(function() session:run("world.open", {path = "x.wld", options = circle}) end, "does it contain itself?")
  session:run("dynamics.step", {count = 2.0})
  t.close(session.world.time, 2 * session.world.time_step, 1e-12)
  t.equal(replayed(session):hash(), session.world:hash())
  t.fails(function() session:run("dynamics.step", {count = 1.5}) end, "count: expected an integer, got 1.5")
  t.fails(function() session:run("dynamics.step", {count = 0.0}) end, "count: expected a number from 1 to")
  session:run("world.friction", {a = "wood", b = "plastic", mu = -0.0})  -- its sign is part of the state
  t.equal(replayed(session):hash(), session.world:hash())
  t.fails(function() session:run("grasp.find_virtual", {count_per_link = 101}) end, "count_per_link: expected a number from 1 to 100, got 101")
end)

test("saving marks a session as unmodified", function(t)
  local session = opened()
  t.ok(not session:is_modified())
  session:run "grasp.open"
  t.ok(session:is_modified())
  local path = test.path ".wld"
  session:save(path)
  t.ok(not session:is_modified())
  session:run "grasp.open"
  t.ok(session:is_modified())
  session:undo()
  t.ok(not session:is_modified())
  t.fails(function() clench.session(clench.world()):save() end, "path: expected a file")
end)

test("addresses name bodies, robots and links", function(t)
  local session = opened()
  t.equal(session:find "mug", session.object)
  t.equal(session:find "barrett", session.hand)
  t.equal(session:find "barrett/chain0_link1", session.hand:link "chain0_link1")
  session.world:add_object(clench.shapes.box {0.1, 0.1, 0.1}, {name = "a/b", pose = {xyz = {5, 0, 0}}})
  t.equal(session:find("a\\/b").name, "a/b")
  t.equal(session:run("grasp.quality", {hand = "barrett"}), 0.0)
  local object, grasp = session.object, clench.grasp(session.hand, session.object)
  local weight = {0, 0, -9.81 * object.mass, 0, 0, 0}
  t.equal(session:run("grasp.forces").status, grasp:contact_forces {load = weight}.status)
end)

-- commands of a random session on the mug and the hand
local function random_commands(random)
  local function number(a, b) return a + (b - a) * random:uniform() end
  local function one_of(list) return list[random:integer(1, #list)] end
  local function pose() return {xyz = {number(-1, 1), number(-1, 1), number(-1, 1)}, rpy = {number(-3, 3), number(-1, 1), number(-3, 3)}} end
  local function dofs() return {number(0, 3), number(0, 2), number(0, 2), number(0, 2)} end
  local added = 0
  return {
    function() return "body.move", {body = one_of {"mug", "barrett"}, pose = pose()} end,
    function() return "body.move", {body = "mug", pose = {xyz = {number(-0.1, 0.1), number(-0.1, 0.1), 0}}, stop_at_contact = true} end,
    function() return "body.mass", {body = one_of {"mug", "barrett/barrett_chain0_link1"}, mass = number(0.1, 2)} end,
    function() return "body.material", {body = one_of {"mug", "barrett"}, material = one_of {"wood", "glass", "rubber"}} end,
    function() return "body.color", {body = "mug", color = {number(0, 1), number(0, 1), number(0, 1)}} end,
    function() return "body.transparency", {body = "mug", transparency = number(0, 1)} end,
    function() return "grasp.dofs", {dofs = dofs()} end,
    function() return "grasp.move_dofs", {dofs = dofs(), stop_at_contact = one_of {true, false}} end,
    function() return "grasp.amplitudes", {amplitudes = {number(-1, 1), number(-1, 1)}} end,
    function() return "grasp.autograsp" end,
    function() return "grasp.open" end,
    function() return "grasp.approach", {reach = number(0, 0.05)} end,
    function() return "grasp.approach_and_grasp" end,
    function() return "grasp.virtual_contacts", {count_per_link = random:integer(1, 3)} end,
    function() return "grasp.save_posture" end,
    function() return "grasp.restore_posture" end,
    function() return "dynamics.run", {seconds = 0.002} end,
    function() return "dynamics.step", {count = random:integer(1, 3)} end,
    function() return "dynamics.push" end,
    function() return "dynamics.pop" end,
    function() return "world.friction", {a = "wood", b = "rubber", mu = number(0, 1)} end,
    function() return "world.settings", {time_step = number(1e-3, 2e-3), gravity = {0, 0, number(-10, 0)}} end,
    function()
      added = added + 1
      return "world.import_obstacle", {path = "models/objects/box.iv", options = {name = "box" .. added, pose = {xyz = {added, 5, 0}}}}
    end,
    function()
      added = added + 1
      return "world.import_object", {path = "models/objects/plate.iv", options = {name = "box" .. added, pose = {xyz = {added, 7, 0}}}}
    end,
    function() return "body.remove", {body = "box" .. random:integer(1, math.max(1, added))} end,
    function() return "body.collisions", {body = "mug", other = one_of {"barrett", nil}} end,
    function() return "world.select", {addresses = {one_of {"mug", "barrett"}}} end,
    function() return "grasp.select_object", {object = "mug"} end,
  }
end

test("the log of a random session of 300 commands makes the same world, and 300 undos restore the initial one", function(t)
  local session, random = opened(), clench.random(7)
  local first = session.world:hash()
  local kinds, refused = random_commands(random), 0
  session:subscribe("diagnostic", function() end)  -- warnings of overlapping bodies are not printed
  local function run_one()
    local name, args = kinds[random:integer(1, #kinds)]()
    local ok, problem = pcall(session.run, session, name, args)
    if ok then return end
    refused = refused + 1  -- a removed body cannot be removed, and an empty stack cannot be popped; motions do not start in collision
    t.ok(tostring(problem):find "there is no body" or tostring(problem):find "cannot run now" or tostring(problem):find "no posture"
         or tostring(problem):find "collision", problem)
  end
  while #session.history.done < 301 do
    for _ = 1, random:integer(1, 6) do run_one() end
    -- some are undone meanwhile, and some of these redone
    for _ = 1, random:integer(0, 2) do
      if #session.history.done > 1 then session:undo() end
    end
    for _ = 1, random:integer(0, 1) do session:redo() end
  end
  while #session.history.done > 301 do session:undo() end
  local last = session.world:hash()
  t.ok(refused < 300, refused)
  t.equal(replayed(session):hash(), last)
  for _ = 1, 300 do session:undo() end
  t.equal(#session.history.done, 1)
  t.equal(session.world:hash(), first)
  for _ = 1, 300 do session:redo() end
  t.equal(session.world:hash(), last)
end)
