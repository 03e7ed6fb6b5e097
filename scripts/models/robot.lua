-- scripts/models/robot.lua
--- Text of a robot file (.cfg): palm, DOFs, chains of joints and links [mm, degrees].
local shapes = require "clench.shapes"
local robot = {}

local function number(x)
  local text = ("%.9f"):format(x):gsub("0+$", ""):gsub("%.$", "")
  return text == "-0" and "0" or text
end

local function words(list)
  local out = {}
  for i, x in ipairs(list) do out[i] = type(x) == "number" and number(x) or x end
  return table.concat(out, " ")
end

local function unit(a)
  local n = math.sqrt(a[1] ^ 2 + a[2] ^ 2 + a[3] ^ 2)
  return {a[1] / n, a[2] / n, a[3] / n}
end

local function cross(a, b)
  return {a[2] * b[3] - a[3] * b[2], a[3] * b[1] - a[1] * b[3], a[1] * b[2] - a[2] * b[1]}
end

--- Quaternion {w, x, y, z}, w >= 0, of the rotation that takes the axes to the given unit vectors.
function robot.quaternion(x, y, z)
  local trace = x[1] + y[2] + z[3]
  local q
  if trace > 0 then
    q = {1 + trace, y[3] - z[2], z[1] - x[3], x[2] - y[1]}
  elseif x[1] >= y[2] and x[1] >= z[3] then
    q = {y[3] - z[2], 1 + x[1] - y[2] - z[3], x[2] + y[1], z[1] + x[3]}
  elseif y[2] >= z[3] then
    q = {z[1] - x[3], x[2] + y[1], 1 - x[1] + y[2] - z[3], y[3] + z[2]}
  else
    q = {x[2] - y[1], z[1] + x[3], y[3] + z[2], 1 - x[1] - y[2] + z[3]}
  end
  local n = math.sqrt(q[1] ^ 2 + q[2] ^ 2 + q[3] ^ 2 + q[4] ^ 2) * (q[1] < 0 and -1 or 1)
  for k = 1, 4 do q[k] = q[k] / n end
  return q
end

--- A frame at `origin` with its z axis along `z` and its x axis as near `x` as that allows, as a transform line.
function robot.frame(origin, x, z)
  z = unit(z)
  local y = unit(cross(z, x))
  x = cross(y, z)
  return ("T (%s)[%s]"):format(words(robot.quaternion(x, y, z)), words(origin))
end

--- The shape in such a frame.
function robot.seen_from(shape, origin, x, z)
  z = unit(z)
  local y = unit(cross(z, x))
  x = cross(y, z)
  local out = shapes.move(shape, {-origin[1], -origin[2], -origin[3]})
  for i, p in ipairs(out.vertices) do
    local q = {}
    for k, axis in ipairs {x, y, z} do q[k] = axis[1] * p[1] + axis[2] * p[2] + axis[3] * p[3] end
    out.vertices[i] = q
  end
  return out
end

--- effort [N m or N] and gains of a motor in the units of the file
local function dof_line(dof)
  local unit_of_force = dof.slides and 1e6 or 1e9
  local line = ("%s %.3g %.3g %.3g %.3g %g"):format(dof.kind or "r", dof.speed, dof.effort * unit_of_force,
                                                    dof.kp * unit_of_force, dof.kd * unit_of_force, dof.handle or 20)
  return dof.breakaway and line .. " " .. number(dof.breakaway) or line
end

--- @param r {about: string, class?: string, palm: string, dofs: table[], chains: table[], approach: table,
---   eigengrasps?: string, virtual_contacts?: string}
---   dofs: {kind?, speed, effort, kp, kd, handle?, breakaway?, slides?} in N, N m; speed in rad/s or mm/s
---   chains: {about, base = transform lines, joints = lists as in the file, links = {{kind, file, last joint}, ...}}
function robot.text(r)
  local out = {"# " .. r.about .. "; made by scripts/make_models.lua, README.md names the sources [mm, degrees]",
               "# Class", r.class or "Hand", "", "# Palm", r.palm, "", "# DOFs", tostring(#r.dofs),
               "# kind, velocity of closing, maximal effort, Kp, Kd, dragger scale, breakaway torque [N m]"}
  local function add(line) out[#out + 1] = line end
  for _, dof in ipairs(r.dofs) do add(dof_line(dof)) end
  add "\n# Chains"
  add(tostring(#r.chains))
  for _, chain in ipairs(r.chains) do
    add("\n# " .. chain.about .. ": joints, links")
    add(tostring(#chain.joints))
    add(tostring(#chain.links))
    for _, line in ipairs(chain.base) do add(line) end
    add(chain.joints.slide and "# theta, d, a, alpha, min, max [mm]" or
        "# theta, d, a, alpha, min, max, friction, spring, rest")
    for _, joint in ipairs(chain.joints) do add(words(joint)) end
    for _, link in ipairs(chain.links) do
      add(link[1])
      add(link[2] .. " " .. link[3])
    end
  end
  if r.approach then
    add "\n# Where and along which direction the palm comes near an object"
    add "Approach"
    add(words(r.approach[1]))
    add(words(r.approach[2]))
  end
  if r.eigengrasps then add("\nEigenGrasps\n" .. r.eigengrasps) end
  if r.virtual_contacts then add("\nVirtualContacts\n" .. r.virtual_contacts) end
  add ""
  return table.concat(out, "\n")
end

return robot
