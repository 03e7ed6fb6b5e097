-- scripts/models/arms.lua
--- Arms: a Puma 560 and a six-axis collaborative arm modeled on the UR5. Both have their base at z = 0. See the README.md next to each.
local shapes = require "clench.shapes"
local build = require "models.build"
local robot = require "models.robot"

local white, gray, dark, steel = {0.86, 0.86, 0.84}, {0.50, 0.52, 0.54}, {0.18, 0.19, 0.20}, {0.68, 0.70, 0.72}
local blue = {0.36, 0.58, 0.76}

local function bar(radius, from, to, chamfer, segments)
  return shapes.cylinder {radius, from = from, to = to, chamfer = chamfer or 3, segments = segments or 36}
end

local function arm(r)
  local folder = "models/arms/" .. r.name .. "/"
  local out, links = {}, {}
  for i, b in ipairs(r.bodies) do
    out[i] = {folder .. "iv/link" .. i - 1 .. ".iv",
              about = (i == 1 and "base" or "link " .. i - 1) .. " of " .. r.about,
              material = "metal", mass = b.mass, cog = b.cog, inertia = b.inertia, parts = b.parts}
    if i > 1 then links[i - 1] = {"Revolute", "link" .. i - 1 .. ".iv", i - 2} end
  end
  local dofs = {}
  for i, effort in ipairs(r.efforts) do
    dofs[i] = {speed = 1, effort = effort, kp = 40 * effort, kd = 4 * effort, handle = i < 4 and 80 or 40}
  end
  out[#out + 1] = {folder .. r.name .. ".cfg", text = robot.text {
    about = "An arm of six axes: " .. r.about, class = r.class, palm = "link0.iv", dofs = dofs,
    chains = {{about = "arm", base = {r.base}, joints = r.joints, links = links}},
  }}
  return out
end

-- published centers of gravity, moments [kg m^2] and masses [kg] of links, in the frames of the table
local function rigid(mass, cog, moments, parts)
  local inertia = {}
  for k = 1, 3 do inertia[k] = moments[k] / mass * 1e6 end
  return {mass = mass * 1000, cog = cog, inertia = inertia, parts = parts}
end

local function puma()
  local base = {
    {bar(178, {0, 0, 0}, {0, 0, 22}), color = dark},
    {bar(82, {0, 0, 22}, {0, 0, 560}, 2), color = white},
    {bar(94, {0, 0, 300}, {0, 0, 440}, 8), color = white},
    {shapes.move(shapes.box {120, 90, 150, rounding = 8, segments = 2}, {-80, 0, 97}), color = dark},
  }
  -- y is up, z along the shoulder's axis
  local shoulder = {
    {bar(90, {0, -110, 0}, {0, -66, 0}), color = dark},
    {bar(88, {0, -66, 0}, {0, 60, 0}, 10), color = white},
    {bar(92, {0, 0, -118}, {0, 0, 195}, 8), color = white},
    {bar(70, {0, 0, -132}, {0, 0, -112}, 4), color = dark},
  }
  -- x from shoulder (-431.8) to elbow (0)
  local upper = {
    {build.plate(build.belt({-431.8, 0}, 104, {0, 0}, 66, 10), 200, 272, 10), color = white},
    {build.plate(shapes.outline {{-640, -52, 20}, {-480, -80}, {-480, 80}, {-640, 52, 20}, segments = 3}, 204, 268,
                 8), color = white},
    {bar(70, {-431.8, 0, 186}, {-431.8, 0, 210}), color = dark},
    {bar(58, {-431.8, 0, 268}, {-431.8, 0, 282}, 4), color = dark},
    {bar(40, {0, 0, 268}, {0, 0, 282}, 4), color = dark},
    {bar(56, {0, 0, 196}, {0, 0, 206}), color = dark},
  }
  -- z along the forearm; the elbow's axis runs along y at x = -20.3
  local rings = {}
  for i, s in ipairs {{-95, 92, 70}, {-80, 108, 80}, {20, 116, 86}, {120, 104, 84}, {350, 76, 72}, {362, 70, 66}} do
    local ring = shapes.outline {{-s[2] / 2, -s[3] / 2}, {s[2] / 2, -s[3] / 2}, {s[2] / 2, s[3] / 2},
                                 {-s[2] / 2, s[3] / 2},
                                 rounding = 18, segments = 3}
    for k, p in ipairs(ring) do ring[k] = {p[1] - 10 + 10 * math.max(0, s[1]) / 362, p[2], s[1]} end
    rings[i] = ring
  end
  local forearm = {{shapes.loft(rings), color = white}, {bar(60, {-20.3, -50, 0}, {-20.3, 49, 0}), color = white},
                   {bar(32, {0, 0, 358}, {0, 0, 372}), color = dark}}
  -- the forearm's axis runs along y
  local wrist = {{bar(34, {0, -60, 0}, {0, -37, 0}), color = white},
                 {build.fork(build.belt({0, -38}, 27, {0, 0}, 25, 8), 27, 36, 3), color = white}}
  local ball = {{bar(24, {0, -33, 0}, {0, 33, 0}, 2), color = dark},
                {bar(20, {0, 0, 0}, {0, 0, 35}, 2), color = white}}
  local flange = {{bar(26, {0, 0, 34}, {0, 0, 46}, 2), color = dark},
                  {bar(31.5, {0, 0, 46}, {0, 0, 56.25}, 1), color = steel}}
  return arm {
    name = "puma560", class = "Puma560", about = "the Puma 560", base = "t 0 0 671.83",
    efforts = {97.6, 186.4, 89.4, 24.2, 20.1, 21.3},
    joints = {
      {"d0", 0, 0, 90, -160, 160}, {"d1", 0, 431.8, 0, -45, 225}, {"d2", 150.05, 20.3, -90, -225, 45},
      {"d3", 431.8, 0, 90, -110, 170}, {"d4", 0, 0, -90, -100, 100}, {"d5", 0, 0, 0, -266, 266},
    },
    bodies = {
      {mass = 25000, parts = base}, {mass = 13000, parts = shoulder},
      rigid(17.4, {-363.8, 6, 227.5}, {0.13, 0.524, 0.539}, upper),
      rigid(4.8, {-20.3, -14.1, 70}, {0.066, 0.086, 0.0125}, forearm),
      rigid(0.82, {0, 19, 0}, {1.8e-3, 1.3e-3, 1.8e-3}, wrist),
      rigid(0.34, {0, 0, 0}, {0.3e-3, 0.4e-3, 0.3e-3}, ball),
      rigid(0.09, {0, 0, 32}, {0.15e-3, 0.15e-3, 0.04e-3}, flange),
    },
  }
