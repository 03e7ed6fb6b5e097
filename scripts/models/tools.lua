-- scripts/models/tools.lua
--- Long objects to grasp, which lie along x on z = 0: see models/objects/README.md for the dimensions.
local shapes = require "clench.shapes"
local build = require "models.build"

--- a mesh built along x with its back towards y: y becomes z
local function upright(mesh) return shapes.turn(mesh, {1, 0, 0}, math.pi / 2) end

--- a propeller plane of wood with its nose towards +x
local function plane()
  local red, cream, dark = {0.76, 0.16, 0.13}, {0.93, 0.88, 0.74}, {0.20, 0.20, 0.22}
  local fuselage = upright(build.limb({
    {x = -88, y = 34, h = 14, w = 8}, {x = -40, y = 33, h = 26, w = 20}, {x = 10, y = 32, h = 34, w = 30},
    {x = 52, y = 32, h = 32, w = 30}, {x = 74, y = 32, h = 27, w = 26},
  }, {first = 6, last = 4, sides = 20}))
  local cabin = upright(build.limb({
    {x = -26, y = 45, h = 10, w = 12}, {x = -4, y = 49, h = 20, w = 19}, {x = 16, y = 47, h = 14, w = 18},
  }, {first = 8, last = 8, sides = 16}))
  -- outlines from above
  local function slab(outline, low, high) return build.plate(outline, low, high, 0.6) end
  local wing = slab(shapes.outline {{0, -95, 12}, {36, -95, 14}, {44, -20, 20}, {44, 20, 20}, {36, 95, 14},
                                    {0, 95, 12}, {-4, 0, 20},
                                    segments = 3}, 21, 27)
  local tail = slab(shapes.outline {{-94, -36, 6}, {-74, -36, 6}, {-66, 0, 4}, {-74, 36, 6}, {-94, 36, 6},
                                    {-90, 0, 4}, segments = 3}, 33, 37)
  local fin = upright(slab({{-96, 35}, {-66, 35}, {-84, 66}, {-96, 66}}, -2.2, 2.2))
  local blades = shapes.turn(slab(shapes.outline {{-29, -3}, {-22, -5.5}, {22, -5.5}, {29, -3}, {29, 3}, {22, 5.5},
                                                  {-22, 5.5}, {-29, 3}}, 79, 83), {0, 1, 0}, math.pi / 2)
  local hub = shapes.cone {8, 2.5, from = {76, 0, 32}, to = {92, 0, 32}, segments = 20}
  local parts = {{fuselage, color = red}, {cabin, color = {0.45, 0.62, 0.72}}, {wing, color = cream},
                 {tail, color = cream},
                 {fin, color = red}, {shapes.move(blades, {0, 0, 32}), color = dark}, {hub, color = dark}}
  for _, y in ipairs {-24, 24} do
    parts[#parts + 1] = {shapes.cylinder {13, from = {30, y - 4, 13}, to = {30, y + 4, 13}, chamfer = 1.2,
                                          segments = 24}, color = dark}
    parts[#parts + 1] = {build.plate({{27, y - 2}, {33, y - 2}, {33, y + 2}, {27, y + 2}}, 13, 24), color = cream}
  end
  return parts
end

--- its tip towards +x
local function screwdriver()
  local handle = {}
  for i, s in ipairs {{-104, 9}, {-103, 13}, {-98, 15}, {-80, 16}, {-45, 13.4}, {-20, 13}, {-12, 10.4}, {-4, 10},
                      {0, 8}} do
    local ring, flutes = {}, i > 2 and i < 7 and 0.07 or 0
    for k = 1, 36 do
      local angle = 2 * math.pi * (k - 1) / 36
      local radius = s[2] * (1 - flutes * (1 + math.cos(6 * angle)) / 2)
      ring[k] = {s[1], radius * math.cos(angle), 16 + radius * math.sin(angle)}
    end
    handle[i] = ring
  end
  local shaft = shapes.cylinder {2.75, from = {-20, 0, 16}, to = {112, 0, 16}, segments = 20}
  local tip = {}
  for i, s in ipairs {{108, 2.7, 2.7}, {116, 2.75, 1.6}, {124, 2.75, 0.5}, {125, 2.75, 0.5}} do
    local ring = {}
    for k = 1, 16 do
      local angle = 2 * math.pi * (k - 0.5) / 16
      ring[k] = {s[1], s[2] * math.cos(angle), 16 + s[3] * math.sin(angle)}
    end
    tip[i] = ring
  end
  return {{shapes.loft(handle), color = {0.86, 0.42, 0.08}}, {shaft, color = {0.72, 0.73, 0.75}},
          {shapes.loft(tip), color = {0.72, 0.73, 0.75}}}
end

--- its head at +x, face and peen along y
local function hammer()
  local steel, ash = {0.36, 0.37, 0.40}, {0.82, 0.66, 0.44}
  local grip = build.limb({
    {x = -250, y = 12.5, h = 24, w = 30}, {x = -215, y = 12.5, h = 25, w = 31}, {x = -120, y = 12.5, h = 20, w = 25},
    {x = -40, y = 12.5, h = 18, w = 22},
    {x = 12, y = 12.5, h = 16, w = 20},
  }, {first = 8, last = 3, sides = 18})
  local head = shapes.loft((function()
    local rings = {}
    for i, s in ipairs {{-50, 11, 11}, {-48, 12.5, 12.5}, {-30, 12.5, 12.5}, {-20, 11.5, 11.5}, {14, 11.5, 11.5},
                        {30, 11, 8}, {53, 10.5, 1.6}} do
      local ring = shapes.outline {{-s[2], -s[3]}, {s[2], -s[3]}, {s[2], s[3]}, {-s[2], s[3]},
                                   rounding = math.min(s[3] * 0.4, 4), segments = 2}
      for k, p in ipairs(ring) do ring[k] = {p[1], s[1], 12.5 + p[2]} end
      rings[i] = ring
    end
    return rings
  end)())
  return {{upright(grip), color = ash}, {head, color = steel}}
end

--- bent in the plane of the table, tapering to a stem at +x
local function banana()
  local path, radii = {}, {}
  local r = 150
  for k = 0, 14 do
    local t = k / 14
    local angle = math.rad(-36 + 72 * t)
    path[k + 1] = {r * math.sin(angle), r * (1 - math.cos(angle)) - 15, 18}
    radii[k + 1] = 18 * math.min(1, 0.42 + 2.3 * math.sin(math.pi * math.min(t * 0.9 + 0.03,
        1)) * 0.5) * (t > 0.84 and 1 - 2.3 * (t - 0.84) or 1)
  end
  local fruit = shapes.tube {path, radius = radii, ends = "round", sides = 10, steps = 3}
  local last, before = path[#path], path[#path - 1]
  local d = {last[1] - before[1], last[2] - before[2]}
  local stem = shapes.cone {5.2, 4, from = {last[1] - d[1] * 0.2, last[2] - d[2] * 0.2, 18},
                            to = {last[1] + d[1] * 1.4, last[2] + d[2] * 1.6, 18},
                            segments = 12}
  return {{fruit, color = {0.93, 0.78, 0.20}}, {stem, color = {0.48, 0.40, 0.16}}}
end

return {
  {"models/objects/plane.iv", about = "toy plane of wood", material = "wood", density = 0.72e-3, parts = plane()},
  {"models/objects/screwdriver.iv", about = "screwdriver, 5.5 x 125", material = "plastic", mass = 78,
   parts = screwdriver()},
  {"models/objects/hammer.iv", about = "engineer's hammer, 300 g", material = "wood", mass = 395, parts = hammer()},
  {"models/objects/banana.iv", about = "banana", material = "plastic", mass = 150, parts = banana()},
}
