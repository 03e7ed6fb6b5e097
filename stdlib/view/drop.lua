--- Files that are dropped on the window: worlds are opened, robots and bodies imported.
local leave = require "clench.view.leave"

local commands = {robot = "world.import_robot", body = "world.import_object"}

local function take(view, path)
  local ok, kind = pcall(clench.file_kind, path)
  if not ok then return view:fail(kind) end
  if kind == "world" then
    leave.ask(view, "open", function() view:run("world.open", {path = path}) end)
  elseif commands[kind] then
    if not view.session.world then view:run "world.new" end
    view:run(commands[kind], {path = path, place = "free"})
  else
    view:fail(("%s: expected a world, a robot or a body, got %s"):format(path, kind))
  end
end

--- Handles the files that were dropped since the last frame.
return function(view)
  for _, path in ipairs(view.ui:take_dropped()) do take(view, path) end
end
