--- Parses the doc of an entry, which describes it as data:
---
---     Closes the fingers until contact stops them.
---     @param options? table
---     @option speed? number [m/s, > 0] = 1  speed of the hand
---     @option limits.force? number [N, >= 0]  maximum force of a finger
---     @return table result  `moved`, `stops`
---     @effect edits
---     > hand:autograsp().moved  --> true
---
--- A line is `name? type [unit, range] = default`, then two spaces and prose. A range is any of `>= 0`, `> 0`, `<= 1`, `< 1` and `1 to 1000`; other text in the
--- brackets is the unit. An @option belongs to the preceding @param, a name with a dot to that option. Short options may be given in the type instead,
--- `{speed?: number}`, with `speed: prose` separated by semicolons. `@like clench.plan.anneal  seed, world` adds these options of another entry, or all of its
--- options if none is named, to the preceding @param. A field has `@type type [unit, range]`.
--- @effect is `reads` (changes nothing), `edits` (changes a world or another value, or acts on a device), `files` (may read or write files) or `long` (takes
--- long, and can run as a job); `long, files` is both. A type `index` is the number of an element, from 1.
local raise = require "clench.raise"
local signature = {}

local effects = {reads = true, edits = true, files = true, long = true}

-- the text before two blanks, and the prose after them
local function split(line)
  local head, prose = line:match "^(.-)%s%s+(.*)$"
  return head or line, prose or ""
end

local function add_bound(item, part)
  local low, high = part:match "^(%S+) to (%S+)$"
  if tonumber(low) and tonumber(high) then
    item.min, item.max = tonumber(low), tonumber(high)
    return true
  end
  local sign, mark, bound = part:match "^([<>])(=?)%s*(%S+)$"
  if not tonumber(bound) then return false end
  local side = sign == ">" and "min" or "max"
  item[side] = tonumber(bound)
  if mark == "" then item[side .. "_open"] = true end
  return true
end

-- "[s, > 0]": unit and range of an item
local function add_spec(item, spec)
  for part in spec:gmatch "[^,]+" do
    part = part:match "^%s*(.-)%s*$"
    if not add_bound(item, part) then
      if item.unit then raise(("signature: %s has two units, '%s' and '%s'"):format(item.name or "the type", item.unit, part)) end
      item.unit = part
    end
  end
end

-- type, unit, range and default of "number [s, > 0] = 2"
local function add_type(item, text)
  local head, default = text:match "^(.-)%s+=%s+(.+)$"
  if head then
    local chunk = load("return " .. default, "=default", "t", {})
    local ok, value = pcall(chunk or error)
    if not ok or value == nil then raise(("signature: the default of %s is not a value: %s"):format(item.name, default)) end
    item.default, text = value, head
  end
  local kind, spec = text:match "^(.-)%s+%[(.*)%]$"
  if spec then add_spec(item, spec) end
  item.type = kind or text
end

-- the last bracket of the prose is the unit of an item without one: "time limit [s]"
local function add_text(item, prose)
  item.text = prose
  if not item.unit and not prose:find ";" then item.unit = prose:match "%[([^%[%]=]+)%]$" end
end

-- "name? type [spec] = default", and its prose
local function item_of(head, prose)
  local name, rest = head:match "^(%S+)%s+(.*)$"
  name = name or head
  local item = {name = (name:gsub("%?$", "")), optional = name:find "%?$" ~= nil}
  add_type(item, rest or "any")
  add_text(item, prose)
  return item
end

