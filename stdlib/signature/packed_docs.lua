--- Extracts the docs of entries of the standard library from the comments before its functions.
local packed_docs = {}

--- Each block of `---` lines before a public function of a module, its `return function(...)` or its `function module.name(...)`, as the doc of an entry;
--- functions of folder/unit.lua belong to the folder.
---@param file {path: string, text: string}
---@return {name: string, line: integer, doc: string}[]
function packed_docs.of(file)
  local comment, found, number = {}, {}, 0
  local module = file.path:gsub("%.lua$", ""):gsub("/", ".")
  local folder, unit = module:match "^(.*%.)([^.]+)$"
  for line in (file.text .. "\n"):gmatch "(.-)\n" do
    number = number + 1
    local said = line:match "^%-%-%-%s?(.*)$"
    if said and not said:find "^[@>]" and #comment > 0 and comment[#comment]:sub(1, 1) == "@" then
      -- a tag continues: with its type while a brace is open, else with prose
      local tag = comment[#comment]
      local _, opened = tag:gsub("{", "")
      local _, closed = tag:gsub("}", "")
      local prose = tag:find "%S%s%s+%S"
      comment[#comment] = tag .. ((opened > closed or prose) and " " or "  ") .. said:gsub("^%s+", "")
    elseif said then
      comment[#comment + 1] = said
    else
      local name = line:match("^function " .. (unit or module) .. "%.([%w_]+)%(")
      local single = line:match "^return function%("
      local has_example = ("\n" .. table.concat(comment, "\n")):find("\n> ", 1, true)
      -- a file outside of folders that returns one function is public if its comment has an example
      local offers = name or single and (unit or has_example)
      if offers and #comment > 0 then
        local full = name and (folder or module .. ".") .. name or module
        found[#found + 1] = {name = full, line = number, doc = table.concat(comment, "\n")}
      end
      comment = {}
    end
  end
  return found
end

--- Functions of the standard library that scripts find by name: those that a module's init.lua, or its only file, provides.
---@param files {path: string, text: string}[]
---@return {name: string, doc: string, fn: function}[]
function packed_docs.functions(files)
  local list = {}
  for _, file in ipairs(files) do
    for _, entry in ipairs(file.path:find "^host/" and {} or packed_docs.of(file)) do
      local ok, offered = pcall(function()
        local value = clench
        for name in entry.name:gmatch "[^.]+" do value = value[name] end
        return value
      end)
      local info = ok and type(offered) == "function" and debug.getinfo(offered, "S")
      -- another unit of the folder may have a function of that name that is not public
      if info and info.linedefined == entry.line and ("/" .. info.source):sub(-#file.path - 1) == "/" .. file.path then
        entry.fn = offered
        list[#list + 1] = entry
      end
    end
  end
  return list
end

return packed_docs
