-- Holds scripts/packages.txt against the CMake files: every library that these ask for has its package listed, and
-- every library listed is asked for. What only tests/ asks for is listed for tests.
--   lua5.4 scripts/check_packages.lua [ROOT]
-- One sentence a fault, file:line first; exit code 1 when there is any.
local root = arg[1] or "."
local faults = {}

local function fault(path, line, text, ...)
  faults[#faults + 1] = ("%s:%d: %s"):format(path, line, text:format(...))
end

--- calls take(line number, text) for each line of a file that is not a comment
local function each_line(path, take)
  local file = assert(io.open(root .. "/" .. path), "no such file: " .. root .. "/" .. path)
  local number = 0
  for text in file:lines() do
    number = number + 1
    if not text:find "^%s*#" then take(number, text) end
  end
  file:close()
end

--- name that CMake asks for -> {purpose, package, line}
local function read_list(path)
  local listed, packages = {}, {}
  each_line(path, function(line, text)
    local purpose, package, asked = text:match "^(%S+)%s+(%S+)%s+(%S+)%s+%S"
    if purpose ~= "build" and purpose ~= "test" then
      fault(path, line, "wanted 'build' or 'test', a package, how CMake asks for it, what for; got '%s'", text)
    elseif packages[package] then
      fault(path, line, "package %s is listed twice", package)
    elseif asked ~= "-" then
      listed[asked] = {purpose = purpose, package = package, line = line}
    end
    if package then packages[package] = true end
  end)
  return listed
end

--- name -> {path, line} of the first find_package or pkg_check_modules that asks for it
local function read_requests(paths)
  local asked = {}
  for _, path in ipairs(paths) do
    each_line(path, function(line, text)
      local names = text:match "find_package%(([%w_]+)" or text:match "pkg_check_modules%([%w_]+ ([^)]*)%)"
      for name in (names or ""):gmatch "[%w_.+-]+" do
        local is_keyword = name == name:upper() and not name:find "%d"
        if not is_keyword and not asked[name] then asked[name] = {path = path, line = line} end
      end
    end)
  end
  return asked
end

--- CMakeLists.txt of the root, of src/, of tests/ and below, in this order
local function cmake_files()
  local quoted = "'" .. root:gsub("'", "'\\''") .. "'"
  local found = assert(io.popen("cd " .. quoted .. " && find src tests -name CMakeLists.txt -not -path 'tests/data/*' | LC_ALL=C sort"))
  local files = {"CMakeLists.txt"}
  for path in found:lines() do files[#files + 1] = path end
  found:close()
  return files
end

local list = "scripts/packages.txt"
local listed, asked = read_list(list), read_requests(cmake_files())
for name, request in pairs(asked) do
  local entry = listed[name]
  local only_tests = request.path:find "^tests/" ~= nil
  if not entry then
    fault(request.path, request.line, "%s is asked for, and no package of %s gives it", name, list)
  elseif only_tests ~= (entry.purpose == "test") then
    fault(list, entry.line, "%s is listed for '%s', and %s:%d asks for it", entry.package, entry.purpose,
          request.path, request.line)
  end
end
for name, entry in pairs(listed) do
  if not asked[name] then
    fault(list, entry.line, "%s is listed for %s, which no CMake file asks for", entry.package, name)
  end
end
table.sort(faults)
for _, text in ipairs(faults) do print(text) end
print(("packages: %d faults"):format(#faults))
os.exit(#faults == 0 and 0 or 1)