--- Parts of a text between marks outside of brackets and quotes.
---@param text string
---@param mark string  one character
---@return string[]
function signature.parts_of(text, mark)
  local parts, depth, from, quoted = {}, 0, 1, false
  for at = 1, #text do
    local c = text:sub(at, at)
    if c == '"' then quoted = not quoted end
    if not quoted and c:find "[%[{(<]" then depth = depth + 1 end
    if not quoted and c:find "[%]})>]" then depth = depth - 1 end
    if c == mark and depth == 0 and not quoted then
      parts[#parts + 1] = text:sub(from, at - 1)
      from = at + 1
    end
  end
  parts[#parts + 1] = text:sub(from)
  return parts
end

-- "name: prose; other, third: prose" by name
local function texts_of(prose)
  local texts = {}
  for _, part in ipairs(signature.parts_of(prose, ";")) do
    local names, text = part:match "^%s*([%a_][%w_, ]-)%s*:%s*(.*)$"
    for name in (names or ""):gmatch "[%a_][%w_]*" do texts[name] = texts[name] or text end
  end
  return texts
end

-- the options in a type "{speed?: number, stages?: integer[]}"; nil if it names none
local function fields_of(kind, prose)
  local inner = kind:match "^{(.*)}$"
  if not inner then return nil end
  local fields, texts = {}, texts_of(prose)
  for _, part in ipairs(signature.parts_of(inner, ",")) do
    local name, mark, rest = part:match "^%s*([%a_][%w_]*)(%??)%s*:%s*(.-)%s*$"
    if name then
      local field = {name = name, optional = mark == "?", type = rest}
      add_text(field, texts[name] or "")
      field.fields = fields_of(rest, "")
      fields[#fields + 1] = field
    end
  end
  return fields
end

local function find(list, name)
  for _, item in ipairs(list or {}) do
    if item.name == name then return item end
  end
end

-- adds an @option to the preceding parameter, or to the option that its name begins with
local function add_option(parsed, head, prose)
  local item = item_of(head, prose)
  local owner = parsed.parameters[#parsed.parameters]
  if not owner then raise(("signature: the option %s follows no @param"):format(item.name)) end
  for outer in item.name:gmatch "([^.]+)%." do
    owner = find(owner.fields, outer)
    if not owner then raise(("signature: %s: there is no option %s before it"):format(item.name, outer)) end
  end
  item.name = item.name:match "[^.]+$"
  owner.fields = owner.fields or {}
  if find(owner.fields, item.name) then raise(("signature: the option %s is described twice"):format(item.name)) end
  table.insert(owner.fields, item)
end

local add = {}

function add.param(parsed, head, prose)
  local item = item_of(head, prose)
  item.fields = fields_of(item.type, prose)
  table.insert(parsed.parameters, item)
end

add.option = add_option

-- notes which options of another entry the last parameter also has; `descriptions` adds them
function add.like(parsed, head, prose)
  local owner = parsed.parameters[#parsed.parameters]
  if not owner then raise(("signature: @like %s follows no @param"):format(head)) end
  local names = {}
  for name in prose:gmatch "[^,%s]+" do names[#names + 1] = name end
  owner.fields, owner.like = owner.fields or {}, owner.like or {}
  table.insert(owner.like, {entry = head, names = names[1] and names, at = #owner.fields + 1})
end

function add.type(parsed, head, prose)
  parsed.type = {}
  add_type(parsed.type, head)
  add_text(parsed.type, prose)
end

add["return"] = function(parsed, head, prose)
  local kind, text = head:match "^(.-)%s+#%s+(.*)$" -- as LuaCATS separates prose
  local item = {type = kind or head}
  add_text(item, text and text .. (prose ~= "" and "  " .. prose or "") or prose)
  table.insert(parsed.returns, item)
end

function add.effect(parsed, head)
  local first, also = head:match "^(%l+),? ?(%l*)$"
  if not effects[first] or also ~= "" and also ~= "files" then
    raise(("signature: an effect is reads, edits, files or long, or one of these and files, got '%s'"):format(head))
  end
  parsed.effect, parsed.files = first, (first == "files" or also == "files") or nil
end

--- "long, files": the effect of an entry as its doc states it.
---@param parsed table  of signature.parse
---@return string
function signature.effect_text(parsed)
  return parsed.effect .. (parsed.files and parsed.effect ~= "files" and ", files" or "")
end

-- "> code" alone prepares an example; "> code  --> result" is one
local function add_example(parsed, line, prepared)
  local code, result = line:match "^> (.-)%s*%-%->%s?(.*)$"
  if not code then
    prepared[#prepared + 1] = line:sub(3)
    return prepared
  end
  table.insert(parsed.examples, {prepare = prepared, code = code, result = result})
  return {}
end

--- The parts of a doc: text, effect, type (of a field), parameters with their fields, returns, examples, and `unused`, the number of lines of code without a
--- following example.
---@param text string
---@return table
function signature.parse(text)
  local parsed = {parameters = {}, returns = {}, examples = {}}
  local sentences, prepared = {}, {}
  for line in (text .. "\n"):gmatch "(.-)\n" do
    local tag, rest = line:match "^@(%l+)%s+(.*)$"
    if line:sub(1, 2) == "> " then
      prepared = add_example(parsed, line, prepared)
    elseif tag then
      if not add[tag] then raise(("signature: unknown tag @%s"):format(tag)) end
      add[tag](parsed, split(rest))
    elseif line ~= "" then
      sentences[#sentences + 1] = line
    end
  end
  parsed.text = table.concat(sentences, " ")
  parsed.unused = #prepared
  return parsed
end

--- The LuaCATS type of a parameter whose options have separate lines: "{speed?: number}" for "table", "{speed?: number}[]" for "table[]".
---@param item table  of signature.parse
---@return string
function signature.type_of(item)
  local before, after = item.type:match "^(.-)%f[%a]table%f[%A](.*)$"
  if not item.fields or not before then return item.type end
  local parts = {}
  for i, field in ipairs(item.fields) do
    parts[i] = ("%s%s: %s"):format(field.name, field.optional and "?" or "", signature.type_of(field))
  end
  return ("%s{%s}%s"):format(before, table.concat(parts, ", "), after)
end

local function value_text(value)
  if type(value) == "string" then return ('"%s"'):format(value) end
  return type(value) == "table" and require "clench.show"(value) or tostring(value)
end

--- Unit, range and default of an item as text for readers: "[s, > 0] = 2"; "" if it has none.
---@param item table  of signature.parse
---@return string
function signature.limits(item)
  local parts, text = {}, ""
  if item.unit and not (item.text or ""):find("[" .. item.unit .. "]", 1, true) then parts[1] = item.unit end
  local closed = item.min and item.max and not item.min_open and not item.max_open
  if closed then parts[#parts + 1] = ("%s to %s"):format(item.min, item.max) end
  if item.min and not closed then parts[#parts + 1] = (item.min_open and "> " or ">= ") .. item.min end
  if item.max and not closed then parts[#parts + 1] = (item.max_open and "< " or "<= ") .. item.max end
  if #parts > 0 then text = "[" .. table.concat(parts, ", ") .. "]" end
  if item.default ~= nil then text = text .. (text ~= "" and " " or "") .. "= " .. value_text(item.default) end
  return text
end

return signature
