--- A log sink that collects messages as values: {severity =, file =, line =, subject =, text =, about =, count =}. Equal messages of one file are merged
--- and counted.
---@return fun(level: string, text: string, about: string?, diagnostic: table?) sink, table[] list
return function()
  local list, seen = {}, {}
  local function sink(level, text, about, diagnostic)
    local one = diagnostic or {severity = level == "info" and "note" or level, text = text, about = about, count = 1}
    local key = table.concat({one.severity, one.file or "", one.subject or "", one.text}, "\n")
    if seen[key] then
      seen[key].count = seen[key].count + one.count
      return
    end
    seen[key] = one
    list[#list + 1] = one
  end
  return sink, list
end
