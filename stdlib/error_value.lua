-- What Clench raises: the script's line (`place`, "a.lua:3: "), what went wrong there (`sentence`) and its `kind`. It prints, joins and is
-- searched as the string that both make, its `text`.
local value = {__name = "error"}

local methods = {}
-- a host may have opened no libraries
for name, fn in (next or function() end), string or {} do
  methods[name] = function(self, ...) return fn(self.text, ...) end
end

function value:__index(key)
  if key == "text" then return self.place .. self.sentence end
  return methods[key]
end

function value:__tostring() return self.text end

function value.__concat(a, b) return tostring(a) .. tostring(b) end

function value:__len() return #self.text end

return value
