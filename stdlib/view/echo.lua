--- Shows commands in the console: Lua with the same effect, and results in a few readable lines.
local placing = require "clench.session.placing"
local script = require "clench.session.script"
local status = require "clench.view.status"
local echo = {}

local longest_line = 300  -- maximum length of a command's Lua [bytes]
local max_items = 8  -- maximum number of shown items of a list

local function name_of(value)
  local kind = clench.type(value)
  if kind == "body" or kind == "robot" then return value.name end
  if kind == "contact" then return ("%s on %s"):format(value.link and value.link.name or value.other.name, value.body.name) end
end

local function is_list(value) return #value > 0 and next(value, #value) == nil end

local text_of

local function text_of_list(list, depth)
  local parts = {}
  for i = 1, math.min(#list, max_items) do parts[i] = text_of(list[i], depth + 1) end
  if #list > max_items then parts[#parts + 1] = ("… %d in all"):format(#list) end
  return table.concat(parts, ", ")
end

local function text_of_fields(value, depth)
  local names, parts = {}, {}
  for name in pairs(value) do names[#names + 1] = tostring(name) end
  table.sort(names)
  for i, name in ipairs(names) do parts[i] = ("%s: %s"):format(name:gsub("_", " "), text_of(value[name], depth + 1)) end
  return table.concat(parts, depth == 0 and "\n  " or "; ")
end

text_of = function(value, depth)
  if math.type(value) == "float" then return ("%.5g"):format(value) end
  local name = name_of(value)
  if name then return name end
  if clench.type(value) ~= "table" then return tostring(value) end
  if next(value) == nil then return "none" end
  local text = is_list(value) and text_of_list(value, depth) or text_of_fields(value, depth)
  return depth > 1 and "(" .. text .. ")" or text
end

--- A value as readable text: fields of a table on a line each, numbers with five digits, bodies by their names.
---@return string
function echo.text(value) return text_of(value, 0) end

local function print_lua(view, lines)
  for line in (lines .. "\n"):gmatch "(.-)\n" do
    if #line > longest_line then line = line:sub(1, utf8.offset(line, 0, longest_line) - 1) .. " …" end
    if line ~= "" then view:print(line, "lua") end
  end
end

--- Shows the change of the session that an event "changed" reports.
function echo.changed(view, event)
  if event.undo then return view:print("session:undo()  -- " .. event.undo, "lua") end
  if event.redo then return view:print("session:redo()  -- " .. event.redo, "lua") end
  local last = view.session.history.done[#view.session.history.done]
  if (event.command or type(event.gesture) == "string") and last then print_lua(view, last.lines) end
end

-- a command whose result is the file that it has written
local function is_saver(command) return (command.label or ""):find "^Save" ~= nil end

-- reports what a new body overlaps
local function warn_of_overlaps(view, added)
  local names = placing.overlapped(added)
  if #names > 0 then status.warn(view, ("'%s' overlaps '%s'"):format(added.name, table.concat(names, "', '"))) end
end

local function is_empty(result) return clench.type(result) == "table" and next(result) == nil end

--- Shows the result of a command, and for a command that only reads also the Lua that runs it.
function echo.result(view, command, result, args)
  if command.name:find "^edit%." then return end  -- undo and redo are events "changed"
  if command.reads and not command.name:find "^world%.select$" then
    local ok, text = pcall(script.literal, args or {})
    print_lua(view, ("session:run(%q%s)"):format(command.name, ok and text ~= "{}" and ", " .. text or ""))
  end
  if is_saver(command) and type(result) == "string" then status.note(view, "Saved " .. result) end
  if command.name == "file.convert" then status.note(view, "Wrote " .. tostring((args or {}).to)) end
  if command.name:find "^world%.import_" then warn_of_overlaps(view, result) end
  if result == nil or is_empty(result) or command.name:find "^planner%." then return end
  view:print("  " .. echo.text(result), "result")
end

return echo
