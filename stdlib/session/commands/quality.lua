--- Commands that evaluate the grasp of the current hand on the current object.
local arguments = require "clench.session.arguments"
local conditions = require "clench.session.conditions"

local hand = {name = "hand", type = "robot", optional = true, text = "address of a robot; the current hand by default"}
local load = {name = "load", type = "table", optional = true, text = "wrench on the object, {fx, fy, fz, tx, ty, tz} [N, N m]; its weight by default"}

local function has_object(session) return session.object ~= nil, "no object is current" end

local function grasp_of(session, args) return clench.grasp(arguments.find_robot(session, args.hand), session.object) end

-- options of a function of the grasp, with the weight of the object as the default load
local function options_of(session, args)
  local options = {}
  for name, value in pairs(args) do options[name] = value end
  options.hand = nil
  local g = session.world.gravity
  local m = session.object.mass
  options.load = options.load or {m * g.x, m * g.y, m * g.z, 0, 0, 0}
  return options
end

local function reader(name, label, parameters, run, long)
  return {name = "grasp." .. name, label = label, menu = "Grasp", enabled = has_object, reads = true, long = long, parameters = {hand, table.unpack(parameters)}, run = run}
end

return {
  reader("quality", "Quality…", {{name = "measure", type = "string", default = "epsilon", text = "name of a measure"}},
         function(session, args) return grasp_of(session, args):quality(args.measure) end),
  reader("measures", "Quality Measures…", {}, function(session, args) return grasp_of(session, args):quality_all() end, true),
  reader("contacts", "Contacts", {}, function(session, args) return session.world:contacts(arguments.find_robot(session, args.hand), session.object) end),
  reader("projection", "Create GWS Projection…",
         {{name = "fixed", type = "table", optional = true, text = "values of the coordinates that are fixed, three of fx, fy, fz, tx, ty and tz"},
          {name = "norm", type = "string", optional = true, text = "L1 or Linf"}},
         function(session, args) return grasp_of(session, args):wrench_space {norm = args.norm}:project {fixed = args.fixed or {tx = 0, ty = 0, tz = 0}} end),
  reader("forces", "Grasp Force Optimization…",
         {load, {name = "objective", type = "string", optional = true, text = "min_sum, min_norm, min_max or max_margin"},
          {name = "max_force", type = "number", min = 0, unit = "N", optional = true, text = "maximum normal force per contact"},
          {name = "torque_limits", type = "boolean", optional = true, text = "true: motor efforts are limited"}},
         function(session, args) return grasp_of(session, args):contact_forces(options_of(session, args)) end),
  reader("stability", "Grasp Stability Analysis…",
         {load, {name = "max_force", type = "number", min = 0, unit = "N", optional = true, text = "maximum normal force per contact"}},
         function(session, args) return grasp_of(session, args):equilibrium(options_of(session, args)) end),
}
