--- Creates a class of the standard library. Its methods check that they are called with a colon, on an object of the class.
local classes = require "clench.classes"
local raise = require "clench.raise"
local described = require "clench.described"
local getmetatable, rawset, type = debug.getmetatable, rawset, type

---@param name string  "recording", for messages
---@return table # a metatable that is also its own __index
return function(name)
  local class = {__name = name}
  class.__index = class
  classes[name] = class
  return setmetatable(class, {__newindex = function(_, key, value)
    if type(value) == "function" then
      local method = value
      function value(self, ...)
        if getmetatable(self) ~= class then
          raise(("%s:%s: expected a %s before the colon, got %s; use %s:%s(...)"):format(name, key, name, described(self), name, key))
        end
        return method(self, ...)
      end
    end
    rawset(class, key, value)
  end})
end
