--- The optional table of options of a function that passes it on; a new table if it is nil.
local raise = require "clench.raise"
local described = require "clench.described"
local module_name = require "clench.module_name"

---@param subject string  "report:chart"
---@param options any
---@return table
return function(subject, options)
  if options == nil then return {} end
  if type(options) ~= "table" or module_name(options) then
    raise(("%s: options: expected a table, got %s"):format(subject, described(options)))
  end
  return options
end
