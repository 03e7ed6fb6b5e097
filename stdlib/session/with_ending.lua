--- A file name with an ending, which is appended if it has none; "" and a path of a folder, which ends in "/", are unchanged.
---@param name string
---@param ending string  ".wld"
---@return string
return function(name, ending) return (name == "" or name:match "%.[^./]+$" or name:match "/$") and name or name .. ending end
