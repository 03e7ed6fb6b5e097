--- Documentation from the tables of the bindings: pages for readers, and a stub for editors (LuaCATS).
local descriptions = require "clench.signature.descriptions"
local packed_docs = require "clench.signature.packed_docs"
local signature = require "clench.signature.grammar"
local doc = {}

--- The parts of an entry's doc for pages: text, params, returns, type, examples, and the preparing code that belongs to no example.
---@param text string
function doc.parse(text)
  local parsed = descriptions.parse(text)
  parsed.params = {}
  for i, item in ipairs(parsed.parameters) do
    local name = item.name .. (item.optional and "?" or "")
    local lines = item.fields and item.type:find "%f[%a]table%f[%A]" and item.fields
    local limits = signature.limits(item)
    parsed.params[i] = {name = name, type = signature.type_of(item), text = item.text, limits = limits, options = lines or nil, short_type = lines and item.type or nil}
  end
  return parsed
end

local function arguments(parsed)
  local names = {}
  for i, param in ipairs(parsed.params) do names[i] = (param.name:gsub("%?$", "")) end
  return table.concat(names, ", ")
end

--- "clench.rad(degrees)"; for a field only its name
function doc.signature(subject, parsed)
  return parsed.type and subject or ("%s(%s)"):format(subject, arguments(parsed))
end

local function after(dash, text) return text ~= "" and dash .. text or "" end

-- calls visit("verify.lift?", option) for each option with a line in the docs, in order
local function each_option(options, before, visit)
  for _, option in ipairs(options or {}) do
    visit(before .. option.name .. (option.optional and "?" or ""), option)
    each_option(option.fields, before .. option.name .. ".", visit)
  end
end

