-- Errors of Clench: the script's line (`place`, "a.lua:3: "), the message (`sentence`) and the `kind`. For printing, concatenation and string methods the value
-- acts as the string `text`, which consists of place and sentence.
local value = {__name = "error"}

local methods = {}
-- a host may not have opened the string library
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
