local new_port = require "clench.port.port"
local open_pty = require "clench.open_pty"

--- Opens a pseudo-terminal: for a program that opens its `path` it is a serial line, whose other side is the port. The path exists until
--- the port is closed.
---@return port port  with the field `path`
---@effect edits
--- > pty = clench.port.pty()
--- > pty.path:match "^/dev/" ~= nil  --> true
return function()
  local stream, path = open_pty()
  return new_port(stream, {path = path})
end
