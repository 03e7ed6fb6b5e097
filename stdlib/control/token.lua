--- Secrets by which clients of a server prove that they may control it.
local raise = require "clench.raise"
local token = {}

--- A new secret: 192 random bits as hexadecimal digits.
---@return string
function token.new()
  local source = io.open("/dev/urandom", "rb")
  local bytes = source and source:read(24)
  if source then source:close() end
  if not bytes or #bytes < 24 then raise("clench.control.server: the system has no random numbers (/dev/urandom)", "limit") end
  return (bytes:gsub(".", function(byte) return ("%02x"):format(byte:byte()) end))
end

--- Are two strings equal? The duration of the comparison does not depend on the position of a difference.
function token.equal(given, secret)
  if type(given) ~= "string" then return false end
  local difference = #given ~ #secret
  for i = 1, #secret do difference = difference | ((given:byte(i) or 0) ~ secret:byte(i)) end
  return difference == 0
end

return token
