--- A file name with an ending, which is appended if it has none.
---@param name string
---@param ending string  ".wld"
---@return string
return function(name, ending) return name:match "%.[^./]+$" and name or name .. ending end
