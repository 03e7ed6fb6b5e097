--- A file name with an ending, which is appended if it has none; that of a folder, which ends in "/", is unchanged.
---@param name string
---@param ending string  ".wld"
---@return string
return function(name, ending) return (name:match "%.[^./]+$" or name:match "/$") and name or name .. ending end
