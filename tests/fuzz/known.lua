-- What the docs' types leave open: how long lists are, which numbers a name means, which files an entry reads.
local random = math.random
local function one_of(list) return list[random(#list)] end
local known = {}

-- numbers in a list of this name
known.lengths = {
  load = 6, direction = 6, wrench = 6, wrenches = 6, ellipsoid = 6, edges = 6, color = 3, rpy = 3, quat = 4, matrix = 4,
  size = 2, outline = 2, profile = 2, path = 3, from = 3, to = 3, up = 3, given = 3, vertices = 3, triangles = 3, apart = 3,
}

local function decimal(low, high) return function() return ("%.3g"):format(low + random() * (high - low)) end end
local function whole(low, high) return function() return tostring(random(low, high)) end end
known.numbers = {
  mass = decimal(0.01, 2), mu = decimal(0, 1.5), static = decimal(0, 2), contact_threshold = decimal(1e-6, 1e-2),
  elastic_modulus = function() return ("%.3g"):format(10 ^ random(3, 8)) end, poisson_ratio = decimal(0, 0.5),
  soft_layer = decimal(1e-4, 0.02), torsion_radius = decimal(0, 0.01), color = decimal(0, 1), transparency = decimal(0, 1),
  radius = decimal(0, 0.05), height = decimal(0, 0.2), tube = decimal(0.001, 0.01), segments = whole(3, 24), steps = whole(1, 8),
  sides = whole(3, 9), subdivisions = whole(0, 3), width = whole(1, 90), size = whole(1, 90), samples = whole(1, 3),
  per_link = whole(1, 4), chain = whole(0, 3), t = decimal(0, 1), tolerance = decimal(1e-6, 1e-2), seed = whole(0, 99),
  reach = decimal(0, 1), total_force = decimal(0.1, 50), max_force = decimal(0.1, 50), max_total_force = decimal(0.1, 50),
}

local light = {"models/objects/cube.iv", "models/objects/sphere.iv", "models/objects/mug.iv"}
local files = {
  ["clench.load"] = {"worlds/parallel_jaw_cube.wld", "worlds/adaptive_cylinder.wld", "worlds/barrett_mug.wld"},
  add_robot = {"models/hands/parallel_jaw/parallel_jaw.cfg", "models/hands/barrett/barrett.cfg",
               "models/hands/three_finger/three_finger.cfg"},
  add_object = light, add_obstacle = light,
  ["clench.files.eigengrasps"] = {"models/hands/barrett/barrett.egr", "models/hands/human/human16.egr"},
  ["clench.files.virtual_contacts"] = {"models/hands/barrett/barrett.vgr"},
}
known.files = files

--- of the files that an entry writes; `save` has many
known.endings = {save_virtual_contacts = ".vgr"}

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

-- each is called with the maker
known.sources = {
  object = objects,
  contacts = contacts, inertia = diagonal, parts = function() return ("{%s, %s}"):format(one_of(shapes), one_of(shapes)) end,
  body = function() return one_of(shapes) end,
}

known.heavy = {
  ["clench.render"] = true, render = true, quality_all = true, save = true, volume = true, volume_bounds = true, project = true,
  find_virtual_contacts = true, move_to = true, ["clench.study.robustness"] = true, ["clench.study.compare"] = true, ["clench.convert"] = true,
  ["clench.catalog"] = true, ["clench.entries"] = true,
}

return known
