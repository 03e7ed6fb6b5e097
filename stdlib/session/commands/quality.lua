--- Commands that evaluate the grasp of the current hand on the current object.
local arguments = require "clench.session.arguments"

local hand = {name = "hand", type = "robot", optional = true, text = "address of a robot; the current hand by default"}

local function measure_names()
  local names = {}
  for i, measure in ipairs(clench.measures()) do names[i] = measure.name end
  return names
end

local measure = {name = "measure", type = "string", default = "epsilon", suggested = measure_names, text = "name of a measure"}

local function has_object(session) return session.object ~= nil, "no object is current" end

local function grasp_of(session, args) return clench.grasp(arguments.find_robot(session, args.hand), session.object) end

local function reader(menu, name, label, parameters, run, long)
  return {name = "grasp." .. name, label = label, menu = menu, section = 3, enabled = has_object, reads = true, long = long, parameters = {hand, table.unpack(parameters)}, run = run}
end

return {
  reader("Grasp/More Analyses", "quality", "Quality…", {measure},
         function(session, args) return grasp_of(session, args):quality(args.measure) end),
  reader("Grasp", "measures", "Quality Measures…", {}, function(session, args) return grasp_of(session, args):quality_all() end, true),
  reader("Grasp/More Analyses", "contacts", "Contacts", {}, function(session, args) return session.world:contacts(arguments.find_robot(session, args.hand), session.object) end),
  reader("Grasp", "projection", "Create GWS Projection…",
         {{name = "fixed", type = "table", optional = true, text = "values of the coordinates that are fixed, three of fx, fy, fz, tx, ty and tz"},
          {name = "norm", type = "string", suggested = {"L1", "Linf"}, optional = true, text = "L1: the normal forces of all contacts sum to 1; Linf: each is at most 1"}},
         function(session, args) return grasp_of(session, args):wrench_space {norm = args.norm}:project {fixed = args.fixed or {tx = 0, ty = 0, tz = 0}} end),
}
