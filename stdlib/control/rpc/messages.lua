--- Messages of JSON-RPC 2.0, one per line: every request is answered, including malformed ones.
local failure = require "clench.control.rpc.failure"
local is_stopped = require "clench.is_stopped"
local null_ids = require "clench.control.rpc.null_ids"
local new_turn = require "clench.control.turn"
local messages = {}

local max_batch = 1000     -- requests
local max_values = 50000  -- in the parameters of one request
local null = clench.json.null

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
  local ok, text = pcall(clench.json.encode, message)
  if ok then return text end
  if is_stopped(text) then error(text, 0) end
  return clench.json.encode {jsonrpc = "2.0", id = message.id, error = failure.of(text)}
end

-- the response with a result, as messages.encode writes it
local function response(id, result)
  local ok, text = pcall(clench.json.encode, result)
  if not ok then return messages.encode {jsonrpc = "2.0", id = id, result = result} end
  return ('{"id":%s,"jsonrpc":"2.0","result":%s}'):format(math.type(id) == "integer" and id or clench.json.encode(id), text)
end

-- the number of values in nested tables, or a number above max_values
local function count_of(value, count)
  for _, item in next, value do
    count = count + 1
    if count > max_values then return count end
    if type(item) == "table" then count = count_of(item, count) end
  end
  return count
end

local function result_of(message, call)
  local params = check_form(message)
  if count_of(params, 0) > max_values then failure.raise("refused", "params: expected at most %d values in one request", max_values) end
  return call(message.method, params, message.id)
end

-- the response to a request, as text; nil: it is a notification
local function respond(message, call, has_null_id)
  local ok, result = pcall(result_of, message, call)
  if not ok and is_stopped(result) then error(result, 0) end
  local id = type(message) == "table" and not is_list(message) and message.id
  local is_request = has_null_id or id ~= nil or not ok and result.code == failure.request
  if not is_request or ok and result == messages.no_answer then return nil end
  id = is_id(id) and id or null
  if ok then return response(id, result) end
  return messages.encode {jsonrpc = "2.0", id = id, error = failure.of(result)}
end

local function no_pause() end

-- pause: called between the requests of a batch; true: the rest is not needed
local function respond_to_all(message, call, line, pause)
  if not is_list(message) then return respond(message, call, null_ids(line)[1]) end
  if #message == 0 or #message > max_batch then
    local ok, problem = pcall(failure.raise, "request", "expected 1 to %d requests in a batch, got %d", max_batch, #message)
    return not ok and messages.encode {jsonrpc = "2.0", id = null, error = failure.of(problem)}
  end
  local responses, has_null_id = {}, null_ids(line)
  for i, one in ipairs(message) do
    responses[#responses + 1] = respond(one, call, has_null_id[i])
    if pause() then return nil end
  end
  if #responses > 0 then return "[" .. table.concat(responses, ",") .. "]" end
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

-- the message of a line; text that is not UTF-8 could not be sent back, for instance as the id of a response
local function decoded(line)
  local valid, at = utf8.len(line)
  if not valid then failure.raise("parse", "byte %d is not UTF-8", at) end
  return clench.json.decode(line)
end

-- Answers a batch in a task: others are served meanwhile, further requests of its client later. It ends when its client has gone.
local function serve_in_turns(message, line, answerer)
  answerer.hold()
  clench.loop.spawn(function()
    local pause = new_turn()
    answerer.reply(respond_to_all(message, answerer.call, line, function() return pause() and answerer.has_gone() end))
    answerer.release()
  end)
end

--- Answers a line. Lines with long requests are answered in separate tasks, while other lines are served.
---@param line string
---@param answerer table  with these functions:
---  reply(text: string?)  sends the answer, if there is one
---  call(method: string, params: table, id: any): any  result of a request, as plain data
---  is_long(method: string, params: table): boolean
---  hold(), release()  keep further requests of its client back; nil if there are no other clients
---  has_gone(): boolean  no answer can be sent any more; with hold
function messages.serve(line, answerer)
  if not line:find "%S" then return end
  local ok, message = pcall(decoded, line)
  if not ok then
    if is_stopped(message) then error(message, 0) end
    return answerer.reply(messages.encode {jsonrpc = "2.0", id = null, error = {code = failure.parse, message = failure.of(message).message}})
  end
  if has_long(message, answerer.is_long) then
    clench.loop.spawn(function() answerer.reply(respond_to_all(message, answerer.call, line, no_pause)) end)
    return coroutine.yield()  -- it begins before the next request of any client is served
  end
  if answerer.hold and is_list(message) and #message > 1 then return serve_in_turns(message, line, answerer) end
  answerer.reply(respond_to_all(message, answerer.call, line, no_pause))
end

--- Sends a notification.
---@param params table  plain data
function messages.notify(client, method, params) client:send(messages.encode {jsonrpc = "2.0", method = method, params = params} .. "\n") end

--- Answers a line that is too long.
function messages.refuse_long(client)
  client:send(messages.encode {jsonrpc = "2.0", id = null, error = {code = failure.request, message = ("a line has more than %d bytes"):format(client.port.max_line)}} .. "\n")
end

return messages
