--- A log sink that collects messages as values: {severity =, text =, file =, line =, about =, count =}. Equal messages are merged and counted.
---@return fun(level: string, text: string, about: string?) sink, table[] list
return function()
  local list, seen = {}, {}
  local function sink(level, text, about)
    local file, line, rest = text:match "^([^%s:][^:\n]*):(%d+): (.*)$"
    if not file then file, rest = text:match "^([^%s:][^:\n]*%.%w+): (.*)$" end
    local key = ("%s\n%s"):format(level, text)
    if seen[key] then
      seen[key].count = seen[key].count + 1
      return
    end
    seen[key] = {severity = level == "info" and "note" or level, text = rest or text, file = file, line = math.tointeger(tonumber(line)), about = about, count = 1}
    list[#list + 1] = seen[key]
  end
  return sink, list
end
