--- True for errors that stop Lua: by Ctrl-C or the end of the host (kind "stopped"), or by a deadline (kind "timeout"). Calls no metamethods of a user's table.
local type, rawget = type, rawget

---@param problem any  an error value
---@return boolean
return function(problem)
  local kind = type(problem) == "table" and rawget(problem, "kind")
  return kind == "stopped" or kind == "timeout"
end
