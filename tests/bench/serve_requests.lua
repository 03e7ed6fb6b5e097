-- Short requests of both protocols, for tests/bench/serve.lua.
local clench = require "clench"
local requests = {}

--- A line of JSON-RPC.
function requests.request(method, params) return clench.json.encode {jsonrpc = "2.0", id = 1, method = method, params = params} .. "\n" end

--- Connects to a port; with a token as a client of JSON-RPC.
function requests.connect(number, token)
  local port = clench.port.connect("127.0.0.1", number)
  if token then
    port:write(requests.request("hello", {token = token}))
    assert(port:read_line(10):find "result")
  end
  return port
end

-- lines: of the reply
requests.small = {
  {name = "getRobotName", line = "getRobotName 1 0\n", lines = 1},
  {name = "getDOFVals", line = "getDOFVals 1 0\n", lines = 5},
  {name = "get", rpc = true, line = requests.request("get", {of = "barrett", fields = {"dofs"}}), lines = 1},
  {name = "world.hash", rpc = true, line = requests.request "world.hash", lines = 1},
}

return requests
