-- A client of JSON-RPC for tests: call(method, params) returns the response, get(method, params) its result; `notes` has the notifications that came before.
local clench = require "clench"
local json = clench.json

return function(server, token)
  local client = {port = clench.port.connect("127.0.0.1", server.port), id = 0, notes = {}}
  function client.receive()
    local line, why = client.port:read_line(10)
    return line and json.decode(line), why or line
  end
  -- the response to a request; notifications received before it are kept
  function client.call(method, params)
    client.id = client.id + 1
    client.port:write(json.encode {jsonrpc = "2.0", id = client.id, method = method, params = params} .. "\n")
    while true do
      local message = assert(client.receive())
      if message.id == client.id then return message end
      client.notes[#client.notes + 1] = message
    end
  end
  -- its result
  function client.get(method, params)
    local response = client.call(method, params)
    if response.error then error(method .. ": " .. response.error.message, 0) end
    return response.result
  end
  if token ~= false then client.get("hello", {token = token or server.token}) end
  return client
end