end

--- a round housing from a to b with a colored cap beyond b
local function housing(list, radius, from, to, cap)
  local d = {}
  for k = 1, 3 do d[k] = to[k] > from[k] and 1 or to[k] < from[k] and -1 or 0 end
  local function beyond(p, length) return {p[1] + d[1] * length, p[2] + d[2] * length, p[3] + d[3] * length} end
  list[#list + 1] = {bar(radius, from, to, 2, 28), color = steel}
  if cap then list[#list + 1] = {bar(radius - 2.5, beyond(to, -0.5), beyond(to, 8), 4, 28), color = blue} end
end

local function collaborative()
  local base, shoulder, upper, forearm, wrist1, wrist2, flange = {}, {}, {}, {}, {}, {}, {}
  base[1] = {bar(74.5, {0, 0, 0}, {0, 0, 16}, 3), color = gray}
  base[2] = {bar(62, {0, 0, 16}, {0, 0, 38}, 4), color = steel}
  -- y is up, z along the shoulder's axis
  housing(shoulder, 60, {0, -50, 0}, {0, 52, 0}, true)
  housing(shoulder, 56, {0, 0, 20}, {0, 0, 74}, false)
  -- from the shoulder (x = 425) to the elbow (x = 0), beside them at z = 136
  housing(upper, 58, {425, 0, 76}, {425, 0, 188}, true)
  housing(upper, 46, {0, 0, 76}, {0, 0, 178}, true)
  upper[#upper + 1] = {bar(42, {20, 0, 136}, {405, 0, 136}, 2, 28), color = steel}
  -- from the elbow (x = 392.25) to the wrist (x = 0), at z = 16
  housing(forearm, 45, {392.25, 0, 74}, {392.25, 0, -28}, true)
  housing(forearm, 37, {0, 0, 60}, {0, 0, -24}, true)
  forearm[#forearm + 1] = {bar(34, {15, 0, 16}, {375, 0, 16}, 2, 28), color = steel}
  housing(wrist1, 37, {0, -47, 0}, {0, 38, 0}, true)
  housing(wrist1, 36, {0, 0, 15}, {0, 0, 46}, false)
  housing(wrist2, 37, {0, 47, 0}, {0, -38, 0}, true)
  housing(wrist2, 36, {0, 0, 15}, {0, 0, 41}, false)
  flange[1] = {bar(36, {0, 0, -40}, {0, 0, -8}, 2, 28), color = steel}
  flange[2] = {bar(31.5, {0, 0, -9}, {0, 0, 0}, 1, 28), color = gray}
  return arm {
    name = "ur5", class = "Robot", about = "a collaborative arm after the UR5", base = "t 0 0 0",
    efforts = {150, 150, 150, 28, 28, 28},
    joints = {
      {"d0", 89.159, 0, 90, -360, 360}, {"d1", 0, -425, 0, -360, 360}, {"d2", 0, -392.25, 0, -360, 360},
      {"d3", 109.15, 0, 90, -360, 360}, {"d4", 94.65, 0, -90, -360, 360}, {"d5", 82.3, 0, 0, -360, 360},
    },
    bodies = {
      {mass = 4000, parts = base}, {mass = 3700, cog = {0, -25.61, 1.93}, parts = shoulder},
      {mass = 8393, cog = {212.5, 0, 113.36}, parts = upper}, {mass = 2330, cog = {150, 0, 26.5}, parts = forearm},
      {mass = 1219, cog = {0, -1.8, 16.34}, parts = wrist1}, {mass = 1219, cog = {0, 1.8, 16.34}, parts = wrist2},
      {mass = 187.9, cog = {0, 0, -1.159}, parts = flange},
    },
  }
end

local all = puma()
for _, entry in ipairs(collaborative()) do all[#all + 1] = entry end
return all
