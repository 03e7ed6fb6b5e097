--- The sentence of an error of Clench that refers to the script's present call into the standard library; nil for other errors: errors raised in the script's
--- functions have a line, and internal errors and Ctrl-C are passed on unchanged.
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
