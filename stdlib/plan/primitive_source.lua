--- The primitives that an object is approached by where a script names none: those of a file primitives/<name>.iv beside the object's
--- file or below the root, else those among the nodes of its own file, else its bounding box.
local on_behalf_of = require "clench.on_behalf_of"
local quiet = require "clench.plan.quiet"

-- where GraspIt! keeps objects, below its root
local shelf = "models/objects"

-- paths where a file of primitives may lie, in order
local function places(source, root)
  local folder, file = source:match "^(.*/)([^/]*)$"
  if not folder then folder, file = "", source end
  local name = "primitives/" .. file:gsub("%.[^.]*$", "") .. ".iv"
  local list = {folder .. name}
  root = root or folder:match("^(.*)/" .. shelf .. "/")
  if root then
    list[#list + 1] = ("%s/%s/%s"):format(root, shelf, name)
    list[#list + 1] = ("%s/%s"):format(root, name)
  end
  return list
end

-- the primitives of a file of them; nil where there is no such file
local function of_file(subject, path)
  if not pcall(clench.file_kind, path) then return nil end
  return on_behalf_of(subject, clench.files.primitives, path)
end

-- the primitives among the nodes of the object's own file; a mesh has none, and warnings about its other nodes are of no interest
local function of_geometry(path)
  local silence <close> = quiet()
  local ok, list = pcall(clench.files.primitives, path)
  return ok and #list > 0 and list or nil
end

local function bounding_box(object)
  local bounds = object.mesh.bounds
  return {{kind = "box", pose = clench.pose {xyz = (bounds.low + bounds.high) / 2}, size = bounds.high - bounds.low}}
end

---@param read table  options of the planner, for its messages
---@param object body
---@param root? string
---@return table[] primitives, string source  a path, or "bounding box"
return function(read, object, root)
  if not object.mesh then read:fail("object: '%s' has no surface; the option primitives says what it is like", object.name) end
  local source, report = object.source, object.mesh_report
  -- sizes in files are those of the object only where the script does not scale it
  if source ~= "" and not (report and report.unit_source == "option") then
    for _, path in ipairs(places(source, root)) do
      local list = of_file(read.subject, path)
      if list and #list > 0 then return list, path end
    end
    local list = of_geometry(source)
    if list then return list, source end
  end
  return bounding_box(object), "bounding box"
end
