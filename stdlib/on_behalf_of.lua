--- Calls a function with arguments of a script. An error that blames the script for this call is prefixed by the subject.
local blamed = require "clench.blamed"
local raise = require "clench.raise"

---@param subject string  "plan.anneal"
---@param fn function
---@return any ... # results of the function
return function(subject, fn, ...)
  local results = table.pack(pcall(fn, ...))
  if results[1] then return table.unpack(results, 2, results.n) end
  local problem = results[2]
  local sentence = blamed(problem)
  if not sentence or sentence:find(subject, 1, true) == 1 then error(problem, 0) end
  raise(subject .. ": " .. sentence, problem.kind)
end
