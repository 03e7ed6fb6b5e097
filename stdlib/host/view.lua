--- `clench view`: shows a file or an empty world in a window, or draws one frame of it as a picture.
local complete = require "clench.host.complete"
local error_text = require "clench.error_text"
local fail = require "clench.host.usage"
local in_utf8 = require "clench.in_utf8"
local is_stopped = require "clench.is_stopped"
local printable = require "clench.printable"
local reading = require "clench.reading"
local scene = require "clench.host.scene"
local view = {}

local imports = {robot = "world.import_robot", body = "world.import_object"}

local function read_size(text)
  if not text then return nil end
  local width, height = text:match "^(%d+)x(%d+)$"
  if not width then fail("--size: expected width and height in pixels, as in 1070x937, got '%s'", text) end
  local size = {tonumber(width), tonumber(height)}
  for _, n in ipairs(size) do
    if n < 16 or n > 8192 then fail("--size: expected 16 to 8192 pixels, got '%s'", text) end
  end
  return size
end

local function check_screenshot(path)
  if not path then return end
  if not path:lower():match "%.png$" then fail("--screenshot: expected a file .png, got '%s'", path) end
  clench.files.check_writable(path)
end

local function open_file(session, given, said)
  if not given.file then return session:run "world.new" end
  local kind = clench.file_kind(given.file)
  if kind == "world" then return session:open(given.file, reading("world", said)) end
  if not imports[kind] then fail("%s: expected a world, a robot or a body, got a file of kind '%s'", given.file, kind) end
  session:run "world.new"
  session:run(imports[kind], {path = given.file, options = reading(kind, said)})
end

local function run_script(path, session, shown)
  local env = setmetatable({session = session, view = shown}, {__index = _G})
  local f, problem = loadfile(path, "t", env)
  if not f then error("--script: " .. problem, 0) end
  f()
end

local function save_screenshot(shown, path)
  for _ = 1, 2 do shown:frame() end
  local picture = shown:screenshot {path = path}
  print(printable(in_utf8(("%s: %d x %d pixels"):format(path, picture.width, picture.height))))
end

local function run(root, folder, package, unit, strict, ...)
  local said = {root = root, folder = folder, package = package, unit = unit, strict = strict ~= ""}
  local given = scene.read_words({}, ...)
  local size = read_size(given.size)
  check_screenshot(given.screenshot)
  local session = clench.session()
  require "clench.host.help".install()
  open_file(session, given, said)
  local options = {session = session, size = size}
  local shown = given.screenshot and clench.view.offscreen(options) or clench.view.open(session, {size = size})
  shown.complete = complete.words
  local ok, problem = pcall(function()
    if given.script then run_script(given.script, session, shown) end
    if given.screenshot then save_screenshot(shown, given.screenshot) else shown:wait() end
  end)
  if not ok then
    shown:flush()
    error(problem, 0)
  end
  shown:close()
end

--- Opens an empty world in a window next to the console, in which `session` and `view` are defined.
---@return string  the exit code
function view.beside()
  local opened = clench.session()
  opened:run "world.new"
  local ok, shown = pcall(clench.view.open, opened)
  if ok then
    _G.session, _G.view = opened, shown
    shown.complete = complete.words
    return "0"
  end
  io.stderr:write("clench repl: ", printable(in_utf8(error_text(shown)), "\n"), "\n")
  return "1"
end

--- Shows the file until its window is closed.
---@param root string  this and the next four: options of readers, "" if not given
---@return string  the exit code
function view.main(...)
  local ok, problem = pcall(run, ...)
  if ok then return "0" end
  if is_stopped(problem) then error(problem, 0) end
  local usage = type(problem) == "table" and problem.usage
  io.stderr:write("clench view: ", printable(in_utf8(usage or error_text(problem)), "\n"), "\n")
  return usage and "2" or "1"
end

return view
