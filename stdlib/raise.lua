-- stdlib/raise.lua
--- Raises an error that begins with the file and line of the script that called into the standard library.
return function(text)
  local level = 2
  while true do
    local info = debug.getinfo(level, "S")
    if not info then error(text, 0) end
    if info.what ~= "C" and not info.source:find "^@stdlib/" then error(text, level) end
    level = level + 1
  end
end
