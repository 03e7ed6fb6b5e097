--- Calls a function with what a script gave. An error that blames a line of the standard library blames the script's line instead, and
--- says for whom the function was called.
local raise = require "clench.raise"

---@param subject string  "plan.anneal"
---@param fn function
---@return any ... # what the function returns
return function(subject, fn, ...)
  local results = table.pack(pcall(fn, ...))
  if results[1] then return table.unpack(results, 2, results.n) end
  local problem = results[2]
  local text, places = tostring(problem):gsub("^stdlib/[^:]*:%d+: ", "")
  -- what the script raised itself knows its line, and mistakes of the library keep theirs
  if places == 0 or type(problem) ~= "table" or problem.kind == "internal" then error(problem, 0) end
  raise(subject .. ": " .. text, problem.kind)
end
