--- True for errors by which a deadline stops Lua, false for those of Ctrl-C. Calls no metamethods of a user's table.
local type, rawget = type, rawget

---@param problem any  an error value
---@return boolean
return function(problem) return type(problem) == "table" and rawget(problem, "kind") == "timeout" end
