--- A session: an open world, the current hand and object, a selection, commands with undo, and a log that is a script.
local arguments = require "clench.session.arguments"
local class = require "clench.class"
local described = require "clench.described"
local gesture = require "clench.session.gesture"
local history = require "clench.session.history"
local jobs = require "clench.session.jobs"
local raise = require "clench.raise"
local script = require "clench.session.script"
local suggest = require "clench.suggest"

local Session = class "session"

function Session:__tostring()
  return ("session of %d commands%s"):format(#self.history.done, self.world and ", " .. tostring(self.world) or ", no world is open")
end

local groups = {"world", "settings", "file", "edit", "select", "body", "grasp", "quality", "planner", "dynamics", "virtual", "misc"}
local events = {changed = true, diagnostic = true, progress = true, result = true}

local function command_named(self, name)
  local command = self.commands[name]
  if command then return command end
  local names = {}
  for known in pairs(self.commands) do names[#names + 1] = known end
  table.sort(names)
  raise(("session:run: there is no command %s%s"):format(described(name), suggest(tostring(name), names)))
end

local function check_enabled(self, command)
  if not command.enabled then return end
  local can, reason = command.enabled(self)
  if can then return end
  raise(("session:run: %s: the command cannot run now%s"):format(command.name, type(reason) == "string" and ": " .. reason or ""))
end

local max_depth = 20  -- of commands that run commands

local function run_within(self, command, args)
  if self.depth >= max_depth then
    raise(("session:run: %s: commands that run commands are more than %d deep; does one run itself?"):format(command.name, max_depth))
  end
  self.depth = self.depth + 1
  local _ <close> = setmetatable({}, {__close = function() self.depth = self.depth - 1 end})
  return command.run(self, args)
end

-- Runs a command; what it logs becomes events if someone has subscribed to them, and is printed otherwise.
local function run_heard(self, command, args)
  if #(self.subscribers.diagnostic or {}) == 0 then return run_within(self, command, args) end
  local ok, result
  local list = clench.log.collect(function() ok, result = pcall(run_within, self, command, args) end)
  for _, diagnostic in ipairs(list) do self:emit("diagnostic", diagnostic) end
  if not ok then error(result, 0) end
  return result
end

-- the name of another command with the shortcut
local function user_of(self, shortcut, name)
  for _, other in ipairs(self.order) do
    if shortcut and self.commands[other].shortcut == shortcut and other ~= name then return other end
  end
end

local function add_command(self, command)
  if not self.commands[command.name] then self.order[#self.order + 1] = command.name end
  self.commands[command.name] = command
end

--- Registers a command.
---@param command {name: string, run: function, label?: string, shortcut?: string, menu?: string, enabled?: function, parameters?: table[], reads?: boolean, script?: function, replace?: boolean, long?: boolean}
---  name: "group.verb"; run(session, args); enabled(session): can it run now? If not, it may return a reason as its second value; parameters: a list of {name =, type =, unit =, min =, max =, default =,
---  optional =, text =}; reads: it changes nothing, and is neither logged nor undone; script(session, args): lines of Lua that do the same,
---  logged instead of the resulting state; replace: it may take the place of a command of the same name; long: it may take seconds, so a server runs it as a job (it needs script)
function Session:command(command)
  arguments.check_command(command)
  if self.commands[command.name] and not command.replace then
    raise(("session:command: there is a command '%s' already; replace = true puts another in its place"):format(command.name))
  end
  local user = user_of(self, command.shortcut, command.name)
  if user then raise(("session:command: %s: shortcut: '%s' is that of %s"):format(command.name, command.shortcut, user)) end
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

--- Calls a function at events: "changed" after each command, undo, redo and gesture that changes the session, and while dynamics play;
--- "result" with what a command returned, and at the end of a job; "progress" of jobs, while `clench.loop` runs; "diagnostic" with each message
--- that a command logs, which is then not printed.
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

--- Runs a command. If it fails, the session is as it was before.
---@param name string
---@param args? table  by name
---@return any result  of the command
function Session:run(name, args)
  local command = command_named(self, name)
  args = arguments.read(command, args)
  check_enabled(self, command)
  if command.reads then
    local result = run_heard(self, command, args)
    self:emit("result", {command = name, result = result})
    return result
  end
  -- a command that another one runs is part of that one
  if self.is_running then return run_within(self, command, args) end
  self:end_gesture()
  local before = history.state_of(self)
  self.is_running = true
  local lines
  local ok, result = pcall(function()
    -- the lines are made before the command runs, as it may change names
    lines = command.script and command.script(self, args)
    local result = run_heard(self, command, args)
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
---@return string? label  nil: there was none
function Session:undo()
  if self.is_running then raise "session:undo: a command is running" end
  self:end_gesture()
  local label = history.undo(self)
  if label then self:emit("changed", {undo = label}) end
  return label
end

--- Repeats the command that was undone last.
---@return string? label  nil: there was none
function Session:redo()
  if self.is_running then raise "session:redo: a command is running" end
  self:end_gesture()
  local label = history.redo(self)
  if label then self:emit("changed", {redo = label}) end
  return label
end

--- Begins a change of many small parts, such as a drag: until `end_gesture` the script changes the world itself, and all of it is one step of
--- undo. Any command that changes the session ends it first.
---@param label string  of the step of undo
---@param lines? fun(): string  lines of Lua that do the same; by default the resulting poses, DOFs, masses and materials are logged
---@param over? fun()  called when it ends or is cancelled
function Session:begin_gesture(label, lines, over)
  if type(label) ~= "string" then raise("session:begin_gesture: label: expected a string, got " .. described(label)) end
  gesture.begin(self, label, lines, over)
end

--- Ends the gesture, if one is open.
function Session:end_gesture() gesture.finish(self) end

--- Ends the gesture, if one is open, and takes back its changes.
function Session:cancel_gesture() gesture.cancel(self) end

--- Adds a job to `session.jobs`; its progress and its end become events while `clench.loop` runs.
---@param job job
---@param name? string  of a command, for the events
---@return job
function Session:add_job(job, name)
  if clench.type(job) ~= "job" then raise("session:add_job: expected a job, got " .. described(job)) end
  return jobs.add(self, job, name)
end

--- Grasps of a planner's job: those of its result, the best first, or those that were found until now.
---@param job job  one of session.jobs
---@return grasp[]
function Session:grasps_of(job)
  if not self.found[job] then raise("session:grasps_of: expected one of session.jobs, got " .. described(job)) end
  return jobs.grasps(self, job)
end

--- Opens a world file in place of the world that is open.
---@param path string
---@param options? table  of clench.load
function Session:open(path, options) return self:run("world.open", {path = path, options = options}) end

--- Saves the world.
---@param path? string  the file that was opened or saved last, unless given
function Session:save(path) return self:run("world.save", {path = path}) end

--- Has the session changed since it was opened or saved?
function Session:is_modified() return self.gesture ~= nil or self.saved_at ~= self.history.done[#self.history.done] end

--- The commands done and not undone, as a script of plain calls that makes the same world.
---@return string
function Session:script() return script.of(self) end

--- The body, robot or link of an address: "flask", "dlr", "dlr/chain0_link2". A slash within a name is written as "\/".
---@param address string
function Session:find(address) return arguments.find(self, address) end

return function(world)
  if world ~= nil and clench.type(world) ~= "world" then raise("clench.session: expected a world, got " .. described(world)) end
  local session = setmetatable({depth = 0, commands = {}, order = {}, subscribers = {}, selection = {}, stack = {}, postures = {}, jobs = {}, found = {},
                                history = history.new()}, Session)
  for _, group in ipairs(groups) do
    for _, command in ipairs(require("clench.session.commands." .. group)) do add_command(session, command) end
  end
  if world then history.take(session, world) end
  return session
end
