--- The console: an input line of Lua, and the output of it and of commands. `session`, `world`, `hand`, `object` and `view` are defined.
local function environment(view)
  local session = view.session
  return setmetatable({}, {__index = function(_, name)
    if name == "session" then return session end
    if name == "world" then return session.world end
    if name == "hand" then return session.hand end
    if name == "object" then return session.object end
    if name == "view" then return view end
    return view.globals[name] == nil and _G[name] or view.globals[name]
  end, __newindex = function(_, name, value) view.globals[name] = value end})
end

local function run(view, line)
  view:print("> " .. line, "input")
  local env = environment(view)
  local f, message = load("return " .. line, "=console", "t", env)
  if not f then f, message = load(line, "=console", "t", env) end
  if not f then return view:print(message, "error") end
  local results = table.pack(pcall(f))
  if not results[1] then return view:print(tostring(results[2]), "error") end
  local texts = {}
  for i = 2, results.n do texts[#texts + 1] = tostring(results[i]) end
  if #texts > 0 then view:print(table.concat(texts, "  ")) end
  view:changed()
end

local colors = {error = {0.84, 0.37, 0}, input = {0.4, 0.45, 0.5}, lua = {0, 0.45, 0.7}}

local function draw(ui, view)
  ui:child("lines", {height = -ui.line_height}, function(ui)
    for i = math.max(1, #view.lines - 200), #view.lines do ui:text(view.lines[i].text, {wrap = true, color = colors[view.lines[i].kind]}) end
    if view.scroll_console then ui:scroll_to_end() view.scroll_console = false end
  end)
  ui:width(-1)
  local text, _, entered = ui:text_input("##console", view.console_text, {hint = "Lua", on_enter = true, focus = view.continues_console})
  view.console_text, view.continues_console = text, false
  if entered and text ~= "" then
    view.console_text, view.continues_console = "", true
    run(view, text)
  end
end

return {name = "Console", place = "bottom", draw = draw}
