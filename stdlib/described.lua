-- stdlib/described.lua
--- A value as an error message shows it: texts in quotes and no longer than 40 characters, without any that move a cursor.
return function(value)
  if math.type(value) == "integer" then return tostring(value) end
  if type(value) == "number" then return ("%.10g"):format(value) end
  if type(value) == "string" then
    local text = value:gsub("%c", "?")
    return "'" .. (#text > 40 and text:sub(1, 37) .. "..." or text) .. "'"
  end
  if type(value) == "table" then return "a table of " .. rawlen(value) end
  return value == nil and "nothing" or type(value) == "boolean" and tostring(value) or "a " .. type(value)
end
