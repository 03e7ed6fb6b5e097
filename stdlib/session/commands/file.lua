--- Commands on files that belong to no world.
local report = require "clench.report"

local options = {name = "options", type = "table", optional = true, text = "options of the function that reads it"}

return {
  {name = "file.check", label = "Check File…", menu = "File", section = 6, reads = true, parameters = {{name = "path", type = "string", files = {}, text = "a file"}, options},
   run = function(_, args) return report.of(args.path, args.options) end},
  {name = "file.convert", label = "Convert File…", menu = "File", section = 6, reads = true,
   parameters = {{name = "from", type = "string", files = {kinds = {"body", "robot", "world", "eigengrasps", "virtual contacts"}}, text = "a file"}, {name = "to", type = "string", files = {writes = true}, text = "file to write; its ending selects the format"}, options},
   run = function(_, args) return clench.convert(args.from, args.to, args.options) end},
}
