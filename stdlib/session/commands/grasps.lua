--- Commands on lists of grasps: those that planners have found, and those of files.
local arguments = require "clench.session.arguments"
local conditions = require "clench.session.conditions"
local raise = require "clench.raise"

local endings = {".jsonl", ".csv", ".npz", ".yaml", ".json"}

-- the grasps of the arguments, as a list that can be saved
local function list_of(session, args)
  local list = clench.grasps()
  for _, grasp in ipairs(args.grasps or session:grasps_of(arguments.find_job(session, args.job))) do list:add(grasp) end
  if #list == 0 then raise "session: grasp.save_grasps: there are no grasps" end
  return list
end

return {
  {name = "grasp.load_grasps", label = "Load Grasps…", menu = "Grasp/Grasp Lists", section = 4, enabled = conditions.world, reads = true,
   parameters = {{name = "path", type = "string", files = {endings = endings}, text = "a list of grasps: .jsonl, .csv, .npz, .yaml (isaac_grasp) or .json"},
                 {name = "options", type = "table", optional = true, text = "options of clench.grasps"}},
   run = function(session, args)
     local grasps = clench.grasps(args.path, args.options)
     session.lists[#session.lists + 1] = {name = args.path, grasps = grasps}
     return grasps
   end},
  {name = "grasp.save_grasps", label = "Save Grasps…", menu = "Grasp/Grasp Lists", section = 4, enabled = conditions.world, reads = true,
   parameters = {{name = "path", type = "string", files = {endings = endings, writes = true}, text = "file to write; its ending selects the format"},
                 {name = "job", type = "integer", min = 1, optional = true, text = "number of a planner's job in session.jobs; the last one by default"},
                 {name = "grasps", type = "any", optional = true, text = "a list of grasps instead of those of a job"},
                 {name = "options", type = "table", optional = true, text = "options of list:save"}},
   run = function(session, args)
     list_of(session, args):save(args.path, args.options)
     return args.path
   end},
}
