--- What runs while the console's prompt waits for a key: the event loop.
local loop = require "clench.loop"
local prompt = {}

--- The descriptor that is readable when there is something to run.
function prompt.descriptor() return loop.descriptor() end

--- Runs what is ready.
function prompt.run() loop.run(0) end

return prompt
