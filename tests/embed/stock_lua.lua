-- LUA_CPATH=build/release/?.so lua5.4 tests/embed/stock_lua.lua
local clench = require "clench"
assert(_G.clench == nil, "a module sets no global")
assert(clench.vec3(1, 2, 3) + {1, 1, 1} == clench.vec3(2, 3, 4))

-- errors of this Lua are longjmps: thousands of errors leak no C++ object, and the message is the same
for _ = 1, 10000 do
  local ok, message = pcall(function() return clench.pose {xyz = {1, 2}} end)
  assert(not ok and message:find("clench.pose: xyz: expected 3 numbers, got 2", 1, true), message)
end
local ok, message = pcall(function() return clench.psoe end)
assert(not ok and message:find("did you mean 'pose'?", 1, true))

-- the standard library is inside the module
assert(#clench.shapes.box {1, 2, 3}.triangles == 12)
assert(require "clench.shapes.box" == clench.shapes.box)
-- and is loaded from nowhere else, whatever files are nearby
local path = os.tmpname()
local file = assert(io.open(path, "w"))
file:write "error 'a file in place of ours'"
file:close()
package.path, package.cpath = path .. ";" .. package.path, path
assert(require "clench.shapes.sphere" == clench.shapes.sphere)
assert(not pcall(require, "clench.nothing") and select(2, pcall(require, "clench.nothing")):find "standard library")
package.loaded.clench = nil
assert(require "clench" == clench)
os.remove(path)
assert(clench.json.encode(clench.json.decode '{"b": [1, 2.5], "a": {}}') == '{"a":{},"b":[1,2.5]}')
assert(#clench.catalog().hands > 0, "the models are found from the module")
print("clench " .. clench.version .. " in " .. _VERSION)
