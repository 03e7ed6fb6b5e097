--- Control loops of JSON-RPC clients: one request sets efforts or targets, makes a step, and returns the state. Steps cannot be undone: a client that
--- steps moves the world like a script, outside of the session's commands.
local arguments = require "clench.session.arguments"
local failure = require "clench.control.rpc.failure"
local queries = require "clench.control.rpc.queries"

-- maximum simulated time, and number of steps, of one request, during which no other client is served
local max_seconds, max_steps = 0.1, 1000

-- calls apply(robot, values) for each robot of {address: values}
local function each_robot(session, name, given, apply)
  for address, values in pairs(given or {}) do
    if type(address) ~= "string" then failure.raise("params", "%s: expected an object of numbers by robot, got a list", name) end
    if type(values) ~= "table" then failure.raise("params", "%s: expected numbers of %s", name, tostring(address)) end
    apply(arguments.find_robot(session, address), values)
  end
end

return {
  {name = "step", text = "Sets efforts or targets of motors, runs the world for a short time, and returns its state.",
   parameters = {{name = "efforts", type = "table", optional = true, text = "by robot: efforts of all DOFs, or some by name [N m or N]; the controller is \"none\" from then on"},
                 {name = "targets", type = "table", optional = true, text = "by robot: targets of all DOFs, or some by name [rad or m]"},
                 {name = "dt", type = "number", optional = true, min = 1e-6, max = max_seconds, unit = "s", text = "the world's time step by default"},
                 {name = "state", type = "boolean", default = true, text = "false: only the time is returned"}},
   run = function(context, args)
     local session = context.session
     local world = session.world or failure.raise("failed", "no world is open")
     local dt = args.dt or world.time_step
     if dt > max_steps * world.time_step then failure.raise("params", "dt: %g s are more than %d time steps of %g s", dt, max_steps, world.time_step) end
     each_robot(session, "efforts", args.efforts, function(robot, efforts)
       if robot.controller ~= "none" and robot.controller ~= "effort" then robot.controller = "none" end
       robot:set_forces(efforts)
     end)
     each_robot(session, "targets", args.targets, function(robot, targets) robot:set_targets(targets) end)
     world:run(dt)
     return args.state and queries.state(world) or {time = world.time}
   end},
}
