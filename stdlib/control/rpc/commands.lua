--- Commands of the session as methods of JSON-RPC. Long ones run as jobs on a clone; their changes are applied as one edit that can be undone,
--- if the world has not changed since.
local arguments = require "clench.session.arguments"
local failure = require "clench.control.rpc.failure"
local files = require "clench.control.rpc.files"
local jobs = require "clench.control.rpc.jobs"
local values = require "clench.control.rpc.values"
local commands = {}

local apply = "control.apply"

--- Is a command so long that it runs as a job?
function commands.is_long(command) return command.long == true and (command.script ~= nil or command.reads == true) end

--- Prepares the session of a server: registers the command by which results of jobs become edits, and counts edits in `server.edits`.
---@return fun() # ends the count
function commands.prepare(server)
  local session = server.session
  session:command {
    name = apply, label = "Apply a result", replace = true,
    parameters = {{name = "world", type = "any"}, {name = "lines", type = "string"}},
    run = function(of, args) of.world:become(args.world) end,
    script = function(_, args) return args.lines end,
  }
  server.edits = 0
  return session:subscribe("changed", function() server.edits = server.edits + 1 end)
end

--- The command of a method; nil if there is no such command.
function commands.find(session, name)
  if name:find "^control%." then return nil end
  return session.commands[name]
end

--- Names of all commands, sorted.
function commands.names(session)
  local names = {}
  for name in pairs(session.commands) do
    if not name:find "^control%." then names[#names + 1] = name end
  end
  table.sort(names)
  return names
end

-- runs in the job
local function work(world, name, args, current)
  local clench = require "clench"
  local session = clench.session(world)
  for field, address in pairs(current) do session[field] = session:find(address) end
  local result = session:run(name, args)
  return {world = session.world, result = clench.json.encode(require "clench.control.rpc.values".of(result))}
end

local function address_of(thing) return thing and values.address(thing) end

-- a job that runs a command on a clone
local function start(context, command, args)
  local session = context.session
  local current = {hand = address_of(session.hand), object = address_of(session.object)}
  local job = clench.job(work, {args = {session.world, command.name, args, current}, name = command.name})
  if context.on_job then context.on_job(job) end
  return job
end

-- registers a job and waits for it; finish(made) returns the result of the request
local function result_of(context, job, finish)
  local number = jobs.keep(context, job, function(kept)
    if kept.job.state == "done" then kept.result = finish(kept.job:result()) end
  end)
  local kept = context.server.jobs[number]
  clench.loop.wait(job)
  while kept.result == nil and kept.problem == nil and kept.job.state == "done" do clench.loop.sleep(0) end
  if kept.problem then error(kept.problem, 0) end
  if kept.result == nil then kept.job:result() end  -- raises the job's error
  return kept.result, number
end

local function run_long(context, command, args)
  local session = context.session
  local world = session.world or failure.raise("failed", "no world is open")
  if not session:can_run(command.name) then return session:run(command.name, args) end  -- raises the job's error
  if command.reads then
    return (result_of(context, start(context, command, args), function(made) return {result = clench.json.decode(made.result)} end)).result
  end
  local server = context.server
  local before, edits, lines = world:hash(), server.edits, command.script(session, args)
  local result, number = result_of(context, start(context, command, args), function(made)
    -- the hash covers the state; edits count other changes, such as those of masses
    local is_same = session.world == world and server.edits == edits and world:hash() == before
    if is_same then session:run(apply, {world = made.world, lines = lines}) end
    return {applied = is_same, result = clench.json.decode(made.result)}
  end)
  return {job = number, applied = result.applied, result = result.result}
end

--- Runs a command.
function commands.run(context, command, params)
  local session = context.session
  local ok, args = pcall(arguments.read, command, params)
  if not ok then error(setmetatable(failure.of(args, "params"), failure.class), 0) end
  local given = files.confine(context.server, command, args)
  local planner = command.name:match "^planner%.(.+)$"
  if planner then files.check_planner(planner, given) end
  if commands.is_long(command) then return run_long(context, command, given) end
  return session:run(command.name, given)
end

return commands
