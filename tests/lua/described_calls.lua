-- Calls of functions of the engine with one table of options, by name, for ranges_test: `base` has options that the call needs, or that make it quick;
-- `call` gets the options, and a hand that holds an object in a world.
local clench = require "clench"

local function among(options, more)
  for key, value in pairs(more) do
    if options[key] == nil then options[key] = value end
  end
  return options
end

local calls = {}

local function add(name, base, call) calls[name] = {base = base, call = call} end

-- energies
local without_object = {approach_cone = true, reach = true, penetration = true, keep_out = true}
for name, base in pairs {
  contact = {}, potential_quality = {}, guided_potential_quality = {}, autograsp_quality = {}, guided_autograsp_quality = {}, strict_autograsp = {},
  compliant = {}, approach_cone = {axis = {0, 0, 1}}, reach = {point = {0, 0, 0}, radius = 1}, clearance = {distance = 0.01}, penetration = {},
  keep_out = {low = {9, 9, 9}, high = {10, 10, 10}},
} do
  add("clench.energy." .. name, base, function(options, hand, object)
    return clench.energy[name](among(options, {hand = hand, object = not without_object[name] and object or nil}))()
  end)
end

add("clench.annealing", {}, function(options, hand, object)
  local search = clench.annealing(among(options, {hand = hand, object = object, energy = clench.energy.contact {hand = hand, object = object}}))
  search:run(20)
  return {search.energy, search.counts}
end)

