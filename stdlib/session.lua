--- A session: an open world, the current hand and object, a selection, commands with undo, and a log that is a script.
local arguments = require "clench.session.arguments"
local class = require "clench.class"
local described = require "clench.described"
local error_text = require "clench.error_text"
local gesture = require "clench.session.gesture"
local history = require "clench.session.history"
local is_stopped = require "clench.is_stopped"
local jobs = require "clench.session.jobs"
local raise = require "clench.raise"
local script = require "clench.session.script"
local suggest = require "clench.suggest"

local Session = class "session"

function Session:__tostring()
  return ("session of %d commands%s"):format(#self.history.done, self.world and ", " .. tostring(self.world) or ", no world is open")
end

local groups = {"world", "settings", "file", "edit", "select", "body", "mount", "grasp", "eigengrasps", "grasps", "author", "quality", "forces", "planner", "online", "dynamics", "virtual", "sensors", "misc"}
local events = {changed = true, diagnostic = true, progress = true, result = true}

local function command_named(self, name, subject)
  local command = self.commands[name]
  if command then return command end
  local names = {}
  for known in pairs(self.commands) do names[#names + 1] = known end
  table.sort(names)
  raise(("%s: there is no command %s%s"):format(subject, described(name), suggest(tostring(name), names)))
end

local function check_enabled(self, command)
  local can, reason = self:can_run(command.name)
  if can then return end
  raise(("session:run: %s: the command cannot run now%s"):format(command.name, reason and ": " .. reason or ""))
end

local max_depth = 20  -- nesting depth of commands that run commands

local function run_within(self, command, args)
  if self.depth >= max_depth then
    raise(("session:run: %s: commands that run commands are nested more than %d deep; does one run itself?"):format(command.name, max_depth))
  end
  self.depth = self.depth + 1
  local _ <close> = setmetatable({}, {__close = function() self.depth = self.depth - 1 end})
  return command.run(self, args)
end

-- Runs a command; its log messages become events if there are subscribers, and are printed otherwise.
local function run_heard(self, command, args)
  if #(self.subscribers.diagnostic or {}) == 0 then return run_within(self, command, args) end
  local ok, result
  local list = clench.log.collect(function() ok, result = pcall(run_within, self, command, args) end)
  for _, diagnostic in ipairs(list) do self:emit("diagnostic", diagnostic) end
  if not ok then error(result, 0) end
  return result
end

-- the name of another command with this shortcut
local function user_of(self, shortcut, name)
  for _, other in ipairs(self.order) do
    if shortcut and self.commands[other].shortcut == shortcut and other ~= name then return other end
  end
end

local function add_command(self, command)
  if not self.commands[command.name] then self.order[#self.order + 1] = command.name end
  self.commands[command.name] = command
  self.registrations = self.registrations + 1
end

--- Registers a command.
---@param command {name: string, run: function, label?: string, shortcut?: string, menu?: string, section?: number, enabled?: function, parameters?: table[], reads?: boolean, script?: function, replace?: boolean, long?: boolean}
--- name: "group.verb"; run(session, args); menu: "Grasp", or "Grasp/Posture" for a submenu; section: the viewer sorts the entries of a menu by it, with a line
--- between two sections, and those without one come last; enabled(session): can it run now? If not, it may return a reason as its second value; parameters: a list of {name =,
--- type =, unit =, min =, max =, default =, optional =, choices =, text =, hint =, files =}, where hint() returns the text of its empty field, and files = {kinds =, endings =, catalog =, writes =, ending =, first =} marks a path: a dialog lists the
--- files of these kinds (of clench.file_kind) or endings, and lists of clench.catalog; writes: the file is written, and a dialog asks before it replaces one; ending: appended to a name without one; first(path): the first file that is written, if it has another name; reads: it changes nothing, and is neither logged nor undone; script(session, args): lines of
--- Lua with the same effect, logged instead of the resulting state, or a function of the result that returns them; replace: it may replace a command of the same name; long: it may take seconds, so a server
--- runs it as a job (requires script or reads)
function Session:command(command)
  arguments.check_command(command)
  if self.commands[command.name] and not command.replace then
    raise(("session:command: there is a command '%s' already; replace = true replaces it"):format(command.name))
  end
  local user = user_of(self, command.shortcut, command.name)
  if user then raise(("session:command: %s: shortcut: '%s' belongs to %s"):format(command.name, command.shortcut, user)) end
  add_command(self, command)
end

--- Menus and their commands, in the order of registration.
---@return {name: string, commands: table[]}[]
function Session:menus()
  local menus, by_name = {}, {}
  for _, name in ipairs(self.order) do
    local command = self.commands[name]
    if command.menu then
      local menu = by_name[command.menu] or {name = command.menu, commands = {}}
      if not by_name[command.menu] then menus[#menus + 1], by_name[command.menu] = menu, menu end
      menu.commands[#menu.commands + 1] = command
    end
  end
  return menus
end

--- Calls a function at events: "changed" after each command, undo, redo and gesture that changes the session, and during playback; "result" with the result of
--- a command, and at the end of a job; "progress" of jobs, and readings of sensors, while `clench.loop` runs; "diagnostic" with each message that a command logs, which is then not
--- printed.
---@param event "changed"|"diagnostic"|"progress"|"result"
---@param f fun(value: table)
---@return fun() unsubscribe
function Session:subscribe(event, f)
  if not events[event] then raise(("session:subscribe: expected 'changed', 'diagnostic', 'progress' or 'result', got %s"):format(described(event))) end
  if type(f) ~= "function" then raise("session:subscribe: expected a function, got " .. described(f)) end
  local list = self.subscribers[event] or {}
  self.subscribers[event] = list
  list[#list + 1] = f
  return function()
    for i, other in ipairs(list) do
      if other == f then table.remove(list, i) break end
    end
  end
end

--- Calls the subscribers of an event.
function Session:emit(event, value)
  for _, f in ipairs {table.unpack(self.subscribers[event] or {})} do f(value) end
end

--- Can a command run now?
---@param name string
---@return boolean can
---@return string? reason  why not, or the error of the command's `enabled`
function Session:can_run(name)
  local command = command_named(self, name, "session:can_run")
  if not command.enabled then return true end
  local ok, can, reason = pcall(command.enabled, self)
  if not ok then
    if is_stopped(can) then error(can, 0) end
    return false, error_text(can)
  end
  if can then return true end
  return false, type(reason) == "string" and reason or nil
end

--- Runs a command. If it fails, the session is restored.
---@param name string
---@param args? table  arguments by name
---@return any result  result of the command
function Session:run(name, args)
  local command = command_named(self, name, "session:run")
  args = arguments.read(command, args)
  check_enabled(self, command)
  if command.reads then
    local result = run_heard(self, command, args)
    self:emit("result", {command = name, result = result})
    return result
  end
  -- a command that another command runs is part of it
  if self.is_running then return run_within(self, command, args) end
  self:end_gesture()
  local before = history.state_of(self)
  self.is_running = true
  local lines
  local ok, result = pcall(function()
    -- the lines are created before the command runs, as it may change names
    lines = command.script and command.script(self, args)
    local result = run_heard(self, command, args)
    if type(lines) == "function" then lines = lines(result) end
    lines = lines or script.of_change(self, before)
    return result
  end)
  self.is_running = false
  if not ok then
    history.set_state(self, before)
    error(result, 0)
  end
  history.add(self, {label = command.label or name, name = name, args = args, before = before, lines = lines})
  if name == "world.open" or name == "world.new" then self.saved_at = self.history.done[#self.history.done] end
  self:emit("changed", {command = name})
  self:emit("result", {command = name, result = result})
  return result
end

--- Undoes the last command.
---@return string? label  nil: nothing was undone
function Session:undo()
  if self.is_running then raise "session:undo: a command is running" end
  self:end_gesture()
  local label = history.undo(self)
  if label then self:emit("changed", {undo = label}) end
  return label
end

--- Repeats the last command that was undone.
---@return string? label  nil: nothing was repeated
function Session:redo()
  if self.is_running then raise "session:redo: a command is running" end
  self:end_gesture()
  local label = history.redo(self)
  if label then self:emit("changed", {redo = label}) end
  return label
end

--- Begins a gesture, a sequence of many small changes such as a drag: until `end_gesture` the script changes the world directly, and all changes form one step
--- of undo. Any command that changes the session ends the gesture first.
---@param label string  label of the undo step
---@param lines? fun(session: table, before: table): string  returns lines of Lua with the same effect; by default the resulting poses, DOFs, masses and materials are logged
---@param over? fun()  called when it ends or is cancelled
---@return table gesture  equal to `session.gesture` while it is open
function Session:begin_gesture(label, lines, over)
  if type(label) ~= "string" then raise("session:begin_gesture: label: expected a string, got " .. described(label)) end
  return gesture.begin(self, label, lines, over)
end

local function check_gesture(name, given)
  if given ~= nil and (type(given) ~= "table" or not given.before) then
    raise(("session:%s: expected the result of session:begin_gesture, got %s"):format(name, described(given)))
  end
end

--- Ends the open gesture, if there is one.
---@param given? table  of begin_gesture: nothing happens if another gesture is open
function Session:end_gesture(given)
  check_gesture("end_gesture", given)
  gesture.finish(self, given)
end

--- Ends the open gesture, if there is one, and reverts its changes.
---@param given? table  of begin_gesture: nothing happens if another gesture is open
function Session:cancel_gesture(given)
  check_gesture("cancel_gesture", given)
  gesture.cancel(self, given)
end

--- Adds a job to `session.jobs`; its progress and its end become events while `clench.loop` runs.
---@param job job
---@param name? string  name of a command, for the events
---@return job
function Session:add_job(job, name)
  if clench.type(job) ~= "job" then raise("session:add_job: expected a job, got " .. described(job)) end
  return jobs.add(self, job, name)
end

--- Grasps of a planner's job, best first: those of its result, or those found so far.
---@param job job  one of session.jobs
---@return grasp[]
function Session:grasps_of(job)
  if not self.found[job] then raise("session:grasps_of: expected one of session.jobs, got " .. described(job)) end
  return jobs.grasps(self, job)
end

--- Opens a world file, which replaces the open world.
---@param path string
---@param options? table  options of clench.load
function Session:open(path, options) return self:run("world.open", {path = path, options = options}) end

--- Saves the world.
---@param path? string  the file; by default the one that was opened or saved last
function Session:save(path) return self:run("world.save", {path = path}) end

--- Has the session changed since it was opened or saved? A selection is no change.
---@return boolean
function Session:is_modified()
  if self.gesture then return true end
  local done = self.history.done
  for i = #done, 1, -1 do
    if done[i] == self.saved_at then return false end
    if done[i].lines ~= "" then return true end
  end
  return self.saved_at ~= nil
end

--- The commands in the history that were not undone, as a script of plain calls that creates the same world.
---@return string
function Session:script() return script.of(self) end

--- The body, robot or link with an address: "flask", "dlr", "dlr/chain0_link2". A slash within a name is written as "\/".
---@param address string
function Session:find(address) return arguments.find(self, address) end

return function(world)
  if world ~= nil and clench.type(world) ~= "world" then raise("clench.session: expected a world, got " .. described(world)) end
  local session = setmetatable({depth = 0, commands = {}, order = {}, registrations = 0, subscribers = {}, selection = {}, stack = {}, postures = {}, jobs = {}, lists = {},
                                found = {}, sensors = {postures = {}, birds = {}},
                                history = history.new()}, Session)
  for _, group in ipairs(groups) do
    for _, command in ipairs(require("clench.session.commands." .. group)) do add_command(session, command) end
  end
  if world then history.take(session, world) end
  return session
end
