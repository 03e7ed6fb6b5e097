--- Commands that compute the forces of the current grasp, the loads it holds, and the torques of its motors. They are queries.
local arguments = require "clench.session.arguments"

local hand = {name = "hand", type = "robot", optional = true, text = "address of a robot; the current hand by default"}
local load = {name = "load", type = "table", optional = true, text = "wrench on the object, {fx, fy, fz, tx, ty, tz} [N, N m]; its weight by default"}
local max_force = {name = "max_force", type = "number", min = 0, unit = "N", optional = true, text = "maximum normal force per contact"}
local torques = {name = "torques", type = "table", optional = true, text = "constant torques of the motors, one per DOF [N m or N]"}
local held_torques = {name = "torques", type = "any", optional = true, text = "constant torques of the motors, one per DOF [N m or N]; or springs: compliant DOFs hold by their springs alone"}
local torque_limits = {name = "torque_limits", type = "boolean", optional = true, text = "true: motor efforts are limited"}

local function weight_of(session)
  local m, g = session.object.mass, session.world.gravity
  return {m * g.x, m * g.y, m * g.z, 0, 0, 0}
end

-- a copy of the arguments, without the hand
local function options_of(args)
  local options = {}
  for name, value in pairs(args) do options[name] = value end
  options.hand = nil
  return options
end

-- a command that calls f(grasp, options, weight of the object)
local function reader(menu, name, label, parameters, f, long)
  local function run(session, args)
    return f(clench.grasp(arguments.find_robot(session, args.hand), session.object), options_of(args), weight_of(session))
  end
  local function enabled(session) return session.object ~= nil, "no object is current" end
  return {name = "grasp." .. name, label = label, menu = menu, section = 3, enabled = enabled, reads = true, long = long, parameters = {hand, table.unpack(parameters)}, run = run}
end

return {
  reader("Grasp", "forces", "Grasp Force Optimization…",
         {load, {name = "objective", type = "string", optional = true, suggested = {"min_sum", "min_norm", "min_max", "max_margin", "max_margin_sum"},
                 text = "what the forces minimize or maximize"}, max_force, torque_limits,
          {name = "total_force", type = "number", min = 0, unit = "N", optional = true, text = "prescribed sum of the normal forces"},
          {name = "total_torque", type = "number", min = 0, optional = true, text = "prescribed sum of the efforts of all motors, closing [N m or N]"},
          {name = "unilateral", type = "boolean", optional = true, text = "true: motors do not open"},
          {name = "balance", type = "string", choices = {"exact", "nearest"}, optional = true, text = "nearest: the least unbalanced wrench, if no forces balance the load"}},
         function(grasp, options, weight)
           options.load = options.load or weight
           return grasp:contact_forces(options)
         end),
  reader("Grasp", "stability", "Grasp Stability Analysis…", {load, max_force, held_torques}, function(grasp, options, weight)
    options.load = options.load or weight
    return grasp:equilibrium(options)
  end),
  reader("Grasp/More Analyses", "maximum_wrench", "Maximum Wrench…",
         {{name = "direction", type = "table", optional = true, text = "wrench on the object whose largest multiple is computed [N, N m]; its weight by default"},
          max_force, torque_limits, torques},
         function(grasp, options, weight)
           options.direction = options.direction or weight
           return grasp:max_load(options)
         end),
  reader("Grasp/More Analyses", "preload", "Optimal Preload…",
         {{name = "loads", type = "table", optional = true, text = "wrenches that the same torques hold, one at a time [N, N m]; none and the object's weight by default"},
          max_force, {name = "locked", type = "boolean", optional = true, text = "joints do not move under a load, and contacts yield as equal springs"}},
         function(grasp, options, weight)
           options.loads = options.loads or {{0, 0, 0, 0, 0, 0}, weight}
           return grasp:optimal_preload(options)
         end, true),
  reader("Grasp/More Analyses", "resistible_wrenches", "Resistible Wrenches…",
         {{name = "axes", type = "table", optional = true, text = "two of fx, fy, fz, tx, ty, tz"},
          {name = "count", type = "integer", min = 3, max = 3600, default = 72, text = "directions"}, max_force, torques},
         function(grasp, options) return clench.study.resistible_wrenches(grasp, options) end, true),
  reader("Grasp/More Analyses", "tendon_design", "Tendon Routes…",
         {{name = "pulls", type = "table", optional = true, text = "forces of spatial tendons by their names, 1 N by default [N]"},
          {name = "shifts", type = "table", optional = true, text = "points of the tendons that may be shifted, as in clench.study.tendon_design"}, load, max_force},
         function(grasp, options) return clench.study.tendon_design(grasp, options) end, true),
}
