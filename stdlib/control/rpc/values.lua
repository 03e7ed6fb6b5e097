--- Values in the form of JSON-RPC: bodies and robots as addresses, all others complete. Numbers that JSON cannot represent are null.
local in_utf8 = require "clench.in_utf8"
local values = {}

local max_depth = 30
local null = clench.json.null

local function escaped(name) return (name:gsub("/", "\\/")) end

--- The address of a body or robot: "mug", "dlr", "dlr/chain0_link2".
function values.address(thing)
  if clench.type(thing) == "robot" or not thing.robot then return escaped(thing.name) end
  local robot, name = thing.robot, thing.name
  local prefix = robot.name .. "_"
  if name:sub(1, #prefix) == prefix then name = name:sub(#prefix + 1) end
  return escaped(robot.name) .. "/" .. escaped(name)
end

local convert

-- is it a list of finite numbers, which need no conversion?
local function is_numbers(list)
  for i = 1, #list do
    local x = list[i]
    if type(x) ~= "number" or x - x ~= 0 then return false end
  end
  return #list > 0
end

local function list_or_record(value, depth)
  if is_numbers(value) then return value end
  local out = {}
  for key, item in pairs(value) do
    out[type(key) == "string" and in_utf8(key) or key] = convert(item, depth + 1)
  end
  return out
end

local contact_fields = {"body", "other", "link", "point", "normal", "gap", "force", "torsion", "mu", "mu_kinetic", "kind"}

local function contact(value, depth)
  local out = {}
  for _, field in ipairs(contact_fields) do
    local item = value[field]
    if item ~= nil then out[field] = convert(item, depth + 1) end
  end
  return out
end

function convert(value, depth)
  local plain = type(value)
  if plain == "number" then return value - value == 0 and value or null end
  if plain == "string" then return in_utf8(value) end
  if value == nil then return null end
  local kind = clench.type(value)
  if kind == "body" or kind == "robot" then return values.address(value) end
  if kind == "contact" then return contact(value, depth) end
  if kind == "boolean" or kind == "vec3" or kind == "pose" or kind == "grasp" or kind == "grasps" or value == null then return value end
  if kind == "table" and depth < max_depth then return list_or_record(value, depth) end
  return {type = kind, text = in_utf8(tostring(value))}
end

local Encoded = {}
local getmetatable = debug.getmetatable

--- A result that is JSON text already.
---@param text string
function values.encoded(text) return setmetatable({text = text}, Encoded) end

--- A value as plain data, for values.text.
function values.of(value) return getmetatable(value) == Encoded and value or convert(value, 0) end

--- Plain data as JSON text.
function values.text(plain) return getmetatable(plain) == Encoded and plain.text or clench.json.encode(plain) end

return values
