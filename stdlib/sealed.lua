-- stdlib/sealed.lua
--- A read-only view of a module for scripts: unknown names raise an error, and no name can be set.
---@param name string  "clench.csv"
---@param contents table  contents; has a metatable if names are loaded on first use
---@param list? function  iterator for pairs; the contents by default
---@return table
local raise = require "clench.raise"
local suggest = require "clench.suggest"

return function(name, contents, list)
  local seal = {__name = name, __index = contents}

  function seal.__pairs() return next, contents end
  if list then seal.__pairs = list end

  function seal:__newindex(key)
    local known = {}
    for other in pairs(self) do known[#known + 1] = other end
    table.sort(known)
    local found = type(key) == "string" and rawget(contents, key)
    for _, other in ipairs(known) do found = found or other == key end
    if found then
      local how = type(self[key]) == "function" and "it is a function; call it" or "it is read only"
      raise(("%s.%s cannot be set: %s"):format(name, key, how))
    end
    local near = type(key) == "string" and suggest(key, known) or ""
    raise(("%s has no '%s' to set%s; a script keeps its values in its own variables"):format(name, tostring(key), near))
  end

  if not getmetatable(contents) then
    setmetatable(contents, {__index = function(_, key)
      if type(key) ~= "string" then return nil end
      local known = {}
      for other in next, contents do known[#known + 1] = other end
      table.sort(known)
      raise(("%s has no '%s'%s"):format(name, key, suggest(key, known)))
    end})
  end
  return setmetatable({}, seal)
end
