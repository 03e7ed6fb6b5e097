--- Default primitives of an object for the primitive planner: those of a file primitives/<name>.iv in the folder of the object's file or below the root, else
--- those among the nodes of the object's file, else its bounding box.
local error_text = require "clench.error_text"
local is_stopped = require "clench.is_stopped"
local on_behalf_of = require "clench.on_behalf_of"
local quiet = require "clench.plan.quiet"
local script_line = require "clench.script_line"

-- folder of the objects below the root of GraspIt!
local shelf = "models/objects"

-- paths of possible files of primitives, in order of preference
local function places(source, root)
  local folder, file = source:match "^(.*/)([^/]*)$"
  if not folder then folder, file = "", source end
  local name = "primitives/" .. file:gsub("%.[^.]*$", "") .. ".iv"
  local list = {folder .. name}
  root = root or folder:match("^(.*)/" .. shelf .. "/")
  if root then
    local on_shelf = ("%s/%s/%s"):format(root, shelf, name)
    if on_shelf ~= list[1] then list[#list + 1] = on_shelf end
    list[#list + 1] = ("%s/%s"):format(root, name)
  end
  return list
end

-- Warns of a file that exists and cannot be used; the next source is tried. Ctrl-C is raised again.
local function skip(subject, problem)
  if is_stopped(problem) then error(problem, 0) end
  local sentence = type(problem) == "table" and rawget(problem, "sentence") or error_text(problem)
  if not sentence:find("no such file", 1, true) then
    clench.log.warning(script_line() .. ("%s: primitives: %s"):format(subject, sentence))
  end
end

-- the primitives of a file of primitives; nil if it does not exist or may not be read
local function of_file(subject, path)
  local ok, problem = pcall(clench.file_kind, path)
  if not ok then return skip(subject, problem) end
  return on_behalf_of(subject, clench.files.primitives, path)
end

local function may_hold_primitives(path)
  local ending = path:lower():match "%.[^./]*$"
  return ending == ".iv" or ending == ".wrl" or ending == ".vrml"
end

-- the primitives among the nodes of the object's own file, without warnings about its other nodes; nil: there are none
local function of_geometry(subject, path)
  local ok, list
  do
    local silence <close> = quiet()
    ok, list = pcall(clench.files.primitives, path)
  end
  if ok then return #list > 0 and list or nil end
  -- other formats contain no primitives: no warning
  if is_stopped(list) or may_hold_primitives(path) then skip(subject, list) end
end

local function bounding_box(object)
  local bounds = object.mesh.bounds
  return {{kind = "box", pose = clench.pose {xyz = (bounds.low + bounds.high) / 2}, size = bounds.high - bounds.low}}
end

---@param read table  options of the planner, for error messages
---@param object body
---@param root? string
---@return table[] primitives, string source  a path, or "bounding box"
return function(read, object, root)
  if not object.mesh then read:fail("object: '%s' has no surface; give its shape by the option primitives", object.name) end
  local source, report = object.source, object.mesh_report
  -- lengths in files apply only if the script does not scale the object
  if source ~= "" and not (report and report.unit_source == "option") then
    for _, path in ipairs(places(source, root)) do
      local list = of_file(read.subject, path)
      if list and #list > 0 then return list, path end
    end
    local list = of_geometry(read.subject, source)
    if list then return list, source end
  end
  return bounding_box(object), "bounding box"
end
