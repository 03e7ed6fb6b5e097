local new_options = require "clench.options"
local new_port = require "clench.port.port"
local open_serial = require "clench.open_serial"
local on_behalf_of = require "clench.on_behalf_of"

--- Opens a serial line for raw bytes, exclusively for this process. Earlier input is discarded; closing restores the settings of the line.
---@param options table
---@option path string  the device: "/dev/ttyUSB0"
---@option baud? integer [bit/s, > 0] = 9600  any rate that the device supports
---@option data_bits? integer [5 to 8] = 8
---@option stop_bits? integer [1 to 2] = 1
---@option parity? "none"|"even"|"odd"
---@option flow? "none"|"hardware"|"software"
---@return port port # `port:read`, `read_some`, `read_line`, `read_until`, `write`, `send`, `drain`, `record`, `close`
---@effect edits
--- > pty = clench.port.pty()
--- > line = clench.port.serial {path = pty.path, baud = 115200}
--- > line:write "?G"
--- > pty:read(2, 1)  --> ?G
--- > line:close()
--- > line:read(1)  --> nil, closed
--- > clench.port.serial {path = "/dev/null"}  --> error: /dev/null: expected a serial line
return function(options)
  new_options("clench.port.serial", options)
  return new_port(on_behalf_of("clench.port.serial", open_serial, options))
end
