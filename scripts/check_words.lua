-- Checks comments, documentation and messages for words that the project does not use: British spelling, and phrases that are hard to read. Runs in a
-- stock interpreter:
--   lua5.4 scripts/check_words.lua [FOLDER...]
-- One line per occurrence, file:line first, with the replacement; exit code 1 if there is any.
local folders = #arg > 0 and arg or {"src", "stdlib", "docs", "tests", "examples", "scripts", "README.md", "CHANGELOG.md"}
local endings = {h = true, cpp = true, lua = true, md = true, txt = true, cmake = true}
local skipped = {"tests/data/", "docs/api/", "eigengrasps_test.cpp"}  -- unless given as arguments

-- words, as patterns of Lua in lower case, and their replacements
local words = {
  {"centre", "center"}, {"centring", "centering"}, {"colour", "color"}, {"neighbour", "neighbor"}, {"%f[%a]metres?%f[%A]", "meter"},
  {"millimetre", "millimeter"}, {"micrometre", "micrometer"}, {"centimetre", "centimeter"}, {"kilometre", "kilometer"},
  {"behaviour", "behavior"}, {"normalis", "normaliz"}, {"optimis", "optimiz"}, {"minimis", "minimiz"}, {"maximis", "maximiz"},
  {"recognis", "recogniz"}, {"initialis", "initializ"}, {"%f[%a]grey", "gray"}, {"modelled", "modeled"}, {"modelling", "modeling"},
  {"as long as that does it good", "while that reduces ..."}, {"%f[%a]gets on%f[%A]", "advances"}, {"a range that is none", "an empty range"},
  {"is no time beside", "is below the resolution of"}, {"what a search makes small", "objective function"}, {"one a dof", "one per DOF"},
  {"%f[%a]wanted [%w ]+, got", "expected ..., got"},
}

local faults = 0

local function is_skipped(path)
  for _, part in ipairs(skipped) do
    if path:find(part, 1, true) then return #arg == 0 end
  end
  return path:find("check_words", 1, true) ~= nil or path:find("checks_test", 1, true) ~= nil
end

local function check(path)
  if is_skipped(path) then return end
  local number = 0
  for line in io.lines(path) do
    number = number + 1
    local lower = line:lower()
    for _, word in ipairs(words) do
      local first, last = lower:find(word[1])
      if first then
        faults = faults + 1
        print(("%s:%d: '%s': write '%s'"):format(path, number, line:sub(first, last), word[2]))
      end
    end
  end
end

for _, folder in ipairs(folders) do
  if endings[folder:match "%.(%w+)$"] then
    check(folder)
  else
    local list <close> = assert(io.popen(("find '%s' -type f | LC_ALL=C sort"):format(folder)))
    for path in list:lines() do
      if endings[path:match "%.(%w+)$"] then check(path) end
    end
  end
end
print(("words: %d faults"):format(faults))
os.exit(faults == 0)
