-- stdlib/study/kind.lua: what a value is, for messages
local kind = {}

-- "clench.grasp" of a grasp, else Lua's own word
local function kind_of(value)
  local meta = debug.getmetatable(value)
  return type(value) == "userdata" and meta and meta.__name or type(value)
end

function kind.described(value)
  if type(value) == "number" then return ("%.10g"):format(value) end
  return value == nil and "nothing" or "a " .. kind_of(value):gsub("^clench%.", "")
end

return setmetatable(kind, {__call = function(_, value) return kind_of(value) end})
