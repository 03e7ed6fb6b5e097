-- Checks the sources against the tables of docs/architecture.md: permitted includes between modules, the order of the subfolders of a module and of
-- the folders of stdlib, and the sources that may use each library. Also finds include cycles, types with the same name, and names that would collide
-- in unity builds. Runs in a stock interpreter:
--   lua5.4 scripts/check_layers.lua [ROOT]
-- One sentence per fault, file:line first; exit code 1 if there is any.
local root = arg[1] or "."
local faults = {}

local function fault(place, text, ...) faults[#faults + 1] = place .. ": " .. text:format(...) end

local function read(path)
  local file = assert(io.open(root .. "/" .. path, "rb"), "no such file: " .. root .. "/" .. path)
  local text = file:read "a"
  file:close()
  return text
end

-- all names between backquotes, in order
local function quoted(cell)
  local names = {}
  for name in cell:gmatch "`([^`]+)`" do names[#names + 1] = name end
  return names
end

--- Rows of the table whose header cell `column` names, each a table of cells by header, with its line.
local function read_table(path, column)
  local rows, header, line = {}, nil, 0
  for text in (read(path) .. "\n"):gmatch "(.-)\r?\n" do
    line = line + 1
    local cells = {}
    for cell in text:gmatch "|([^|]*)" do cells[#cells + 1] = cell:match "^%s*(.-)%s*$" end
    if text:sub(1, 1) ~= "|" then
      if #rows > 0 then break end
      header = nil
    elseif not header then
      header = cells
    elseif not text:find "^|[-:| ]+$" then
      local row = {line = line}
      for i, name in ipairs(header) do row[name] = cells[i] or "" end
      if row[column] then rows[#rows + 1] = row end
    end
  end
  assert(#rows > 0, root .. "/" .. path .. ": no table with a column '" .. column .. "'")
  return rows
end

--- module -> {rank, direct = names listed in its row, may = set of all modules that it may include}
local function read_modules(path)
  local modules = {}
  for _, row in ipairs(read_table(path, "may include")) do
    local name = quoted(row.module)[1] or row.module
    local module = {name = name, rank = tonumber(row.rank), direct = {}, may = {[name] = true}}
    for other in row["may include"]:gmatch "[%w_]+" do module.direct[#module.direct + 1] = other end
    local place = path .. ":" .. row.line
    if modules[name] then fault(place, "module '%s' has two rows", name) end
    -- rows follow those that they name, so the sets of these are complete
    for _, other in ipairs(module.direct) do
      local below = modules[other]
      if not below then
        fault(place, "module '%s' names '%s', which has no row above", name, other)
      else
        if below.rank >= module.rank then
          fault(place, "module '%s' of rank %d names '%s' of rank %d; a rank names lower ones only",
                name, module.rank, other, below.rank)
        end
        for reached in pairs(below.may) do module.may[reached] = true end
      end
    end
    modules[name] = module
  end
  return modules
end

-- globs of file names or identifiers as Lua patterns: * any letters, [..] a class
local function patterns_of(globs)
  local patterns = {}
  for i, glob in ipairs(globs) do
    local escaped = glob:gsub("[%^%$%(%)%%%.%+%?]", "%%%0")
    patterns[i] = "^" .. escaped:gsub("%*", "[%%w_./]*") .. "$"
  end
  return patterns
end

local function matches(text, patterns)
  for _, pattern in ipairs(patterns) do
    if text:find(pattern) then return true end
  end
  return false
end

--- Rows of the table of libraries: headers, names and homes as patterns; a module as a home means all of its files.
local function read_libraries(path)
  local libraries = {}
  for _, row in ipairs(read_table(path, "seen only by")) do
    local homes = quoted(row["seen only by"])
    for i, home in ipairs(homes) do
      if not home:find "/" then homes[i] = home .. "/*" end
    end
    libraries[#libraries + 1] = {
      name = row.library, said = row["seen only by"]:gsub("`", ""), homes = patterns_of(homes),
      headers = patterns_of(quoted(row["its headers"])), names = patterns_of(quoted(row["its names"])),
    }
  end
  return libraries
end

-- end of the comment or literal that starts at `at`; nil if none starts there. `line`: the text of the line before it
local function end_of_opaque(text, at, line)
  local two = text:sub(at, at + 1)
  local quote = two:sub(1, 1)
  if two == "//" then
    return (text:find("\n", at, true) or #text + 1) - 1
  elseif two == "/*" then
    return select(2, text:find("*/", at + 2, true)) or #text
  elseif quote == '"' and line:find "R$" then
    local delimiter = text:match('^"([^(\n]*)%(', at) or ""
    return select(2, text:find(")" .. delimiter .. '"', at, true)) or #text
  elseif quote == '"' or (quote == "'" and not line:find "%w$") then  -- 1'000 is a number
    local stop = at + 1
    while stop < #text and not text:find("^[\n" .. quote .. "]", stop) do
      stop = stop + (text:sub(stop, stop) == "\\" and 2 or 1)
    end
    return stop
  end
end

-- C++ without comments and literals, except for names of included files; line numbers are kept
local function code_of(text)
  local out, at, line = {}, 1, ""
  while at <= #text do
    local start = text:find("[/\"']", at) or #text + 1
    local plain = text:sub(at, start - 1)
    out[#out + 1] = plain
    line = plain:find "\n" and plain:match ".*\n(.*)$" or line .. plain
    local stop = start <= #text and end_of_opaque(text, start, line)
    local kept = not stop or (text:sub(start, start) == '"' and line:find "^%s*#%s*include")
    stop = stop or start
    local piece = text:sub(start, stop)
    out[#out + 1] = kept and piece or piece:gsub("[^\n]", " ")
    line = piece:find "\n" and piece:match ".*\n(.*)$" or line .. piece
    at = stop + 1
  end
  return table.concat(out)
end

--- All sources in name order, and by path: {path (below src), module, lines, includes = {{line, name, quoted}}}.
local function read_sources()
  local folder = "'" .. (root .. "/src"):gsub("'", "'\\''") .. "'"
  local list = assert(io.popen("cd " .. folder .. " && find . -name '*.h' -o -name '*.cpp' | LC_ALL=C sort"))
  local sources = {}
  for found in list:lines() do
    local path = found:match "^%./(.*)$"
    local source = {path = path, module = path:match "^([^/]+)/" or "", subfolder = path:match "^[^/]+/([^/]+)/",
                    unit = path:match "^(.*)%.", lines = {}, includes = {}}
    for text in (code_of(read("src/" .. path)) .. "\n"):gmatch "(.-)\r?\n" do
      local line = #source.lines + 1
      local opened, name = text:match '^%s*#%s*include%s*([<"])([^>"]+)[>"]'
      -- include names start at include/, where clench is a link to src
      local ours = name and name:match "^clench/(.*)$"
      if name then table.insert(source.includes, {line = line, name = ours or name, quoted = opened == '"'}) end
      source.lines[line] = name and "" or text
    end
    sources[#sources + 1], sources[path] = source, source
  end
  list:close()
  return sources
end

local function at(source, line) return ("src/%s:%d"):format(source.path, line) end

--- module -> its subfolders by name, each with its index in their order
local function read_subfolders(path, modules)
  local subfolders = {}
  for _, row in ipairs(read_table(path, "subfolders, lower ones first")) do
    local name = quoted(row.module)[1] or row.module
    if not modules[name] then fault(path .. ":" .. row.line, "module '%s' has subfolders and no row above", name) end
    subfolders[name] = {}
    for i, subfolder in ipairs(quoted(row["subfolders, lower ones first"])) do subfolders[name][subfolder] = i end
  end
  return subfolders
end

-- files in the module's folder itself are above all subfolders
local function check_subfolders(source, other, include, subfolders)
  local order = subfolders[source.module] or {}
  for _, one in ipairs {source, other} do
    if one.subfolder and not order[one.subfolder] then
      return fault(at(one, 1), "subfolder '%s' of module '%s' has no place in docs/architecture.md", one.subfolder, one.module)
    end
  end
  if source.subfolder and (order[other.subfolder] or math.huge) > order[source.subfolder] then
    fault(at(source, include.line), "subfolder %s of %s may not include \"%s\": it lies higher", source.subfolder, source.module,
          include.name)
  end
end

local function check_modules(sources, modules, subfolders)
  for _, source in ipairs(sources) do
    local module = modules[source.module]
    local public = source.module == ""  -- clench.h, the public header
    if not module and not public then
      fault(at(source, 1), "module '%s' has no row in docs/architecture.md", source.module)
    end
    for _, include in ipairs(source.includes) do
      local other = include.name:match "^([^/]+)/"
      if include.quoted and not sources[include.name] then
        fault(at(source, include.line), 'no such file: "%s"; includes are named as "clench/module/file.h"',
              include.name)
      elseif sources[include.name] and module and not module.may[other] then
        fault(at(source, include.line), 'module %s may not include "%s": its row names %s', source.module,
              include.name, #module.direct > 0 and table.concat(module.direct, ", ") or "nothing")
      elseif sources[include.name] and other == source.module then
        check_subfolders(source, sources[include.name], include, subfolders)
      end
    end
  end
end

-- depth first over units (a header with its source); an include of a unit that is still open closes a cycle
local function check_cycles(sources)
  local units, names = {}, {}
  for _, source in ipairs(sources) do
    if not units[source.unit] then
      units[source.unit] = {}
      names[#names + 1] = source.unit
    end
    for _, include in ipairs(source.includes) do
      local other = sources[include.name] and sources[include.name].unit
      if other and other ~= source.unit then table.insert(units[source.unit], {source, include.line, other}) end
    end
  end
  local state, trail = {}, {}
  local function visit(unit)
    state[unit] = "open"
    trail[#trail + 1] = unit
    for _, edge in ipairs(units[unit]) do
      local source, line, other = table.unpack(edge)
      if state[other] == "open" then
        local from = 1
        while trail[from] ~= other do from = from + 1 end
        fault(at(source, line), "cycle of includes: %s -> %s", table.concat(trail, " -> ", from), other)
      elseif not state[other] then
        visit(other)
      end
    end
    trail[#trail] = nil
    state[unit] = "done"
  end
  for _, unit in ipairs(names) do
    if not state[unit] then visit(unit) end
  end
end

--- name -> the libraries that it belongs to, computed once per name.
local function owners_of_names(libraries)
  return setmetatable({}, {__index = function(known, name)
    local owners = {}
    for _, library in ipairs(libraries) do
      if matches(name, library.names) then owners[#owners + 1] = library end
    end
    known[name] = owners
    return owners
  end})
end

-- headers and names of libraries in one source that is not their home
local function check_libraries(source, libraries, owners, sources)
  local function check(line, found, library)
    if matches(source.path, library.homes) then return end
    fault(at(source, line), "%s belongs to %s, which is seen only by %s", found, library.name, library.said)
  end
  for _, include in ipairs(source.includes) do
    for _, library in ipairs(libraries) do
      if not sources[include.name] and matches(include.name, library.headers) then
        check(include.line, "<" .. include.name .. ">", library)
      end
    end
  end
  for line, text in ipairs(source.lines) do
    for name in text:gmatch "[%a_][%w_]*" do
      for _, library in ipairs(owners[name]) do check(line, "'" .. name .. "'", library) end
    end
  end
end

-- the type whose definition begins a line, or nil
local function defined_type(text)
  local rest = text:match "^struct%s+(.*{.*)$" or text:match "^class%s+(.*{.*)$" or text:match "^enum class%s+(.*{.*)$"
  local name, after = (rest or ""):gsub("^alignas%b()%s*", ""):match "^([%w_]+)(.*)$"
  -- a member of another type, such as Font::Face, has a scope of its own
  return name and not after:find "^::" and name or nil
end

--- No two types in the namespace clench have the same name: the linker would mix up member functions that are not inlined. Types in nested or
--- anonymous namespaces are exempt.
local function check_types(sources)
  local first = {}
  for _, source in ipairs(sources) do
    local depth, outside = 0, nil  -- depth of braces; depth at the start of a namespace other than clench
    for line, text in ipairs(source.lines) do
      local space = text:match "^namespace%s*([%w_:]*)%s*{"
      if space and space ~= "clench" and not outside then outside = depth end
      local name = not outside and defined_type(text)
      if name and first[name] then
        fault(at(source, line), "type '%s' is defined in src/%s as well", name, first[name])
      elseif name then
        first[name] = source.path
      end
      local _, opened = text:gsub("{", "")
      local _, closed = text:gsub("}", "")
      depth = depth + opened - closed
      if outside and depth <= outside then outside = nil end
    end
  end
end

-- the text from a line up to the first ; or {, and which of the two ends it
local function statement_at(source, line)
  local text = ""
  for i = line, math.min(line + 20, #source.lines) do
    text = text .. source.lines[i] .. " "
    local stop = text:match "[;{]"
    if stop then return text:match "^[^;{]*", stop end
  end
  return text, nil
end

-- names of functions and extern constants that a header declares and another file defines, each with its line
local function declared_names(source)
  local found = {}
  for line, piece in ipairs(source.lines) do
    local text, stop = statement_at(source, line)
    local constants = stop == ";" and text:match "^extern%s+const%s+[%w_:<>]+%s+(.*)$"
    for name in (constants or ""):gmatch "[%w_]+" do found[#found + 1] = {name, line} end
    local is_kept = piece:find "^inline" or piece:find "^static" or piece:find "^constexpr" or piece:find "^extern"
    local name = stop == ";" and not is_kept and text:match "^[%a_][%w_:<>,&%*%s]-[%s&%*]([%w_]+)%("
    if name then found[#found + 1] = {name, line} end
  end
  return found
end

-- name -> sources that define a function or constant of this name at the beginning of a line
local function definitions_of(sources)
  local homes = {}
  for _, source in ipairs(sources) do
    if source.path:find "%.cpp$" then
      for _, text in ipairs(source.lines) do
        local name = text:match "^const%s+[%w_:<>]+%s+([%w_]+)%s*[{=]" or
          (not text:find "^static" and not text:find ";%s*$" and text:match "^[%a_][%w_:<>,&%*%s]-[%s&%*]([%w_]+)%(")
        if name then
          homes[name] = homes[name] or {}
          table.insert(homes[name], source)
        end
      end
    end
  end
  return homes
end

--- Declarations of a header are defined in its subfolder or a lower one: files that include the header link against the definition, so a definition
--- in a higher subfolder would be an upward reference without an include.
local function check_links(sources, subfolders, path)
  local homes = definitions_of(sources)
  local excepted = {}  -- by header, then name: the line of the exception; false once it was needed
  for _, row in ipairs(read_table(path, "declares what lies higher")) do
    local names = {}
    for _, name in ipairs(quoted(row["declares what lies higher"])) do names[name] = row.line end
    excepted[quoted(row.header)[1]] = names
  end
  for _, source in ipairs(sources) do
    local order = subfolders[source.module]
    if source.path:find "%.h$" and source.subfolder and order then
      for _, declared in ipairs(declared_names(source)) do
        local name, line = table.unpack(declared)
        local lowest, home  -- the lowest of the definitions in its module; overloads share names
        for _, other in ipairs(homes[name] or {}) do
          local place = other.module == source.module and (order[other.subfolder] or math.huge)
          if place and (not lowest or place < lowest) then lowest, home = place, other end
        end
        local exceptions = excepted[source.path] or {}
        if lowest and lowest > order[source.subfolder] and exceptions[name] ~= nil then
          exceptions[name] = false
        elseif lowest and lowest > order[source.subfolder] then
          fault(at(source, line), "subfolder %s of %s declares '%s', which is defined higher, in src/%s", source.subfolder,
                source.module, name, home.path)
        end
      end
    end
  end
  for header, names in pairs(excepted) do
    for name, line in pairs(names) do
      if line then fault(path .. ":" .. line, "%s does not declare '%s' for a higher subfolder", header, name) end
    end
  end
end

--- Folders of stdlib -> index in their order, and its modules by the names in scripts: clench.plan.job.
local function read_stdlib(path)
  local order, modules = {}, {}
  for i, row in ipairs(read_table(path, "folder of stdlib")) do order[quoted(row["folder of stdlib"])[1]] = i end
  local list = assert(io.popen("cd '" .. root:gsub("'", "'\\''") .. "/stdlib' && find . -name '*.lua' | LC_ALL=C sort"))
  for found in list:lines() do
    local file = found:match "^%./(.*)$"
    local module = {path = "stdlib/" .. file, folder = file:match "^([^/]+)/", uses = {}}
    local name = file:gsub("%.lua$", ""):gsub("/init$", ""):gsub("/", ".")
    modules[#modules + 1], modules["clench." .. name] = module, module
  end
  list:close()
  return order, modules
end

-- modules named in the code of a file, in require, as a task of a thread, or as a function of clench; comments are ignored
local function find_uses(module, modules)
  local line = 0
  for text in (read(module.path) .. "\n"):gmatch "(.-)\r?\n" do
    line = line + 1
    for name in text:gsub("%-%-.*$", ""):gmatch "clench%.[%w_.]+" do
      -- clench.study.shake(...).survived: the longest prefix that is a module
      while name and not modules[name] do name = name:match "^(.+)%.[^.]*$" end
      if name and modules[name] ~= module then table.insert(module.uses, {modules[name], line, name}) end
    end
  end
end

--- A folder of stdlib may use itself, lower folders, and files directly in stdlib, which rank as high as the highest folder that they use.
local function check_stdlib(path)
  local order, modules = read_stdlib(path)
  for _, module in ipairs(modules) do
    find_uses(module, modules)
    if module.folder and not order[module.folder] then
      fault(module.path .. ":1", "folder '%s' of stdlib has no place in docs/architecture.md", module.folder)
    end
    module.level = module.folder and order[module.folder] or 0
  end
  -- raises the level of files directly in stdlib to that of everything they use
  repeat
    local changed = false
    for _, module in ipairs(modules) do
      for _, use in ipairs(module.folder and {} or module.uses) do
        if use[1].level > module.level then module.level, changed = use[1].level, true end
      end
    end
  until not changed
  for _, module in ipairs(modules) do
    for _, use in ipairs(module.folder and module.uses or {}) do
      local other, line, name = table.unpack(use)
      if other.level > module.level then
        fault(module.path .. ":" .. line, "folder %s of stdlib may not use %s: it lies higher", module.folder, name)
      end
    end
  end
end

-- the constant, type or alias that a line at file scope defines, or nil
local function local_name(text)
  local plain = text:gsub("^static%s+", ""):gsub("^inline%s+", "")
  local constant = plain:match "^constexpr%s+(.*)$" or plain:match "^const%s+(.*)$"
  if constant then return constant:match "([%w_]+)%s*%b[]%s*[={]" or constant:match "^[^=({]-([%w_]+)%s*[={]" end
  return defined_type(text) or text:match "^using%s+([%w_]+)%s*="
end

--- No two sources of a module define a constant, type or alias with the same name, except for equal aliases: unity builds compile sources together,
--- in groups that depend on their number.
local function check_local_names(sources)
  local first = {}
  for _, source in ipairs(sources) do
    if source.path:find "%.cpp$" then
      for line, text in ipairs(source.lines) do
        local name = local_name(text)
        local key = name and source.module .. " " .. name
        local other = first[key]
        if other and other.path ~= source.path and not (text:find "^using" and text == other.text) then
          fault(at(source, line), "'%s' is defined in src/%s as well; a unity build may compile both as one", name, other.path)
        elseif name and not other then
          first[key] = {path = source.path, text = text}
        end
      end
    end
  end
end

local modules, libraries = read_modules "docs/architecture.md", read_libraries "docs/architecture.md"
local sources = read_sources()
local subfolders = read_subfolders("docs/architecture.md", modules)
check_modules(sources, modules, subfolders)
check_links(sources, subfolders, "docs/architecture.md")
check_stdlib "docs/architecture.md"
check_cycles(sources)
check_types(sources)
check_local_names(sources)
local owners = owners_of_names(libraries)
for _, source in ipairs(sources) do check_libraries(source, libraries, owners, sources) end
for _, text in ipairs(faults) do print(text) end
print(("layers: %d files, %d faults"):format(#sources, #faults))
os.exit(#faults == 0 and 0 or 1)
