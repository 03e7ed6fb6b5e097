--- The error of a script's function that Clench called. An error with a message is returned unchanged; an error without one, and a yield, become a sentence
--- that names the caller. Runs as a message handler, so the script's line is that of the error.
local error_value = require "clench.error_value"
local script_line = require "clench.script_line"
local show = require "clench.show"
local getmetatable = debug.getmetatable
local type, pcall, tostring, rawget, setmetatable = type, pcall, tostring, rawget, setmetatable

local no_yield = "a function that does not yield, got a yield"
-- messages of Lua that name neither the function nor a line
local unplaced = {
  ["attempt to yield across a C-call boundary"] = no_yield,
  ["attempt to yield from outside a coroutine"] = no_yield,
  ["'__tostring' must return a string"] = "a string from __tostring, got another value",
}

local function shown(problem)
  local kind = type(problem)
  if kind == "table" then return "the table " .. show(problem, 100) end
  return (kind == "nil" or kind == "boolean") and tostring(problem) or "a " .. kind
end

-- "X, got Y" for an error without a message; nil for others
local function fault_of(problem)
  local kind = type(problem)
  if kind == "string" then return unplaced[problem] end
  if kind == "number" then return nil end
  local meta = getmetatable(problem)
  if type(meta) ~= "table" or rawget(meta, "__tostring") == nil then return "an error with a message, got " .. shown(problem) end
  return not pcall(tostring, problem) and ("an error with a message, got a %s whose __tostring fails"):format(kind) or nil
end

---@param problem any  error value that the function raised
---@param subject string  names the function, "recording:each"
---@param place? string  "a.lua:3: ", instead of the line where the error is handled
---@return any  `problem`, or an error value whose field `cause` is `problem`
return function(problem, subject, place)
  local fault = fault_of(problem)
  if not fault then return problem end
  return setmetatable({place = place or script_line(), sentence = ("%s: expected %s"):format(subject, fault), kind = "input", cause = problem}, error_value)
end
