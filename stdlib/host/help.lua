--- help(x) in the console: prints the documentation of a value or of a name.
local doc = require "clench.host.doc"
local packed_docs = require "clench.signature.packed_docs"
local suggest = require "clench.suggest"
local help = {}

local function print_entry(subject, entry)
  local parsed = doc.parse(entry.doc)
  print(doc.signature(subject, parsed))
  print("  " .. parsed.text)
  for _, line in ipairs(doc.details(parsed)) do print("  " .. line) end
end

local function print_members(title, entries, separator)
  for _, entry in ipairs(entries) do
    print(("  %-24s %s"):format(title .. separator .. entry.name, (doc.parse(entry.doc).text:gsub("%. .*", "."))))
  end
end

local function print_class(class, all)
  print(class.variable .. ": " .. class.doc)
  print_members("", class.fields, ".")
  print_members("", class.methods, ":")
  for _, parent in ipairs(all.classes) do
    if parent.name == class.parent then print_class(parent, all) end
  end
end

-- also for Lua modules, "clench.plan"   returns  is there such a library?
local function print_library(name, all)
  local found = false
  for _, library in ipairs(all.libraries) do
    if library.name == name then
      if library.doc ~= "" then print(library.doc) end
      print_members(name, library.fields, ".")
      print_members(name, library.functions, ".")
      found = true
    end
  end
  local begin = name:match "^clench%.(.+)$"
  for _, entry in ipairs(begin and packed_docs.functions(all.files) or {}) do
    local own = entry.name:match("^" .. begin:gsub("%p", "%%%0") .. "%.(.+)$")
    if own then
      print_members(name, {{name = own, doc = entry.doc}}, ".")
      found = true
    end
  end
  return found
end

-- calls visit(subject, entry) for every function, field and method
local function each(all, visit)
  for _, library in ipairs(all.libraries) do
    for _, kind in ipairs {"functions", "fields"} do
      for _, entry in ipairs(library[kind]) do visit(library.name .. "." .. entry.name, entry) end
    end
  end
  for _, class in ipairs(all.classes) do
    for _, entry in ipairs(class.fields) do visit(class.variable .. "." .. entry.name, entry) end
    for _, entry in ipairs(class.methods) do visit(class.variable .. ":" .. entry.name, entry) end
  end
end

-- prints the names of all entries whose documentation contains the word, one per line
local function print_mentions(word, all)
  local names = {}
  local function look(subject, entry)
    if entry.doc:lower():find(word:lower(), 1, true) then names[#names + 1] = subject end
  end
  each(all, look)
  for _, entry in ipairs(packed_docs.functions(all.files)) do look("clench." .. entry.name, entry) end
  table.sort(names)
  if #names > 0 then print(("'%s' is not a name; it is mentioned by\n  %s"):format(word, table.concat(names, "\n  "))) end
  return #names > 0
end

-- the value of "clench.json.encode"
local function value_of(path)
  local value = _G
  for name in path:gmatch "[^.]+" do value = type(value) == "table" and value[name] or nil end
  return value
end

-- all names, for a suggestion
local function all_names(all)
  local names, seen = {}, {}
  local function add(_, entry)
    local name = entry.name:match "[%w_]+$"
    if not seen[name] then names[#names + 1] = name end
    seen[name] = true
  end
  each(all, add)
  for _, entry in ipairs(packed_docs.functions(all.files)) do add(nil, entry) end
  return names
end

local function explain(x)
  local all, found = clench.entries(), false
  local meta = debug.getmetatable(x)
  local name = type(meta) == "table" and rawget(meta, "__name")
  if x == nil then
    print "help(x) explains a value: a function, a robot, clench.json; help 'autograsp' finds a name, or the entries that mention a word."
    print_library("clench", all)
    return
  elseif type(x) == "string" then
    each(all, function(subject, entry)
      if subject == x or entry.name == x then print_entry(subject, entry) found = true end
    end)
    for _, entry in ipairs(packed_docs.functions(all.files)) do
      local subject = "clench." .. entry.name
      if subject == x or entry.name == x or entry.name:match "[%w_]+$" == x then print_entry(subject, entry) found = true end
    end
    found = found or print_library(x, all) or print_library("clench." .. x, all) or #x > 2 and print_mentions(x, all)
  elseif type(x) == "function" then
    local _, id = debug.getupvalue(x, 1)
    each(all, function(subject, entry)
      if entry.id == id then print_entry(subject, entry) found = true end
    end)
    for _, entry in ipairs(found and {} or packed_docs.functions(all.files)) do
      local subject = "clench." .. entry.name
      if value_of(subject) == x then print_entry(subject, entry) found = true end
    end
    for name, library in pairs(found and {} or package.loaded) do
      for key, value in pairs(type(library) == "table" and library or {}) do
        if value == x and not found then
          print(("%s%s is a function of Lua"):format(name == "_G" and "" or name .. ".", key))
          found = true
        end
      end
    end
  elseif type(x) == "table" and name then
    found = print_library(name, all)
  else
    for _, class in ipairs(all.classes) do
      if type(x) == "userdata" and class.name == name then print_class(class, all) found = true end
    end
  end
  if not found then
    local hint = type(x) == "string" and suggest(x:match "[%w_]*$", all_names(all))
    print("there is no help for " .. require "clench.show"(x) .. (hint or '; a field is explained by its name, as in help "hand.dofs"'))
  end
end

local function show_whole(x) print(require "clench.show"(x, math.huge)) end

--- Defines the globals `help` and `show`, unless the script has defined them: show(x) prints a complete table.
function help.install()
  for name, value in pairs {help = explain, show = show_whole} do
    if rawget(_G, name) == nil then rawset(_G, name, value) end
  end
end

return help
