--- `clench serve`: a world that other programs command.
local error_text = require "clench.host.error_text"
local in_utf8 = require "clench.in_utf8"
local is_stopped = require "clench.is_stopped"
local printable = require "clench.printable"
local reading = require "clench.host.reading"
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

local function run(root, folder, package, unit, strict, ...)
  local said = {root = root, folder = folder, package = package, unit = unit, strict = strict ~= ""}
  local given = read_words(...)
  local world = clench.load(given.world, reading("world", said))
  local server <close> = clench.control.server {world = world, path = given.socket, host = given.host,
                                                port = not given.socket and tonumber(given.port or 4765) or nil}
  say("%s is served at %s", given.world, server.listener.name)
  clench.loop.run()
end

--- Serves until it is interrupted.
---@param root string  this and the next four: options of readers, "" if not given
---@return string  the exit code
function serve.main(...)
  local ok, problem = pcall(run, ...)
  if ok then return "0" end
  if is_stopped(problem) then error(problem, 0) end
  io.stderr:write("clench serve: ", printable(in_utf8(error_text(problem)), "\n"), "\n")
  return "1"
end

return serve
