--- Messages of JSON-RPC 2.0, one per line: every request is answered, including malformed ones.
local error_value = require "clench.error_value"
local failure = require "clench.control.rpc.failure"
local is_stopped = require "clench.is_stopped"
local json = clench.json
local turn = require "clench.control.turn"
local values = require "clench.control.rpc.values"
local messages = {}

local max_batch = 1000       -- requests
local max_values = 20000     -- of one request
local max_answers = 4 << 20  -- to the requests of a batch, after which the others are refused [bytes]
local null = json.null

--- Result of a request that is not answered, because its client has cancelled it.
messages.no_answer = {}

-- is it [...], and not {...}?
local function is_list(value)
  if type(value) ~= "table" then return false end
  if #value > 0 then return true end
  local meta = getmetatable(value)
  return next(value) == nil and not (meta and meta.__object)
end

local function is_id(id) return type(id) == "string" or type(id) == "number" end

local function check_form(message)
  if type(message) ~= "table" or is_list(message) then failure.raise("request", "expected a request {jsonrpc, id, method, params}") end
  if message.jsonrpc ~= "2.0" then failure.raise("request", "jsonrpc: expected \"2.0\"") end
  if type(message.method) ~= "string" then failure.raise("request", "method: expected a string") end
  if message.id ~= nil and not is_id(message.id) then failure.raise("request", "id: expected a string or a number") end
  local params = message.params
  if params == nil or is_list(params) and #params == 0 then return {} end
  if type(params) ~= "table" or is_list(params) then failure.raise("params", "params: expected an object of parameters by name") end
  return params
end

--- A message as text. A result that JSON cannot express becomes an error.
function messages.encode(message)
  local ok, text = pcall(json.encode, message)
  if ok then return text end
  if is_stopped(text) then error(text, 0) end
  return json.encode {jsonrpc = "2.0", id = message.id, error = failure.of(text)}
end

-- the response with a result, as messages.encode writes it
local function response(id, result)
  local ok, text = pcall(values.text, result)
  if not ok then return messages.encode {jsonrpc = "2.0", id = id, result = result} end
  return ('{"id":%s,"jsonrpc":"2.0","result":%s}'):format(math.type(id) == "integer" and id or json.encode(id), text)
end

local function may_have_null_id(text) return text:find '"id"%s*:%s*null' ~= nil end

-- Has the request with this text the id null? A decoded object does not distinguish it from a notification, which has no id.
local function has_null_id(text) return may_have_null_id(text) and json.split(text).id == "null" end

local function result_of(message, call)
  local params = check_form(message)
  return call(message.method, params, message.id)
end

-- The response to a request, as text; nil: it is a notification.
-- text: of the request
local function respond(message, text, call)
  local ok, result = pcall(result_of, message, call)
  if not ok and is_stopped(result) then error(result, 0) end
  local id = type(message) == "table" and not is_list(message) and message.id
  local is_request = id ~= nil or not ok and result.code == failure.request or has_null_id(text)
  if not is_request or ok and result == messages.no_answer then return nil end
  id = is_id(id) and id or null
  if ok then return response(id, result) end
  return messages.encode {jsonrpc = "2.0", id = id, error = failure.of(result)}
end

-- the message of a text; text that is not UTF-8 could not be sent back, for instance as the id of a response
local function decoded(text)
  local valid, at = utf8.len(text)
  if not valid then failure.raise("parse", "byte %d is not UTF-8", at) end
  return json.decode(text, {max_values = max_values})
end

local function is_limit(problem) return debug.getmetatable(problem) == error_value and problem.kind == "limit" end

local function error_response(id, kind, format, ...) return messages.encode {jsonrpc = "2.0", id = id, error = {code = failure[kind], message = format:format(...)}} end

-- the response to a request that has too many values, of which only the id is decoded
local function refuse_large(text)
  local split, fields = pcall(json.split, text, {max_values = max_batch})
  if split and fields.method and not fields.id then return nil end
  local ok, id = pcall(json.decode, split and fields.id or "null", {max_values = 1})
  return error_response(ok and is_id(id) and id or null, "refused", "params: expected at most %d values in one request", max_values)
end

-- the response to a text that was not decoded
local function refuse(text, problem)
  if is_stopped(problem) then error(problem, 0) end
  if is_limit(problem) then return refuse_large(text) end
  return error_response(null, "parse", "%s", failure.of(problem).message)
