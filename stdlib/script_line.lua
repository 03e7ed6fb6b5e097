--- Where the script called into the standard library: "a.lua:3: ", or "" where no script did.
---@return string
return function()
  local info, level = nil, 2
  repeat
    info, level = debug.getinfo(level, "Sl"), level + 1
  until not info or info.what ~= "C" and not info.source:find "^@stdlib/"
  return info and ("%s:%d: "):format(info.short_src, info.currentline) or ""
end
