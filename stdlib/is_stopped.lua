--- True of errors by which Ctrl-C, a deadline or the end of the host stops Lua. No metamethod of a user's table is called.
local type, rawget = type, rawget

---@param problem any  an error value
---@return boolean
return function(problem) return type(problem) == "table" and rawget(problem, "kind") == "stopped" end
