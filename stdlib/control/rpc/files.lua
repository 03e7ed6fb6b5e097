--- Files that JSON-RPC clients may name: none, unless the server has a folder; then those below it.
local failure = require "clench.control.rpc.failure"
local files = {}

local readers = {["world.open"] = true, ["world.import_robot"] = true, ["world.import_object"] = true, ["world.import_obstacle"] = true}
local writers = {["world.save"] = true}

-- a path below the folder, as the client wrote it: relative, and without ".."
local function path_below(folder, path)
  if type(path) ~= "string" or path == "" then failure.raise("params", "path: expected the name of a file below the server's folder") end
  local is_outside = path:sub(1, 1) == "/" or path:find "[%z\n]" ~= nil
  for part in path:gmatch "[^/]+" do is_outside = is_outside or part == ".." end
  if is_outside then failure.raise("refused", "path: '%s' does not lie below the server's folder", path) end
  return folder .. "/" .. path
end

--- The arguments of a command, with paths that lie below the server's folder.
function files.confine(server, name, args)
  if not readers[name] and not writers[name] then return args end
  if not server.folder then failure.raise("refused", "%s: this server reads and writes no files (it was started without a folder)", name) end
  local out = {}
  for key, value in pairs(args) do out[key] = value end
  out.path = path_below(server.folder, args.path)
  if writers[name] then return out end
  -- what the file names must lie there too
  out.options = {root = server.folder, confine = server.folder}
  for key, value in pairs(type(args.options) == "table" and args.options or {}) do
    if key == "root" or key == "confine" or key == "folder" or key == "package" then failure.raise("refused", "%s: options.%s is the server's", name, key) end
    out.options[key] = value
  end
  return out
end

return files
