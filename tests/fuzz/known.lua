-- Facts that the types in the docs leave open: lengths of lists, numbers that a name requires, files that an entry reads.
local random = math.random
local function one_of(list) return list[random(#list)] end
local known = {}

-- length of a list with this name
known.lengths = {
  load = 6, direction = 6, wrench = 6, wrenches = 6, ellipsoid = 6, edges = 6, color = 3, rpy = 3, quat = 4, matrix = 4,
  size = 2, outline = 2, profile = 2, path = 3, from = 3, to = 3, up = 3, given = 3, vertices = 3, triangles = 3, joint_positions = 3,
}

local function decimal(low, high) return function() return ("%.3g"):format(low + random() * (high - low)) end end
local function whole(low, high) return function() return tostring(random(low, high)) end end
known.numbers = {
  mass = decimal(0.01, 2), mu = decimal(0, 1.5), static = decimal(0, 2), contact_threshold = decimal(1e-6, 1e-2),
  elastic_modulus = function() return ("%.3g"):format(10 ^ random(3, 8)) end, poisson_ratio = decimal(0, 0.5),
  soft_layer = decimal(1e-4, 0.02), torsion_radius = decimal(0, 0.01), color = decimal(0, 1), transparency = decimal(0, 1),
  radius = decimal(0, 0.05), height = decimal(0, 0.2), tube = decimal(0.001, 0.01), segments = whole(3, 24), steps = whole(1, 8),
  sides = whole(3, 9), subdivisions = whole(0, 3), width = whole(1, 90), size = whole(1, 90), samples = whole(1, 3),
  count_per_link = whole(1, 4), chain = whole(0, 3), t = decimal(0, 1), tolerance = decimal(1e-6, 1e-2), seed = whole(0, 99),
  reach = decimal(0, 1), total_force = decimal(0.1, 50), max_force = decimal(0.1, 50), max_total_force = decimal(0.1, 50),
}

local light = {"models/objects/cube.iv", "models/objects/sphere.iv", "models/objects/mug.iv"}
local files = {
  ["clench.load"] = {"worlds/parallel_jaw_cube.wld", "worlds/tendon_cylinder.wld", "worlds/barrett_mug.wld"},
  ["world:add_robot"] = {"models/hands/parallel_jaw/parallel_jaw.cfg", "models/hands/barrett/barrett.cfg",
                         "models/hands/three_finger/three_finger.cfg", "models/arms/puma560/puma560.cfg"},
  ["world:add_object"] = light, ["world:add_obstacle"] = light, ["clench.convert"] = light, ["clench.files.primitives"] = light,
  ["clench.files.eigengrasps"] = {"models/hands/barrett/barrett.egr", "models/hands/human/human16.egr"},
  ["clench.files.virtual_contacts"] = {"models/hands/barrett/barrett.vgr"},
  ["clench.files.object_contacts"] = {"seeds/two.con", "seeds/unplaced.con"},
  ["clench.files.pregrasps"] = {"seeds/pregrasps.lst"},
  ["clench.grasps"] = {"seeds/grasps.jsonl", "seeds/planned.lst"},
  ["clench.files.glove_calibration"] = {"seeds/calibration.cal"}, ["clench.files.glove_poses"] = {"seeds/poses.cal"},
}
known.files = files

--- extensions of the files that an entry writes; `save` of a world has many
known.endings = {
  ["hand:save_virtual_contacts"] = {".vgr", ".xml"}, ["eigengrasps:save"] = {".egr", ".xml"}, ["picture:save"] = {".png"},
  ["plot:save"] = {".png", ".svg"}, ["clench.csv.write"] = {".csv"}, ["clench.latex.write"] = {".tex"}, ["clench.files.save_text"] = {".txt"},
  ["mesh:save"] = {".obj", ".stl", ".ply", ".off"}, ["world:save"] = {".wld", ".lua", ".xml"},
  ["clench.convert"] = {".obj", ".stl", ".ply", ".off", ".iv", ".xml"},
}

-- options of a body
local body_keys = "name?: string, material?: string, mass?: number, com?: vec3, inertia?: number[][], elastic_modulus?: number, "
  .. "soft_layer?: number, poisson_ratio?: number, color?: number[], transparency?: number"
local contact_keys = "point: vec3, normal: vec3, mu: number, torsion_radius?: number"

--- types that docs leave at `table`, by entry and parameter
known.types = {
  ["world:add_obstacle options"] = "{pose?: pose, density?: number, root?: string, confine?: string, strict?: boolean, "
    .. "unit?: string, mesh_scale?: number, " .. body_keys .. "}",
  ["world:add_object body"] = "string|{vertices: number[][], triangles: integer[][]}",
  ["world:add_obstacle body"] = "string|{vertices: number[][], triangles: integer[][]}",
  ["world:add_robot options"] = "{pose?: pose, name?: string, root?: string, confine?: string, strict?: boolean, folder?: string, "
    .. "package?: string, eigengrasps?: string, virtual_contacts?: string, close?: table<string, number>, "
    .. "approach?: {point?: vec3, direction: vec3}|{frame: pose}}",
  ["robot:open options"] = "{}",
  ["clench.wrench_space options"] = "{contacts: {" .. contact_keys .. "}[], norm?: string, edges?: integer|string, rho?: number, "
    .. "com?: vec3, coordinates?: string[]}",
  ["clench.render options"] = "{size: integer[], eye?: vec3, target?: vec3, up?: vec3, field_of_view?: number, "
    .. "contacts?: boolean, patches?: boolean, ground?: boolean, transparent_objects?: boolean, file_colors?: boolean, "
    .. "samples?: integer, forces?: {contact: contact, force: vec3}[], force_scale?: number}",
}

local shape = "@param shape table\n"
--- functions of the standard library that packed files offer under another name
known.packed = {
  ["clench.shapes.area"] = shape, ["clench.shapes.bounds"] = shape, ["clench.shapes.closed"] = shape,
  ["clench.shapes.mass"] = shape, ["clench.shapes.volume"] = shape,
  ["clench.shapes.move"] = shape .. "@param offset number[]", ["clench.shapes.scale"] = shape .. "@param factor number|number[]",
  ["clench.shapes.turn"] = shape .. "@param axis number[]\n@param angle number\n@param about? number[]",
  ["clench.shapes.mirror"] = shape .. '@param axis "x"|"y"|"z"',
  ["clench.shapes.rounded_box"] = "@param given {x: number, y: number, z: number, rounding: number, segments?: integer}",
}

local shapes = {
  "clench.shapes.sphere {0.02}", "clench.shapes.box {0.02, 0.03, 0.04}", "clench.shapes.torus {0.02, 0.004}",
  "{vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, triangles = {{1, 3, 2}, {1, 2, 4}, {1, 4, 3}, {2, 3, 4}}}",
  "{vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, triangles = {{1, 2, 3}}}",
}
local function contact()
  local normal = one_of {"{1, 0, 0}", "{-1, 0, 0}", "{0, 1, 0}", "{0, 0, -1}", "{0.6, 0.8, 0}"}
  return ("{point = {%.3g, %.3g, %.3g}, normal = %s, mu = %.2g, torsion_radius = %s}"):format(random() - 0.5, random() - 0.5,
    random() - 0.5, normal, random(), one_of {"0", "0", "0.01"})
end
local function contacts()
  local list = {}
  for i = 1, random(1, 6) do list[i] = contact() end
  return "{" .. table.concat(list, ", ") .. "}"
end
local function diagonal()
  local a, b = random(), random()
  local least = math.abs(a - b)
  return ("{{%.3g, 0, 0}, {0, %.3g, 0}, {0, 0, %.3g}}"):format(a, b, least + random() * (a + b - least))
end
local function objects(self)
  local world = self:object "world"
  return world and world .. ".objects[1]" or "nil"
end
local function text_of(list) return function() return ("%q"):format(one_of(list)) end end
local function source_of(list) return function() return one_of(list) end end
local coordinates = source_of {"{'fx', 'fy', 'fz'}", "{'fx', 'fy', 'tz'}", "{'tx', 'ty', 'tz'}"}

--- by parameter or field, or by entry and name; each is called with the maker
known.sources = {
  object = objects, shape = source_of(shapes),
  contacts = contacts, inertia = diagonal, parts = function() return ("{%s, %s}"):format(one_of(shapes), one_of(shapes)) end,
  ["world:add_object body"] = source_of(shapes), ["world:add_obstacle body"] = source_of(shapes),
  norm = text_of {"L1", "Linf"}, coordinates = coordinates, projected = coordinates,
  ["clench.eigengrasps norm"] = source_of {"{1, 1}", "{1, 2}"},
  ["clench.eigengrasps origin"] = source_of {"{0, 0}", "{0.5, 1}"},
  ["clench.eigengrasps limits"] = source_of {"{{-1, 1}, {-1, 1}}", "{{-1, 1}}"},
  ["wrench_space:project fixed"] = source_of {"{tx = 0, ty = 0, tz = 0}", "{fx = 0.1, fy = 0, fz = 0}", "{tz = 0}"},
  profile = source_of {"{{0, 0}, {0.02, 0}, {0.02, 0.05}, {0, 0.05}}", "{{0.01, 0}, {0.02, 0}, {0.02, 0.05}}"},
  outline = source_of {"{{0, 0}, {0.02, 0}, {0.02, 0.05}, {0, 0.05}}", "clench.shapes.ring {0.02}"},
  ["clench.shapes.tube path"] = source_of {"{{0, 0, 0}, {0, 0, 0.1}, {0, 0.1, 0.1}}", "{{0, 0, 0}, {0, 0, 0.1}}"},
  ["clench.json.decode text"] = text_of {'{"a": [1, 2.5e3, null, true, "\\u00e9\\n"]}', "[[], {}, -0.0]", '"x"', "1e400", "[1,", "NaN"},
  unit = text_of {"mm", "cm", "m"}, measures = source_of {"{'epsilon'}", "{'epsilon', 'volume'}"},
  objective = text_of {"min_sum", "min_norm", "min_max", "max_margin", "max_margin_sum"}, modulus = text_of {"series", "larger"},
  torques = text_of {"springs", "limits"}, balance = text_of {"exact", "nearest"},
  edges = source_of {"8", "4", "12", "'exact'"}, rho = source_of {"0.1", "1", "'gyration'"}, samples = source_of {"1", "2"},
  ["hand:add_virtual_contact edges"] = source_of {"{{0, 0, 1, 0, 0, 0}, {0.5, 0, 1, 0, 0, 0}, {0, 0.5, 1, 0, 0, 0}}"},
  ["clench.files.save_object_contacts edges"] = source_of {"{{0, 0, 1, 0, 0, 0}}"},
  ["robot:set_dofs joint_positions"] = source_of {"{}", "{{1, 1, 0}}", "{{1, 2, 0.1}}"},
  quat = source_of {"{1, 0, 0, 0}", "{0.6, 0, 0.8, 0}"},
  ["clench.shapes.turn axis"] = source_of {"{0, 0, 1}", "{1, 1, 0}"},
  matrix = source_of {"{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}", "{{0, -1, 0}, {1, 0, 0}, {0, 0, 1}}"},
  color = source_of {"{0.1, 0.5, 1}"}, up = source_of {"{0, 0, 1}", "{0, 1, 0}"}, field_of_view = source_of {"0.5", "1"},
  confine = source_of {"'.'"}, root = source_of {"'.'", "'models'"}, folder = source_of {"'.'"}, package = source_of {"'.'"},
  camera = source_of {"{eye = {1, 1, 1}, target = {0, 0, 0}, up = {0, 0, 1}, field_of_view = math.pi / 4}", "nil"},
  ["robot:mount_on parent"] = function(self) return (self:object "world" or "nil") .. ".robots[2]" end,
  ["hand:set_amplitudes fixed"] = source_of {"{1}", "{}"}, ["hand:move_amplitudes fixed"] = source_of {"{1}", "{}"},
  close = source_of {"{[1] = 1}", "{[1] = -1, [2] = 0}"}, labels = source_of {"{'one'}", "{'one', 'two'}"},
  adapter = text_of {"models/objects/cube.iv"},
  ["world:add_robot eigengrasps"] = text_of {"models/hands/barrett/barrett.egr"}, ["world:add_robot virtual_contacts"] = text_of {"models/hands/barrett/barrett.vgr"},
  size = source_of {"{16, 16}", "{64, 48}"},
  link = function(self) local robot = self:object "robot" return robot and robot .. ".links[2]" or "nil" end,
}

--- complete lists of arguments for entries whose arguments must match each other
known.arguments = {
  ["clench.eigengrasps"] = source_of {"{postures = {{0, 0}, {1, 2}, {2, 5}}, count = 1}", "{vectors = {{1, 0}, {0, 3}}}",
                                      "{vectors = {{1, 0}, {0, 3}}, origin = {1, 1}, eigenvalues = {1, 2}, limits = {{-1, 1}, {-1, 1}}, norm = {1, 2}}",
                                      "{postures = {{0, 0}, {1, 2}, {2, 5}}, norm = {1, 1}}"},
  ["clench.shapes.box"] = source_of {"{0.1, 0.2, 0.3, chamfer = 0.01}", "{x = 0.1, y = 0.2, z = 0.3, rounding = 0.02, segments = 4}"},
  ["clench.shapes.loft"] = source_of {"{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 0, 1}, {1, 0, 1}, {0, 1, 1}}}"},
  ["clench.shapes.outline"] = source_of {"{{0, 0}, {1, 0}, {1, 1}, rounding = 0.1, segments = 3}", "{{0, 0}, {1, 0, 0.2}, {1, 1}}"},
  ["clench.shapes.cylinder"] = source_of {"{radius = 0.1, height = 0.2, chamfer = 0.01}", "{0.1, 0.2, rounding = 0.02, segments = 9}",
                                          "{radius = 0.1, from = {0, 0, 0}, to = {0, 1, 1}}"},
  ["clench.shapes.capsule"] = source_of {"{radius = 0.1, length = 0.2, segments = 8}", "{radius = 0.1, top = 0.05, from = {0, 0, 0}, to = {0, 1, 1}}"},
  ["clench.shapes.cone"] = source_of {"{bottom = 0.1, top = 0.05, height = 0.2, segments = 9}", "{bottom = 0.1, from = {0, 0, 0}, to = {0, 1, 1}}"},
  ["clench.shapes.rounded_box"] = source_of {"{x = 0.1, y = 0.2, z = 0.3, rounding = 0.02, segments = 4}"},
  ["clench.shapes.prism"] = source_of {"{outline = {{0, 0}, {0.1, 0}, {0, 0.1}}, height = 0.1, chamfer = 0.01}",
                                       "{outline = {{0, 0}, {0.1, 0}, {0, 0.1}}, height = 0.1, rounding = 0.01, segments = 3}"},
  ["clench.shapes.tube"] = source_of {
    "{path = {{0, 0, 0}, {0, 0, 0.1}, {0, 0.1, 0.1}}, radius = 0.01, ends = 'round', sides = 7, steps = 2}",
    "{path = {{0, 0, 0}, {0, 0, 0.1}, {0, 0.1, 0.1}}, radius = {0.01, 0.02, 0.01}, up = {1, 0, 0}}",
    "{path = {{0, 0, 0}, {0, 0, 0.1}, {0, 0.1, 0.1}}, profile = {{-0.01, -0.01}, {0.01, -0.01}, {0, 0.01}}, closed = true}"},
  ["wrench_space:project"] = source_of {"{fixed = {tx = 0, ty = 0, tz = 0}, tolerance = 0.01}", "{projected = {'tx', 'ty', 'tz'}}",
                                        "{fixed = {tx = 0}, projected = {'ty', 'tz'}}"},
  ["clench.chart"] = source_of {
    "{series = {{name = 'a', values = {1, 2, false}}, {name = 'b', values = {-1, 1e-3, 4}, higher_is_better = false}}, labels = {'x', 'y', 'z'}, title = 't', width = 200, height = 150}",
    "{series = {{name = 'a', values = {0}}}}"},
  ["clench.plot"] = source_of {
    "{series = {{name = 'a', y = {1, false, 3}}, {kind = 'points', x = {1, 2}, y = {3, -1}}}, title = 't', width = 200, height = 150}",
    "{categories = {'a', 'b', 'c'}, series = {{name = 'n', y = {1, false, -3}}, {y = {1, 1e300, 3}}, {kind = 'line', y = {0, 1, 2}}}}",
    "{series = {{edges = {0, 1, 2}, counts = {1, 2}}}, x_range = {-1, 3}}"},
}

--- makes an object of a class from others, if there is none yet
known.providers = {
  contact = "world:contacts()[1]", patch = "contact:fit_patch()", virtual_contact = "robot.virtual_contacts[1]",
  eigengrasps = "robot.eigengrasps", mesh = "body.mesh", snapshot = "world:snapshot()",
  projection = "wrench_space:project {fixed = {tx = 0, ty = 0, tz = 0}}", picture = "projection:render {size = {16, 16}}",
  random = "clench.random(7)", vec3 = "clench.vec3(1, 2, 3)", pose = "clench.pose {rpy = {1, 2, 3}}",
}

-- holding it in the hand's current posture
local function grasp(self)
  local robot = self:object "robot"
  return robot and ("clench.grasp(%s, %s.world.objects[1], {edges = %s})"):format(robot, robot, one_of {"8", "4", "'exact'"})
end
--- objects that a motion invalidates
known.stale = {grasp = grasp, measures = grasp, forces = grasp}

--- slow entries: called less frequently by this factor
known.heavy = {
  ["clench.render"] = 60, ["projection:render"] = 60, ["measures:quality_all"] = 30, ["wrench_space:volume"] = 30,
  ["wrench_space:volume_bounds"] = 30, ["wrench_space:project"] = 10, ["hand:find_virtual_contacts"] = 5, ["body:move_to"] = 10,
  ["robot:move_to"] = 10, ["robot:approach_object"] = 40, ["robot:open"] = 5, ["clench.study.robustness"] = 8,
  ["clench.study.compare"] = 8, ["clench.catalog"] = 5, ["clench.entries"] = 5, ["clench.report.of"] = 5,
}
--- the same for all entries that need an object of one of these classes
known.heavy_classes = {picture = 80, projection = 10, virtual_contact = 3}

--- Reciprocal of a step's frequency among its kind; nil for 1.
function known.rarity(step)
  local searches = step.lines and (step.entry:find "^clench%.plan%." or step.entry:find "^clench%.study%." or step.class == "picture")
  return searches and 12 or known.heavy[step.entry] or known.heavy_classes[step.class]
end

return known
