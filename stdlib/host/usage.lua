--- Raises an error of usage, which ends `clench plan` with code 2.
---@param text string  a format of string.format
return function(text, ...) error({usage = text:format(...)}, 0) end
