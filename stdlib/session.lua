--- A session: an open world, the current hand and object, a selection, commands with undo, and a log that is a script.
local arguments = require "clench.session.arguments"
local class = require "clench.class"
local described = require "clench.described"
local history = require "clench.session.history"
local raise = require "clench.raise"
local script = require "clench.session.script"
local suggest = require "clench.suggest"

local Session = class "session"

function Session:__tostring()
  return ("session of %d commands%s"):format(#self.history.done, self.world and ", " .. tostring(self.world) or ", no world is open")
end

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
  self.commands[command.name] = command
end

--- Calls a function at events: "changed" after each command, undo and redo that changes the session; "result" with what a command returned.
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
    local result = run_within(self, command, args)
    self:emit("result", {command = name, result = result})
    return result
  end
  -- a command that another one runs is part of that one
  if self.is_running then return run_within(self, command, args) end
  local before = history.state_of(self)
  self.is_running = true
  local lines
  local ok, result = pcall(function()
    -- the lines are made before the command runs, as it may change names
    lines = command.script and command.script(self, args)
    local result = run_within(self, command, args)
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
  local label = history.undo(self)
  if label then self:emit("changed", {undo = label}) end
  return label
end

--- Repeats the command that was undone last.
---@return string? label  nil: there was none
function Session:redo()
  local label = history.redo(self)
  if label then self:emit("changed", {redo = label}) end
  return label
end

--- Opens a world file in place of the world that is open.
---@param path string
---@param options? table  of clench.load
function Session:open(path, options) return self:run("world.open", {path = path, options = options}) end

--- Saves the world.
---@param path? string  the file that was opened or saved last, unless given
function Session:save(path) return self:run("world.save", {path = path}) end

--- Has the session changed since it was opened or saved?
function Session:is_modified() return self.saved_at ~= self.history.done[#self.history.done] end

--- The commands done and not undone, as a script of plain calls that makes the same world.
---@return string
function Session:script() return script.of(self) end

--- The body, robot or link of an address: "flask", "dlr", "dlr/chain0_link2". A slash within a name is written as "\/".
---@param address string
function Session:find(address) return arguments.find(self, address) end

return function(world)
  if world ~= nil and clench.type(world) ~= "world" then raise("clench.session: expected a world, got " .. described(world)) end
  local session = setmetatable({depth = 0, commands = {}, subscribers = {}, selection = {}, stack = {}, history = history.new()}, Session)
  for _, group in ipairs {"world", "body", "grasp", "dynamics"} do
    for _, command in ipairs(require("clench.session.commands_" .. group)) do session:command(command) end
  end
  if world then history.take(session, world) end
  return session
end
