-- What Clench raises: a text that tells its kind. It prints, joins and is searched as the string that it says.
local value = {__name = "error"}

value.__index = {}
-- a host may have opened no libraries
for name, fn in (next or function() end), string or {} do
  value.__index[name] = function(self, ...) return fn(self.text, ...) end
end

function value:__tostring() return self.text end

function value.__concat(a, b) return tostring(a) .. tostring(b) end

function value:__len() return #self.text end

return value
