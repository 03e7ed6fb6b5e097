--- Draws a part of the interface. An error is shown in its place, and does not affect the rest.
local error_text = require "clench.error_text"
local is_stopped = require "clench.is_stopped"
local printable = require "clench.printable"

---@param draw fun(ui: ui, ...)
return function(ui, draw, ...)
  local ok, message = pcall(draw, ui, ...)
  if ok then return end
  if is_stopped(message) then error(message, 0) end
  ui:text(printable(error_text(message), "\n\t"), {color = {0.84, 0.37, 0}, wrap = true})
end
