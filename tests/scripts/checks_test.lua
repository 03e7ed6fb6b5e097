-- The checks of scripts/ find every fault of the bad trees in tests/data, each in one sentence, and fail.
--   lua5.4 tests/scripts/checks_test.lua       from the project's root
local function run(command)
  local pipe = assert(io.popen(command))
  local text = pipe:read "a"
  local _, _, code = pipe:close()
  return text, code
end

local function fails_with(command, expected)
  local text, code = run(command)
  local lines = {}
  for line in text:gmatch "[^\n]+" do lines[#lines + 1] = line end
  for i = 1, math.max(#lines, #expected) do
    if lines[i] ~= expected[i] then
      error(("%s: line %d\nexpected: %s\ngot:    %s"):format(command, i, expected[i], lines[i]), 0)
    end
  end
  assert(code == 1, command .. ": expected exit code 1, got " .. tostring(code))
end

fails_with("lua5.4 scripts/check_layers.lua tests/data/layers/bad", {
  "docs/architecture.md:6: module 'twin' of rank 2 names 'high' of rank 2; a rank names lower ones only",
  "docs/architecture.md:7: module 'upside' names 'top', which has no row above",
  "docs/architecture.md:12: module 'nowhere' has subfolders and no row above",
  "src/high/attic/box.h:1: subfolder 'attic' of module 'high' has no place in docs/architecture.md",
  'src/high/cellar/stairs.h:2: subfolder cellar of high may not include "high/roof/tiles.h": it lies higher',
  'src/high/roof/tiles.h:2: subfolder roof of high may not include "high/tall.h": it lies higher',
  "src/lone/lone.cpp:1: module 'lone' has no row in docs/architecture.md",
  'src/low/upward.cpp:1: module low may not include "high/tall.h": its row names nothing',
  'src/low/upward.cpp:2: no such file: "second.h"; includes are named as "clench/module/file.h"',
  "src/high/cellar/stairs.h:4: subfolder cellar of high declares 'climb', which is defined higher, in src/high/roof/climb.cpp",
  "docs/architecture.md:21: high/tall.h does not declare 'nothing' for a higher subfolder",
  "stdlib/third/c.lua:1: folder 'third' of stdlib has no place in docs/architecture.md",
  "stdlib/first/a.lua:1: folder first of stdlib may not use clench.second.b: it lies higher",
  "src/low/first.h:3: cycle of includes: low/second -> low/first -> low/second",
  "src/low/hen.cpp:1: cycle of includes: low/egg -> low/hen -> low/egg",
  "src/low/types_again.h:6: type 'Twice' is defined in src/low/types.h as well",
  "src/low/hen.cpp:3: 'feathers' is defined in src/low/egg.cpp as well; a unity build may compile both as one",
  "src/high/tall.h:4: 'SoSeparator' belongs to Coin, which is seen only by low/inventor*.cpp",
  "src/low/upward.cpp:3: <lua.h> belongs to Lua, which is seen only by high",
  "layers: 16 files, 19 faults",
})

fails_with("lua5.4 scripts/check_packages.lua tests/data/packages/bad", {
  "scripts/packages.txt:3: package g++ is listed twice",
  "scripts/packages.txt:4: libfmt-dev is listed for 'build', and tests/CMakeLists.txt:1 asks for it",
  "scripts/packages.txt:5: doctest-dev is listed for 'test', and src/CMakeLists.txt:3 asks for it",
  "scripts/packages.txt:6: libold-dev is listed for old, which no CMake file asks for",
  "scripts/packages.txt:7: expected 'build', 'test' or 'bench', a package, how CMake asks for it, what for; "
    .. "got 'perhaps    libnew-dev    new     for nobody knows what'",
  "src/CMakeLists.txt:2: egl is asked for, and no package of scripts/packages.txt gives it",
  "packages: 6 faults",
})

fails_with("lua5.4 scripts/check_words.lua tests/data/words/bad", {
  "tests/data/words/bad/a.lua:1: 'centre': write 'center'",
  "tests/data/words/bad/a.lua:1: 'neighbour': write 'neighbor'",
  "tests/data/words/bad/a.lua:3: 'Wanted 3 numbers, got': write 'expected ..., got'",
  "words: 3 faults",
})

local text, code = run "lua5.4 scripts/check_layers.lua tests/data/layers/none 2>&1"
assert(code == 1 and text:find("no such file: tests/data/layers/none/docs/architecture.md", 1, true), text)
