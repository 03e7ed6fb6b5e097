--- `clench describe`: the description of one entry of the API, or of all, as text or as JSON.
local error_text = require "clench.error_text"
local in_utf8 = require "clench.in_utf8"
local signature = require "clench.signature.grammar"
local describe = {}

local function joined(...)
  local parts = {}
  for _, part in ipairs {...} do
    if part ~= "" then parts[#parts + 1] = part end
  end
  return table.concat(parts, "  ")
end

local function print_items(items, margin)
  for _, item in ipairs(items) do
    local head = ("%s%s: %s"):format(item.name, item.optional and "?" or "", item.type)
    print(margin .. joined((head .. " " .. signature.limits(item)):gsub(" $", ""), item.text))
    print_items(item.fields or {}, margin .. "  ")
  end
end

local function print_one(entry)
  local names = {}
  for i, item in ipairs(entry.parameters) do names[i] = item.name end
  print(entry.kind == "field" and entry.name or ("%s(%s)"):format(entry.name, table.concat(names, ", ")))
  print("  " .. joined(entry.text, entry.type and "Type " .. entry.type or "", "Effect: " .. signature.effect_text(entry)))
  print_items(entry.parameters, "  ")
  for _, item in ipairs(entry.returns) do print("  " .. joined("returns " .. item.type, item.text)) end
  for _, example in ipairs(entry.examples) do
    for _, code in ipairs(example.prepare) do print("  > " .. code) end
    print(("  > %s  --> %s"):format(example.code, example.result))
  end
end

--- Prints the entry of that name, or all: as text, one line each.
---@param form "text"|"json"  after the options of readers, which are ignored
---@param name string  "" for all
---@return string  the exit code
function describe.main(_, _, _, _, _, form, name)
  local known, found = pcall(clench.describe, name ~= "" and name or nil)
  if not known then
    io.stderr:write("clench ", error_text(found), "\n")
    return "1"
  end
  if form == "json" then
    print(clench.json.encode(in_utf8(found)))
  elseif name ~= "" then
    print_one(found)
  else
    for _, entry in ipairs(found) do print(("%-36s %s"):format(entry.name, (entry.text:gsub("%. .*", ".")))) end
  end
  return "0"
end

return describe
