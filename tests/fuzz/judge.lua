-- Finds faults of a message or of a returned value.
local judge = {}

-- words of a library, of the compiler or of Lua itself, in a place for a message to the user
local forbidden = {"std::", "bad_alloc", "vector::", "basic_string", "unprotected", "stack traceback", "terminate",
                   "not enough memory", "Assertion"}

-- longest sentence [characters]: those of the engine end after 1000, and a place precedes them
local longest = 1200

--- Reason for which a text is not a readable message; nil if it is one.
function judge.text(text)
  for _, word in ipairs(forbidden) do
    if text:find(word, 1, true) then return text end
  end
  if text:find "%c" then return "a control character: " .. text:gsub("%c", "?") end
  if #text > longest then return ("a text of %d characters: %s"):format(#text, text) end
end

--- Reason for which an error's message is not a sentence with a subject; nil if it is one.
function judge.message(message)
  if type(message) ~= "string" then
    -- a script's own error object
    return type(message) ~= "table" and "an error that is a " .. type(message) or nil
  end
  -- Lua reports errors of the statement itself, such as calling a table; but not those of the standard library's own code
  if message:find "attempt to" or message:find "bad argument" then return message:find "^fuzz:" == nil and message or nil end
  return judge.text(message)
    or not message:find ": " and message ~= "mine" and message ~= "never asked" and message or nil
end

-- infinite if there is no limit, or nothing to measure, as documented
local endless = {
  ["patch.radii"] = true, ["patch.relative_radii"] = true, ["robot.dof_limits"] = true, ["eigengrasps.limits"] = true,
  ["eigengrasps.range"] = true, ["robot.effort_ranges"] = true,
  ["measures:quality"] = true, ["world_queries:distance"] = true, ["world_queries:penetration"] = true,
}

local function is_odd(value, may_be_infinite)
  return value ~= value or not may_be_infinite and (value == math.huge or value == -math.huge)
end

local function has_odd(value, infinite, depth, seen)
  if type(value) == "number" then return is_odd(value, infinite) end
  if depth == 0 then return false end
  if type(value) == "userdata" and getmetatable(value) == "vec3" then
    return is_odd(value.x, infinite) or is_odd(value.y, infinite) or is_odd(value.z, infinite)
  end
  if type(value) ~= "table" or seen[value] then return false end
  seen[value] = true
  local looked = 0
  for _, item in pairs(value) do
    looked = looked + 1
    if looked > 50 then break end
    if has_odd(item, infinite, depth - 1, seen) then return true end
  end
  return false
end

--- The entry that returned a number that is not finite; nil if all are finite.
function judge.value(value, name) return has_odd(value, endless[name], 4, {}) and name or nil end

--- Signature of a finding, equal for findings with the same cause.
function judge.signature(what, text)
  local short = text:gsub("^fuzz:%d+: ", ""):gsub("'.-'", "'...'"):gsub("<.->", "<...>"):gsub("%-?%d[%w.+-]*", "N"):gsub("[\r\n].*", ""):sub(1, 160)
  return what .. ": " .. short
end

return judge
