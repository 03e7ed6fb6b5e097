--- Errors of JSON-RPC 2.0: an error value {code, message, data}.
local blamed = require "clench.blamed"
local error_text = require "clench.error_text"
local error_value = require "clench.error_value"
local in_utf8 = require "clench.in_utf8"

local failure = {
  parse = -32700, request = -32600, method = -32601, params = -32602, internal = -32603,
  failed = -32000,        -- the request is valid, and failed: data.kind as in errors of scripts
  unauthorized = -32001,  -- no hello with the token yet
  refused = -32002,       -- not permitted by this server, or beyond a limit
}

local Failure = {}
failure.class = Failure

--- Raises an error with one of the codes above.
function failure.raise(kind, format, ...)
  local message = select("#", ...) > 0 and format:format(...) or format
  error(setmetatable({code = failure[kind], message = in_utf8(message)}, Failure), 0)
end

--- Converts a value raised by a function to the error of a response.
---@param problem any
---@param kind? string  code of all other errors; "failed" by default
function failure.of(problem, kind)
  if getmetatable(problem) == Failure then return {code = problem.code, message = problem.message, data = problem.data} end
  local ours = debug.getmetatable(problem) == error_value
  local is_internal = not ours or problem.kind == "internal"
  local message = blamed(problem) or ours and problem.sentence or error_text(problem)
  return {code = is_internal and failure.internal or failure[kind or "failed"], message = in_utf8(message),
          data = {kind = ours and problem.kind or "internal"}}
end

return failure