--- A line for each parameter, option and result, and the examples.
function doc.details(parsed)
  local lines = {}
  if parsed.type then lines[#lines + 1] = "type " .. parsed.type.type .. after("  ", parsed.type.text) end
  for _, p in ipairs(parsed.params) do
    lines[#lines + 1] = ("%s: %s%s%s"):format(p.name, p.short_type or p.type, after(" ", p.limits), after("  ", p.text))
    each_option(p.options, "", function(name, option)
      lines[#lines + 1] = ("  %s: %s%s%s"):format(name, option.type, after(" ", signature.limits(option)), after("  ", option.text))
    end)
  end
  for _, r in ipairs(parsed.returns) do lines[#lines + 1] = "returns " .. r.type .. after("  ", r.text) end
  if parsed.effect then lines[#lines + 1] = "effect " .. signature.effect_text(parsed) end
  for _, e in ipairs(parsed.examples) do
    for _, code in ipairs(e.prepare) do lines[#lines + 1] = "> " .. code end
    lines[#lines + 1] = "> " .. e.code .. "  --> " .. e.result
  end
  return lines
end

-- --- pages ---

-- a table from a field is a copy: changes of it have no effect
local function access(kind, settable)
  local copy = kind:find "^table" or kind:find "^{" or kind:find "%]%??$"
  if copy then return settable and "; a copy: assign to change it." or "; read only, a copy." end
  return settable and "; can be set." or "; read only."
end

local function add_entry(page, subject, entry)
  local parsed = doc.parse(entry.doc)
  page("\n### `%s`\n\n%s\n", doc.signature(subject, parsed), parsed.text)
  if parsed.type then
    page("\nType `%s`%s%s\n", parsed.type.type, after(" ", parsed.type.text), access(parsed.type.type, entry.settable))
  end
  if #parsed.params + #parsed.returns > 0 or parsed.effect then page "\n" end
  for _, p in ipairs(parsed.params) do
    page("- `%s`: `%s`%s%s\n", p.name, p.short_type or p.type, after(" ", p.limits), after(" – ", p.text))
    each_option(p.options, "", function(name, option)
      page("  - `%s`: `%s`%s%s\n", name, option.type, after(" ", signature.limits(option)), after(" – ", option.text))
    end)
  end
  for _, r in ipairs(parsed.returns) do page("- returns `%s`%s\n", r.type, after(" – ", r.text)) end
  if parsed.effect then page("- effect: `%s`\n", signature.effect_text(parsed)) end
  if #parsed.examples == 0 then return end
  page "\n```lua\n"
  for _, e in ipairs(parsed.examples) do
    for _, code in ipairs(e.prepare) do page("%s\n", code) end
    page("%s  --> %s\n", e.code, e.result)
  end
  page "```\n"
end

local function new_page(title)
  local parts = {}
  local page = setmetatable({}, {__call = function(_, format, ...)
    parts[#parts + 1] = select("#", ...) > 0 and format:format(...) or format
  end})
  function page.text() return table.concat(parts) end
  if title then page("# %s\n", title) end
  return page
end

-- libraries of one name are merged into one page
local function merged(libraries)
  local list, by_name = {}, {}
  for _, library in ipairs(libraries) do
    local one = by_name[library.name]
    if not one then
      one = {name = library.name, doc = "", functions = {}, fields = {}}
      by_name[library.name] = one
      list[#list + 1] = one
    end
    if library.doc ~= "" then one.doc = library.doc end
    for _, kind in ipairs {"functions", "fields"} do
      for _, entry in ipairs(library[kind]) do table.insert(one[kind], entry) end
    end
  end
  return list
end

local function library_page(library)
  local page = new_page(library.name)
  page("\n%s\n", library.doc)
  for _, entry in ipairs(library.fields) do add_entry(page, library.name .. "." .. entry.name, entry) end
  for _, entry in ipairs(library.functions) do add_entry(page, library.name .. "." .. entry.name, entry) end
  return page.text()
end

local function class_page(class)
  local page = new_page(class.name)
  page("\n%s\n", class.doc)
  if class.parent then page("\nIt also has every field and method of [%s](%s.md).\n", class.parent, class.parent) end
  if #class.fields > 0 then page "\n## Fields\n" end
  for _, entry in ipairs(class.fields) do add_entry(page, class.variable .. "." .. entry.name, entry) end
  if #class.methods > 0 then page "\n## Methods\n" end
  for _, entry in ipairs(class.methods) do add_entry(page, class.variable .. ":" .. entry.name, entry) end
  return page.text()
end

local function packed_page(files)
  local page = new_page "The standard library"
  page "\nModules in Lua, loaded when they are first used.\n"
  for _, entry in ipairs(packed_docs.functions(files)) do add_entry(page, "clench." .. entry.name, entry) end
  return page.text()
end

local function index_page(libraries, classes)
  local page = new_page "The Lua API"
  page "\nGenerated by `clench doc` from the bindings; the examples on these pages are run by the tests.\n\n"
  for _, library in ipairs(libraries) do page("- [%s](%s.md)\n", library.name, library.name) end
  for _, class in ipairs(classes) do page("- [%s](%s.md): a value that scripts hold\n", class.name, class.name) end
  page "- [the standard library](stdlib.md)\n- [clench.lua](clench.lua): a stub for editors (LuaCATS)\n"
  return page.text()
end

-- --- the editor's stub ---

local function add_stub(page, subject, parsed)
  page("\n---%s\n", parsed.text)
  for _, p in ipairs(parsed.params) do page("---@param %s %s%s\n", p.name, p.type, after(" # ", p.text)) end
  for _, r in ipairs(parsed.returns) do page("---@return %s%s\n", r.type, after(" # ", r.text)) end
  page("function %s(%s) end\n", subject, arguments(parsed))
end

local function add_stub_fields(page, fields)
  for _, entry in ipairs(fields) do
    local parsed = doc.parse(entry.doc)
    local kind = parsed.type or {type = "any", text = ""}
    page("---@field %s %s # %s%s\n", entry.name, kind.type, parsed.text, after(" ", kind.text))
  end
end

local function stub(libraries, classes)
  local page = new_page()
  page "---@meta clench\n-- Generated by `clench doc`.\n\n---Number of an element, from 1.\n---@alias index integer\n"
  for _, class in ipairs(classes) do
    page("\n---%s\n---@class %s%s\n", class.doc, class.name, class.parent and ": " .. class.parent or "")
    add_stub_fields(page, class.fields)
    page("local %s = {}\n", class.name)
    for _, entry in ipairs(class.methods) do add_stub(page, class.name .. ":" .. entry.name, doc.parse(entry.doc)) end
  end
  for _, library in ipairs(libraries) do
    page("\n---%s\n---@class %s\n", library.doc, library.name)
    add_stub_fields(page, library.fields)
    page("%s%s = {}\n", library.name:find "%." and "" or "local ", library.name)
    for _, entry in ipairs(library.functions) do add_stub(page, library.name .. "." .. entry.name, doc.parse(entry.doc)) end
  end
  page "\nreturn clench\n"
  return page.text()
end

--- All pages: name, text, name, text, ...
function doc.pages()
  local all, pages = clench.entries(), {}
  local libraries = merged(all.libraries)
  local function add(name, text)
    pages[#pages + 1] = name
    pages[#pages + 1] = text
  end
  add("index.md", index_page(libraries, all.classes))
  for _, library in ipairs(libraries) do add(library.name .. ".md", library_page(library)) end
  for _, class in ipairs(all.classes) do add(class.name .. ".md", class_page(class)) end
  add("stdlib.md", packed_page(all.files))
  add("clench.lua", stub(libraries, all.classes))
  return table.unpack(pages)
end

return doc
