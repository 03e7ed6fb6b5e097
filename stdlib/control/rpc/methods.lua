--- Methods that clients can call, by name: those of the server, and the commands of its session.
local arguments = require "clench.session.arguments"
local commands = require "clench.control.rpc.commands"
local shown = require "clench.described"
local failure = require "clench.control.rpc.failure"
local jobs = require "clench.control.rpc.jobs"
local queries = require "clench.control.rpc.queries"
local stepping = require "clench.control.rpc.stepping"
local subscriptions = require "clench.control.rpc.subscriptions"
local suggest = require "clench.suggest"
local methods = {}

local own = {}  -- by name
local known_names = setmetatable({}, {__mode = "k"})  -- by session: the list, and the number of registrations when it was made

--- Adds methods of the server.
---@param list table[]
function methods.add(list)
  for _, method in ipairs(list) do own[method.name] = method end
end

local function find_names(session)
  local names = {}
  for name in pairs(own) do names[#names + 1] = name end
  for _, name in ipairs(commands.names(session)) do
    if not own[name] then names[#names + 1] = name end
  end
  table.sort(names)
  return names
end

--- Names of all methods, sorted; not to be changed. A method of the server hides a command of the same name.
function methods.names(session)
  local known = known_names[session]
  if not known or known.registrations ~= session.registrations then
    known = {names = find_names(session), registrations = session.registrations}
    known_names[session] = known
  end
  return known.names
end

--- Is a method so long that it runs as a job?
function methods.is_long(session, name)
  local command = not own[name] and commands.find(session, name)
  return command and commands.is_long(command) or false
end

--- The description of a method; nil if there is no such method.
---@return {name: string, text: string, parameters: table[], reads: boolean, long: boolean, command: boolean}?
function methods.describe(session, name)
  local entry = own[name] or commands.find(session, name)
  return entry and {name = name, text = entry.text or entry.label, parameters = entry.parameters or {}, reads = entry.reads == true,
                    long = methods.is_long(session, name), command = own[name] == nil}
end

-- a live page without control only reads
local function check_permitted(client, name, method)
  if client.only_reads and not (method and method.reads) then
    failure.raise("refused", "%s: this page shows the world only; it moves it if the server has control = true (clench serve --control)", name)
  end
end

--- The result of a request that is well-formed.
---@param suggests boolean  may an error show names of other methods?
function methods.call(context, name, params, suggests)
  local method = own[name]
  local command = not method and commands.find(context.session, name) or nil
  if not method and not command then failure.raise("method", "there is no method %s%s", shown(name), suggests and suggest(name, methods.names(context.session)) or "") end
  check_permitted(context.client, name, method)
  if method then
    local ok, args = pcall(arguments.read, method, params)
    if not ok then error(setmetatable(failure.of(args, "params"), failure.class), 0) end
    return method.run(context, args)
  end
  return commands.run(context, command, params)
end

methods.add {
  {name = "session.undo", text = "Undoes the last command; returns its label.", parameters = {}, run = function(context) return context.session:undo() end},
  {name = "session.redo", text = "Repeats the command that was undone last; returns its label.", parameters = {}, run = function(context) return context.session:redo() end},
}
methods.add(queries)
methods.add(jobs.methods)
methods.add(stepping)
methods.add(subscriptions.methods)
for _, query in ipairs(queries) do query.reads = true end

return methods
