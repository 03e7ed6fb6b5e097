--- The command palette: all commands by a few letters of their names.
local bindings = require "clench.view.bindings"
local dialog = require "clench.view.dialog"
local palette = {}

local max_shown = 12  -- maximum number of listed commands
local up, down = 265, 264  -- codes of keys

-- do the letters of `text` occur in `label` in order? Returns a rank, lower for better matches
local function rank(label, text)
  local lower, at, gaps = label:lower(), 0, 0
  local start = lower:find(text, 1, true)
  if start then return start end
  for letter in text:gmatch "%S" do
    local found = lower:find(letter, at + 1, true)
    if not found then return nil end
    gaps, at = gaps + found - at, found
  end
  return 100 + gaps
end

local function matches(view, text)
  local list = {}
  for _, name in ipairs(view.session.order) do
    local command = view.session.commands[name]
    local label = (command.label or name):gsub("…", "")
    local value = rank(label, text:lower()) or rank(name, text:lower())
    if value then list[#list + 1] = {command = command, label = label, rank = value} end
  end
  table.sort(list, function(a, b)
    if a.rank ~= b.rank then return a.rank < b.rank end
    return a.label < b.label
  end)
  return list
end

--- Draws the palette while it is open.
function palette.draw(view, ui)
  local state = view.palette
  if not state then return end
  local width = math.min(460 * view.scale, ui.size[1])
  -- a window that cannot be moved would be behind the panels
  local place = {x = (ui.size[1] - width) / 2, y = 60 * view.scale, width = width, height = 330 * view.scale, title = false, scroll = false, movable = true}
  ui:window("Command Palette", place, function(ui)
    ui:width(-1)
    local text, changed, entered = ui:text_input("##palette", state.text, {hint = "Type a command", on_enter = true, focus = not state.shown})
    state.shown, state.text = true, text
    if changed then state.index = 1 end
    local list = matches(view, text)
    local shown = math.min(#list, max_shown)
    for _, press in ipairs(ui.pressed) do
      local by = press.key == up and -1 or press.key == down and 1 or 0
      state.index = math.max(1, math.min(shown, (state.index or 1) + by))
    end
    ui:child("matches", {}, function(ui)
      for i = 1, shown do
        local match = list[i]
        local shortcut = bindings.shown(view, match.command.name)
        if ui:selectable(match.label .. (shortcut ~= "" and "    " .. shortcut or "") .. "##" .. match.command.name, i == (state.index or 1)) then entered, state.index = true, i end
      end
    end)
    if entered then
      view.palette = nil
      local match = list[state.index or 1]
      if match then dialog.open(view, match.command) end
    end
  end)
end

return palette