end

local function no_pause() end

local function refuse_call() failure.raise("refused", "the answers to the previous requests of this batch have more than %d bytes", max_answers) end

-- Responses to the requests of a batch, as text.
-- respond_to(i, call): response to one of them; pause: called between them; true: the rest is not needed
local function respond_to_all(count, respond_to, call, pause)
  local responses, size = {}, 0
  for i = 1, count do
    local one = respond_to(i, size > max_answers and refuse_call or call)
    responses[#responses + 1] = one
    size = size + (one and #one or 0)
    if pause() then return nil end
  end
  if #responses > 0 then return "[" .. table.concat(responses, ",") .. "]" end
end

local function wrong_count(got) return error_response(null, "request", "expected 1 to %d requests in a batch, got %s", max_batch, got) end

-- the response to a line
local function respond_to_line(message, line, call, pause)
  if not is_list(message) then return respond(message, line, call) end
  if #message == 0 or #message > max_batch then return wrong_count(#message) end
  local texts = may_have_null_id(line) and json.split(line) or {}
  return respond_to_all(#message, function(i, call_one) return respond(message[i], texts[i] or "", call_one) end, call, pause)
end

local function is_long_request(message, is_long)
  return type(message) == "table" and type(message.method) == "string" and is_long(message.method, type(message.params) == "table" and message.params or {})
end

local function has_long(message, is_long)
  if not is_list(message) then return is_long_request(message, is_long) end
  for _, one in ipairs(message) do
    if is_long_request(one, is_long) then return true end
  end
  return false
end

-- Answers a batch in a task: others are served meanwhile, further requests of its client later. It ends when its client has gone.
-- respond_to_batch(pause): response to the batch
local function serve_in_turns(answerer, respond_to_batch)
  if answerer.hold then answerer.hold() end
  clench.loop.spawn(function()
    local pause, finish = turn.new_shared()
    answerer.reply(respond_to_batch(function() return pause() and answerer.has_gone ~= nil and answerer.has_gone() end))
    finish()
    if answerer.release then answerer.release() end
  end)
end

-- Answers a batch that has too many values to be decoded at once: its requests are decoded one at a time.
local function serve_large_batch(line, answerer)
  local ok, texts = pcall(json.split, line, {max_values = max_batch})
  if not ok then return answerer.reply(is_limit(texts) and wrong_count "more" or refuse(line, texts)) end
  serve_in_turns(answerer, function(pause)
    return respond_to_all(#texts, function(i, call)
      local is_read, message = pcall(decoded, texts[i])
      if not is_read then return refuse(texts[i], message) end
      return respond(message, texts[i], call)
    end, answerer.call, pause)
  end)
end

--- Answers a line. Lines with long requests are answered in separate tasks, while other lines are served.
---@param line string
---@param answerer table  with these functions:
---  reply(text: string?)  sends the answer, if there is one
---  call(method: string, params: table, id: any): any  result of a request, as plain data or as values.encoded
---  is_long(method: string, params: table): boolean
---  hold(), release()  keep further requests of its client back; nil if there are no other clients
---  has_gone(): boolean  no answer can be sent any more; with hold
function messages.serve(line, answerer)
  if not line:find "%S" then return end
  local ok, message = pcall(decoded, line)
  if not ok then
    if is_limit(message) and line:find "^%s*%[" then return serve_large_batch(line, answerer) end
    return answerer.reply(refuse(line, message))
  end
  if has_long(message, answerer.is_long) then
    clench.loop.spawn(function() answerer.reply(respond_to_line(message, line, answerer.call, no_pause)) end)
    return coroutine.yield()  -- it begins before the next request of any client is served
  end
  if answerer.hold and is_list(message) and #message > 1 then
    return serve_in_turns(answerer, function(pause) return respond_to_line(message, line, answerer.call, pause) end)
  end
  answerer.reply(respond_to_line(message, line, answerer.call, no_pause))
end

--- Sends a notification.
---@param params table  plain data
function messages.notify(client, method, params) client:send(messages.encode {jsonrpc = "2.0", method = method, params = params} .. "\n") end

--- Answers a line that is too long.
function messages.refuse_long(client)
  client:send(messages.encode {jsonrpc = "2.0", id = null, error = {code = failure.request, message = ("a line has more than %d bytes"):format(client.port.max_line)}} .. "\n")
end

return messages
