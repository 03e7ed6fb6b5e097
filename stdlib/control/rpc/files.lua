--- Files that JSON-RPC clients may name: none, unless the server has a folder; then those below it, after resolving links.
local arguments = require "clench.session.arguments"
local canonical = require "clench.canonical"
local described = require "clench.described"
local failure = require "clench.control.rpc.failure"
local files = {}

-- parameters that are paths, of commands whose other parameters are known to name no files
local known = {
  ["world.open"] = {path = true}, ["world.import_robot"] = {path = true}, ["world.import_object"] = {path = true}, ["world.import_obstacle"] = {path = true},
  ["world.save"] = {path = true}, ["world.save_as"] = {path = true}, ["world.save_image"] = {path = true}, ["file.check"] = {path = true}, ["file.convert"] = {from = true, to = true},
  ["grasp.load_virtual"] = {path = true}, ["grasp.save_virtual"] = {path = true},
}
-- these have no options for readers
local has_no_reader = {["world.save"] = true, ["world.save_as"] = true, ["world.save_image"] = true, ["grasp.load_virtual"] = true, ["grasp.save_virtual"] = true}

-- a parameter of such a name is treated as a path in any other command, which is refused
local suspicious = {path = true, paths = true, file = true, files = true, folder = true, root = true}

local function names_files(command)
  if known[command.name] or command.name:find "^file%." then return true end
  for _, parameter in ipairs(command.parameters or {}) do
    if parameter.files or suspicious[parameter.name] then return true end
  end
  return false
end

local function leads_out(folder, whole)
  local root = canonical(folder)
  return canonical(whole):sub(1, #root + 1) ~= root .. "/"
end

-- a folder of meshes may be written next to a file
local function is_outside(folder, whole) return leads_out(folder, whole) or leads_out(folder, whole:gsub("%.[^./]*$", "") .. "_files/x") end

-- a path below the folder, as written by the client: relative, and without ".."
local function path_below(folder, name, path)
  if type(path) ~= "string" or path == "" then failure.raise("params", "%s: expected the name of a file below the server's folder", name) end
  local names_another = path:sub(1, 1) == "/" or path:find "[%z\n]" ~= nil
  for part in path:gmatch "[^/]+" do names_another = names_another or part == ".." end
  local whole = folder .. "/" .. path
  if names_another or is_outside(folder, whole) then failure.raise("refused", "%s: %s does not lie below the server's folder", name, described(path)) end
  return whole
end

-- options of a reader: files that are named in the file must lie below the folder, too
local function confined_options(server, name, given)
  local options = {root = server.folder, confine = server.folder}
  for key, value in pairs(type(given) == "table" and given or {}) do
    if key == "root" or key == "confine" or key == "folder" or key == "package" then failure.raise("refused", "%s: options.%s is chosen by the server", name, key) end
    options[key] = value
  end
  return options
end

-- is the world saved without a path, to its own file, which is below the folder?
local function has_own_file(server, name, args)
  local path = server.session.path
  return name == "world.save" and args.path == nil and path ~= nil and not is_outside(server.folder, path)
end

-- a command of that name that a script has registered may name other files
local function check_parameters(command)
  for _, parameter in ipairs(command.parameters or {}) do
    if not known[command.name][parameter.name] and (parameter.files or suspicious[parameter.name]) then
      failure.raise("refused", "%s: clients cannot run this command, since it names files", command.name)
    end
  end
end

--- The arguments of a command, with paths that lie below the server's folder.
function files.confine(server, command, args)
  local name = command.name
  if name:find "^sensors%.connect_" then failure.raise("refused", "%s: devices are connected by the program of the server only", name) end
  if not names_files(command) then return args end
  if not server.folder then failure.raise("refused", "%s: this server reads and writes no files (it was started without a folder)", name) end
  if not known[name] then failure.raise("refused", "%s: clients cannot run this command, since it names files", name) end
  check_parameters(command)
  if has_own_file(server, name, args) then return args end
  local out = {}
  for key, value in pairs(args) do out[key] = value end
  for _, parameter in ipairs(command.parameters or {}) do
    local field = parameter.name
    if known[name][field] then out[field] = path_below(server.folder, field, arguments.with_ending(parameter, args[field])) end
  end
  if not has_no_reader[name] then out.options = confined_options(server, name, args.options) end
  return out
end

local planners = {primitive = true, sample = true, antipodal = true, random = true, anneal = true, loop = true, guided = true}

--- Checks that a planner is known, and that its options name no files.
function files.check_planner(planner, options)
  if not planners[planner] then failure.raise("params", "planner: expected primitive, sample, antipodal, random, anneal, loop or guided, got %s", described(planner)) end
  if options.root ~= nil or type(options.primitives) == "string" then failure.raise("refused", "options of a planner must not name files") end
end

return files
