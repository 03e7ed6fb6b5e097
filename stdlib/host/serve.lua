--- `clench serve` and `clench mcp`: a world that other programs control.
local error_text = require "clench.error_text"
local in_utf8 = require "clench.in_utf8"
local is_stopped = require "clench.is_stopped"
local printable = require "clench.printable"
local raise = require "clench.raise"
local reading = require "clench.reading"
local save_secret = require "clench.save_secret"
local serve = {}

local function say(format, ...)
  print(printable(in_utf8(format:format(...))))
  io.stdout:flush()
end

-- the options of the command line by their names
local function read_words(...)
  local given = {}
  for i = 1, select("#", ...), 2 do
    local name, value = select(i, ...)
    given[name] = value
  end
  return given
end

-- default file for the token of a server
local function default_file(server)
  local name = server.port > 0 and tostring(server.port) or "socket"
  local session = os.getenv "XDG_RUNTIME_DIR"
  if session and session ~= "" then return ("%s/clench-%s.token"):format(session, name) end
  local home = os.getenv "HOME"
  return home and home ~= "" and ("%s/.clench-%s.token"):format(home, name) or nil
end

-- stores the token in a file of the user, which is removed when the server ends
local function keep_token(server, path)
  path = path or default_file(server)
  if not path then return nil end
  save_secret(path, server.token .. "\n")
  return setmetatable({path = path}, {__close = function() os.remove(path) end})
end

local function announce(given, server, kept)
  say("%s is served at %s", given.world, server.listener.name)
  if server.url then say("live page: %s", server.url) end
  if not server.token then return say "without a token: any program on this machine can control it" end
  say("JSON-RPC: %s/?token=%s", given.socket and "unix://" .. given.socket or "tcp://" .. server.listener.name, server.token)
  if kept then say("the token is stored in %s", kept.path) end
end

-- the port of the live page; options that mean nothing without it are refused
local function http_of(given)
  if given.control and not given.http and given.verb == "serve" then raise "--control: expected --http, too: it lets the live page move DOFs" end
  return given.http and tonumber(given.http)
end

local function run(root, folder, package, unit, strict, ...)
  local said = {root = root, folder = folder, package = package, unit = unit, strict = strict ~= ""}
  local given = read_words(...)
  local http = http_of(given)
  local world = clench.load(given.world, reading("world", said))
  local token
  if given["no-token"] then token = false end
  if given.stdio or given.verb == "mcp" then
    local mcp = given.verb == "mcp" and (given.control and "control" or "read") or nil
    local server <close> = clench.control.server {world = world, stdio = true, mcp = mcp, folder = given.folder, path = given.socket, host = given.host, http = http}
    return clench.loop.run()
  end
  local server <close> = clench.control.server {world = world, path = given.socket, host = given.host, token = token, folder = given.folder,
                                                http = http, control = given.control ~= nil,
                                                port = not given.socket and tonumber(given.port or 4765) or nil}
  local kept <close> = server.token and keep_token(server, given["token-file"]) or nil
  announce(given, server, kept)
  clench.loop.run()
end

--- Serves until it is interrupted.
---@param root string  this and the next four: options of readers, "" if not given
---@return string  the exit code
function serve.main(...)
  local ok, problem = pcall(run, ...)
  if ok then return "0" end
  if is_stopped(problem) then error(problem, 0) end
  io.stderr:write("clench ", read_words(select(6, ...)).verb, ": ", printable(in_utf8(error_text(problem)), "\n"), "\n")
  return "1"
end

return serve
