--- The error of a function that Clench calls at a later time, with its traceback. Ctrl-C is returned unchanged.
local callback_error = require "clench.callback_error"
local error_text = require "clench.error_text"
local error_value = require "clench.error_value"
local is_stopped = require "clench.is_stopped"

---@param problem any  error value that the function raised
---@param name string  name of the function: "task of world:spawn"
---@param trace string  its traceback
---@param place? string  "a.lua:3: ", which replaces the line where the error is handled
---@return any
return function(problem, name, trace, place)
  if is_stopped(problem) then return problem end
  problem = callback_error(problem, name, place)
  local ours = getmetatable(problem) == error_value
  local place, said = ours and problem.place or "", ours and problem.sentence or error_text(problem)
  return setmetatable({place = place, sentence = ("%s\nin a %s\n%s"):format(said, name, trace), kind = ours and problem.kind or "input",
                       cause = ours and problem.cause or nil}, error_value)
end
