--- True of errors by which a deadline stops Lua, false of those of Ctrl-C. No metamethod of a user's table is called.
local type, rawget = type, rawget

---@param problem any  an error value
---@return boolean
return function(problem) return type(problem) == "table" and rawget(problem, "kind") == "timeout" end
