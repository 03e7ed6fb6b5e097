--- The event loop, which runs while the console's prompt waits for a key.
local loop = require "clench.loop"
local prompt = {}

--- The descriptor of the loop, readable if a task is ready to run.
function prompt.descriptor() return loop.descriptor() end

--- Runs the tasks that are ready.
function prompt.run() loop.run(0) end

return prompt