-- hands
add("hand:autograsp", {}, function(options, hand)
  hand:open()
  hand:autograsp(options)
  return hand.dofs
end)
add("hand:find_virtual_contacts", {}, function(options, hand) return #hand:find_virtual_contacts(options) end)
add("hand:add_virtual_contact", {point = {0, 0, 0}, normal = {0, 0, 1}}, function(options, hand)
  local contact = hand:add_virtual_contact(among(options, {link = hand.links[1]}))
  return {contact.mu, contact.edges}
end)
add("hand:ik", {}, function(options, hand) return hand:ik(hand.links[1], hand.links[1].pose, options).dofs end)
add("hand:move_dofs", {}, function(options, hand)
  hand:move_dofs({0.02}, options)
  return hand.dofs
end)
for _, name in ipairs {"set_amplitudes", "move_amplitudes"} do
  add("hand:" .. name, {}, function(options, hand)
    hand.eigengrasps = clench.eigengrasps {vectors = {{1}}}
    hand[name](hand, {0.01}, options)
    return hand.dofs
  end)
end
add("hand:set_dofs", {}, function(options, hand) return hand:set_dofs(hand.dofs, options) end)
add("hand:set_targets", {}, function(options, hand) return hand:set_targets(hand.dofs, options) end)
add("hand:mount_on", {}, function(options, hand, _, world)
  local other = world:add_robot("models/hands/parallel_jaw/parallel_jaw.cfg", {pose = {xyz = {1, 0, 0}}})
  other:mount_on(hand, options)
  return other.pose
end)

-- grasps
local function of_grasp(name, base, call)
  add("grasp:" .. name, base, function(options, hand, object) return call(clench.grasp(hand, object), options) end)
end
of_grasp("contact_forces", {}, function(grasp, options) return grasp:contact_forces(options) end)
of_grasp("max_load", {direction = {0, 0, 1, 0, 0, 0}}, function(grasp, options) return grasp:max_load(options).load end)
of_grasp("equilibrium", {}, function(grasp, options) return grasp:equilibrium(options).status end)
of_grasp("optimal_preload", {loads = {{0, 0, -0.1, 0, 0, 0}}}, function(grasp, options) return grasp:optimal_preload(options).status end)
of_grasp("fit_torques", {base = {0.1}, columns = {{1}}, ranges = {{-1, 1}}}, function(grasp, options) return grasp:fit_torques(options).status end)
of_grasp("resistance", {wrench = {0, 0, 1, 0, 0, 0}}, function(grasp, options) return grasp:resistance(options) end)
of_grasp("wrench_space", {}, function(grasp, options) return grasp:wrench_space(options).epsilon end)
of_grasp("save", {}, function(grasp, options)
  grasp:save("build/ranges.xml", options)
  return clench.files.read_text "build/ranges.xml"
end)
add("clench.grasp", {}, function(options, hand, object) return clench.grasp(hand, object, options).epsilon end)
add("clench.grasps", {}, function(options, hand, object)
  local list = clench.grasps()
  list:add(clench.grasp(hand, object))
  list:save "build/ranges.jsonl"
  return #clench.grasps("build/ranges.jsonl", options)
end)
add("list:save", {}, function(options, hand, object)
  local list = clench.grasps()
  list:add(clench.grasp(hand, object))
  list:save("build/ranges.npz", options)
  return clench.files.read_text "build/ranges.npz"
end)
add("clench.eigengrasps", {postures = {{0, 0}, {1, 0}, {2, 1}}}, function(options) return clench.eigengrasps(options).vectors end)

-- wrench spaces
local square = {}
for i, p in ipairs {{1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}} do square[i] = {point = p, normal = {-p[1], -p[2], -p[3]}, mu = 0.5, torsion_radius = 0.1} end
local function space() return clench.wrench_space {contacts = square} end
add("clench.wrench_space", {contacts = square}, function(options) return clench.wrench_space(options).epsilon end)
add("space:epsilon_bounds", {}, function(options) return space():epsilon_bounds(options) end)
add("space:volume_bounds", {edges = 6}, function(options) return clench.wrench_space {contacts = square, edges = "exact"}:volume_bounds(options) end)
add("space:project", {fixed = {tx = 0, ty = 0, tz = 0}}, function(options) return space():project(options).volume end)
add("projection:render", {size = {64, 48}, quality = "draft"}, function(options)
  return space():project {fixed = {tx = 0, ty = 0, tz = 0}}:render(options).camera
end)

-- contacts and patches
local function soft_contact(hand, object, world)
  object.elastic_modulus = 1.5e6
  return world:contacts(hand, object)[1]
end
add("contact:fit_patch", {}, function(options, hand, object, world) return world:contacts(hand, object)[1]:fit_patch(options) == nil end)
for _, name in ipairs {"ellipse", "torsion_limit"} do
  add("patch:" .. name, {}, function(options, hand, object, world)
    local patch = soft_contact(hand, object, world):fit_patch {radius = 0.002}
    return patch[name](patch, options)
  end)
end

-- worlds
add("clench.world", {dynamics = {}}, function(options)
  local world = clench.world(options)
  return {world.gravity, world.contact_threshold, world.dynamics}
end)
add("clench.load", {}, function(options) return #clench.load("worlds/parallel_jaw_cube.wld", options).bodies end)
for _, name in ipairs {"add_object", "add_obstacle"} do
  add("world:" .. name, {pose = {xyz = {0, 0, 3}}}, function(options)
    local world = clench.world()
    local body = world[name](world, clench.shapes.box {1, 1, 1}, options)
    return {body.mass, body.transparency, body.restitution}
  end)
end
add("world:add_robot", {}, function(options) return #clench.world():add_robot("models/hands/parallel_jaw/parallel_jaw.cfg", options).bodies end)
add("world:set_collision_bits", {}, function(options, hand, _, world)
  world:set_collision_bits(hand, options)
  return world:colliding()
end)
add("world:set_friction", {static = 0.5}, function(options, _, _, world)
  world:set_friction("wood", "rubber", options)
  return {world:friction("wood", "rubber")}
end)
add("world:colliding", {}, function(options, _, _, world) return #world:colliding(nil, nil, options) end)
add("world:on_step", {}, function(options, _, _, world) world:on_step(print, options) end)
add("world:log", {quantities = {"energy"}}, function(options, _, _, world)
  local log = world:log(options)
  world:run(0.03)
  return log.rows
end)
add("world:record", {}, function(options, _, _, world)
  local film = world:record(options)
  world:run(0.05)
  return #film.times
end)

-- pictures
add("clench.render", {size = {64, 48}, quality = "draft"}, function(options, _, _, world) return clench.render(world, options).camera end)
add("clench.camera", {size = {64, 48}, quality = "draft"}, function(options, _, _, world) return clench.camera(world, options) end)
add("clench.chart", {series = {{name = "a", values = {1, 2}}}}, function(options) return tostring(clench.chart(options)) end)
add("clench.plot", {series = {{y = {1, 2}}}}, function(options) return tostring(clench.plot(options)) end)
add("clench.sheet", {}, function(options, _, _, world)
  local picture = clench.render(world, {size = {64, 48}, quality = "draft"})
  return tostring(clench.sheet(among(options, {pictures = {picture}})))
end)
add("clench.files.save_gif", {}, function(options, _, _, world)
  clench.files.save_gif("build/ranges.gif", {clench.render(world, {size = {64, 48}, quality = "draft"})}, options)
  return clench.files.read_text "build/ranges.gif"
end)

-- files
local function reading(name, write)
  add("clench.files." .. name, {}, function(options)
    write "build/ranges.file"
    return clench.files[name]("build/ranges.file", options)
  end)
end
local pregrasps = {{point = {0, 0, 0.1}, direction = {0, 0, -1}, thumb = {1, 0, 0}, spread = 1}}
reading("read_text", function(path) clench.files.save_text(path, "text") end)
reading("pregrasps", function(path) clench.files.save_pregrasps(path, pregrasps) end)
reading("object_contacts", function(path) clench.files.save_object_contacts(path, {{frame = {}, normal = {0, 0, 1}}}) end)
reading("arrays", function(path) clench.files.save_arrays(path, {a = {1}}) end)
add("clench.files.save_arrays", {}, function(options)
  clench.files.save_arrays("build/ranges.npz", {a = {1, 2}}, options)
  return clench.files.read_text "build/ranges.npz"
end)
add("clench.files.save_object_contacts", {frame = {}, normal = {0, 0, 1}}, function(options)
  clench.files.save_object_contacts("build/ranges.txt", {options})
  return clench.files.read_text "build/ranges.txt"
end)
add("clench.files.save_pregrasps", {point = {0, 0, 0}, direction = {0, 0, -1}, thumb = {1, 0, 0}}, function(options)
  clench.files.save_pregrasps("build/ranges.txt", {options})
  return clench.files.read_text "build/ranges.txt"
end)
add("clench.convert", {}, function(options) return clench.convert("models/objects/cube.iv", "build/ranges.obj", options) end)
add("clench.json.encode", {}, function(options) return clench.json.encode({a = {1, 2}}, options) end)
add("clench.json.decode", {}, function(options) return clench.json.decode("[1, [2]]", options) end)
add("clench.json.split", {}, function(options) return clench.json.split("[1, [2]]", options) end)
add("clench.parallel.map", {}, function(options) return clench.parallel.map(function(x) return x end, {1, 2}, options) end)

-- user interfaces: calls within a window
local function widget(name, base, arguments, after)
  add("ui:" .. name, base, function(options)
    local ui, result = clench.ui {size = {320, 240}}, nil
    local all = table.pack(table.unpack(arguments))
    all[#all + 1] = options
    if after then all[#all + 1] = after end
    local ok, message = pcall(ui.frame, ui, 0.02, function()
      ui:window("w", {width = 300, height = 200}, function() result = table.pack(ui[name](ui, table.unpack(all, 1, #all))) end)
    end)
    ui:close()
    if not ok then error(message, 0) end
    return result
  end)
end
local function nothing() end
widget("child", {}, {"id"}, nothing)
widget("tree", {}, {"label"}, nothing)
widget("table", {}, {"id", {"a", "b"}}, nothing)
widget("menu_item", {}, {"label"})
widget("text", {}, {"text"})
widget("button", {}, {"label"})
widget("slider", {}, {"label", 0.5})
widget("drag", {}, {"label", 0.5})
widget("number", {}, {"label", 0.5})
widget("text_input", {}, {"label", "text"})
widget("plot", {}, {"label", {1, 2, 3}})
widget("curves", {}, {"label", {{1, 2, 3}}})
widget("line", {}, {{0, 0, 10, 10, 0, 10}})
widget("circle", {}, {10, 10, 5})
widget("label", {}, {10, 10, "text"})
add("ui:window", {}, function(options)
  local ui, result = clench.ui {size = {320, 240}}, nil
  local ok, message = pcall(ui.frame, ui, 0.02, function() result = ui:window("w", options, nothing) end)
  ui:close()
  if not ok then error(message, 0) end
  return result
end)
add("ui:image", {}, function(options, _, _, world)
  local picture, ui = clench.render(world, {size = {64, 48}, quality = "draft"}), clench.ui {size = {320, 240}}
  local ok, message = pcall(ui.frame, ui, 0.02, function()
    ui:window("w", {width = 300, height = 200}, function() ui:image("key", picture, options) end)
  end)
  ui:close()
  if not ok then error(message, 0) end
end)
add("ui:show", {eye = {1, 0, 1}, target = {0, 0, 0}}, function(options, _, _, world)
  local ui = clench.ui {size = {320, 240}}
  local ok, message = pcall(ui.frame, ui, 0.02, function() ui:show(world, options) end)
  ui:close()
  if not ok then error(message, 0) end
end)
for _, name in ipairs {"input", "set_style"} do
  add("ui:" .. name, {}, function(options)
    local ui = clench.ui {size = {320, 240}}
    local ok, message = pcall(ui[name], ui, options)
    ui:close()
    if not ok then error(message, 0) end
  end)
end
add("clench.ui", {size = {320, 240}, window = false}, function(options)
  local ui = clench.ui(options)
  local text = tostring(ui)
  ui:close()
  return text
end)

return calls
