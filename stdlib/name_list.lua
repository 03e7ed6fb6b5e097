-- stdlib/name_list.lua
--- Names for a message: "a, b, c"; after 300 characters "and 40 more".
---@param names string[]
---@return string
return function(names)
  local text = ""
  for i, name in ipairs(names) do
    if i > 1 and #text + #name + 2 > 300 then return ("%s and %d more"):format(text, #names - i + 1) end
    text = i > 1 and text .. ", " .. name or name
  end
  return text
end
