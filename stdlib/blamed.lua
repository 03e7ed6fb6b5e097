--- What an error of ours says that blames the script's present call into the standard library. Nil of others: what a script's own function raised
--- knows its line, and faults of the library and Ctrl-C are kept as they are.
local error_value = require "clench.error_value"
local is_stopped = require "clench.is_stopped"
local script_line = require "clench.script_line"
local getmetatable = debug.getmetatable

---@param problem any
---@return string?
return function(problem)
  local ours = getmetatable(problem) == error_value and problem.kind ~= "internal" and not is_stopped(problem) and problem.place == script_line()
  return ours and problem.sentence or nil
end
