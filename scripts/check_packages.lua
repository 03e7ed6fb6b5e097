-- Checks scripts/packages.txt against the CMake files: every library that these request has its package listed, and every listed library is
-- requested. Libraries that only tests/ requests are listed for test or bench.
--   lua5.4 scripts/check_packages.lua [ROOT]
-- One sentence per fault, file:line first; exit code 1 if there is any.
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

--- packages in the order of the list: {purpose, package, asked = names that CMake requests, line}
local function read_list(path)
  local packages, seen = {}, {}
  each_line(path, function(line, text)
    local purpose, package, asked = text:match "^(%S+)%s+(%S+)%s+(%S+)%s+%S"
    if purpose ~= "build" and purpose ~= "test" and purpose ~= "bench" then
      fault(path, line, "expected 'build', 'test' or 'bench', a package, how CMake asks for it, what for; got '%s'", text)
    elseif seen[package] then
      fault(path, line, "package %s is listed twice", package)
    else
      local entry = {purpose = purpose, package = package, asked = {}, line = line}
      for name in asked:gmatch "[^,]+" do entry.asked[#entry.asked + 1] = name ~= "-" and name or nil end
      packages[#packages + 1] = entry
      seen[package] = true
    end
  end)
  return packages
end

--- name -> {path, line} of the first find_package or pkg_check_modules that requests it
local function read_requests(paths)
  local asked = {}
  for _, path in ipairs(paths) do
    each_line(path, function(line, text)
      local package = text:match "find_package%(([%w_]+)"
      local names = package or text:match "pkg_check_modules%([%w_]+ ([^)]*)%)"
      for name in (names or ""):gmatch "[%w_.+-]+" do
        local is_keyword = not package and name == name:upper() and not name:find "%d"
        if not is_keyword and not asked[name] then asked[name] = {path = path, line = line} end
      end
    end)
  end
  return asked
end

--- the CMake files: the root's, those of src/, those of tests/ and below, in this order
local function cmake_files()
  local quoted = "'" .. root:gsub("'", "'\\''") .. "'"
  local expected = "\\( -name CMakeLists.txt -o -name '*.cmake' \\) -not -path 'tests/data/*'"
  local found = assert(io.popen(("cd %s && find src tests %s | LC_ALL=C sort"):format(quoted, expected)))
  local files = {"CMakeLists.txt"}
  for path in found:lines() do files[#files + 1] = path end
  found:close()
  return files
end

local list = "scripts/packages.txt"
local packages, requests = read_list(list), read_requests(cmake_files())
requests.clench = nil  -- Clench itself, which the embedding test requests
for _, entry in ipairs(packages) do
  local first  -- a request outside of tests/, else any request
  for _, name in ipairs(entry.asked) do
    local request = requests[name]
    if not request then
      fault(list, entry.line, "%s is listed for %s, which no CMake file asks for", entry.package, name)
    elseif not first or first.path:find "^tests/" then
      first = request
    end
    requests[name] = nil
  end
  if first and (first.path:find "^tests/" ~= nil) ~= (entry.purpose ~= "build") then
    fault(list, entry.line, "%s is listed for '%s', and %s:%d asks for it", entry.package, entry.purpose,
          first.path, first.line)
  end
end
for name, request in pairs(requests) do
  fault(request.path, request.line, "%s is asked for, and no package of %s gives it", name, list)
end
table.sort(faults)
for _, text in ipairs(faults) do print(text) end
print(("packages: %d faults"):format(#faults))
os.exit(#faults == 0 and 0 or 1)
