--- True of errors by which Ctrl-C or the end of the host ("stopped") or a deadline ("timeout") stops Lua. No metamethod of a user's table
--- is called.
local type, rawget = type, rawget

---@param problem any  an error value
---@return boolean
return function(problem)
  local kind = type(problem) == "table" and rawget(problem, "kind")
  return kind == "stopped" or kind == "timeout"
end
