local new_port = require "clench.port.port"
local open_pair = require "clench.open_pair"

--- Two ports, each of which receives the bytes written to the other.
---@return port a
---@return port b
---@effect edits
--- > a, b = clench.port.pair()
--- > a:write "one\ntwo\n"
--- > b:read_line(1), b:read_line(1)  --> one, two
--- > b:read_line(0)  --> nil, timeout
--- > a:close()
--- > b:read_line(1)  --> nil, closed
return function()
  local a, b = open_pair()
  return new_port(a), new_port(b)
end
