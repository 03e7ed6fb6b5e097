-- stdlib/lazy.lua
--- A module whose members are loaded on first use.
---@param subject string  the module's name, in clench and for messages
---@param names string[]  in order
---@param home? table  file of each name that has no separate file
local name_list = require "clench.name_list"
local sealed = require "clench.sealed"
local raise = require "clench.raise"
local suggest = require "clench.suggest"

return function(subject, names, home)
  local known = {}
  for _, name in ipairs(names) do known[name] = true end

  local loaded = setmetatable({}, {__index = function(loaded, name)
    if not known[name] then
      raise(("%s: there is no '%s', only %s%s"):format(subject, tostring(name), name_list(names), suggest(name, names)))
    end
    local file = home and home[name]
    local unit = require("clench." .. subject .. "." .. (file or name))
    local value = file and unit[name] or unit
    rawset(loaded, name, value)
    return value
  end})

  --- Iterates over all names in order, loaded or not, for tables and consoles.
  local function list()
    local i = 0
    return function()
      i = i + 1
      if names[i] then return names[i], loaded[names[i]] end
    end
  end

  return sealed("clench." .. subject, loaded, list)
end
