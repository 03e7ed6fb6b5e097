-- Every binding is documented, and every example on its page runs and prints the result on the page.
local test, doc, show = require "test", require "clench.host.doc", require "clench.show"
local packed_docs = require "clench.signature.packed_docs"

-- files that examples write are removed with the temporary files of tests
os.tmpname = test.path

local stage = dofile "tests/fuzz/stage.lua"

-- results as shown by the console, or "error: message"
local function result_of(code, env)
  local chunk, message = load("return " .. code, "=example", "t", env)
  if not chunk then chunk, message = load(code, "=example", "t", env) end
  if not chunk then return "error: " .. message end
  local results = table.pack(pcall(chunk))
  if not results[1] then return "error: " .. tostring(results[2]) end
  for i = 2, results.n do results[i] = show(results[i]) end
  return table.concat(results, ", ", 2, results.n)
end

local function check(subject, entry)
  test(subject .. " is documented and its examples are true", function(t)
    local parsed = doc.parse(entry.doc)
    t.ok(parsed.text ~= "", "expected a sentence of doc, got none")
    t.ok(#parsed.examples > 0, "expected a running example, got none")
    t.ok(parsed.unused == 0, "expected a result after the last line of code, got none")
    local env = stage(_G)
    for _, example in ipairs(parsed.examples) do
      for _, code in ipairs(example.prepare) do assert(load(code, "=example", "t", env))() end
      local got, want = result_of(example.code, env), example.result
      local expected_error = want:match "^error: (.*)$"
      local ok = got == want or expected_error and got:sub(1, 7) == "error: " and got:find(expected_error, 1, true)
      t.ok(ok, ("> %s\nexpected %s\ngot    %s"):format(example.code, want, got))
    end
  end)
end

local all = clench.entries()
for _, library in ipairs(all.libraries) do
  for _, kind in ipairs {"fields", "functions"} do
    for _, entry in ipairs(library[kind]) do check(library.name .. "." .. entry.name, entry) end
  end
end
for _, class in ipairs(all.classes) do
  test("class " .. class.name .. " is documented", function(t) t.ok(class.doc ~= "") end)
  for _, entry in ipairs(class.fields) do
    check(class.variable .. "." .. entry.name, entry)
    test(class.variable .. "." .. entry.name .. " has a type", function(t) t.ok(doc.parse(entry.doc).type) end)
  end
  for _, entry in ipairs(class.methods) do check(class.variable .. ":" .. entry.name, entry) end
end

for _, entry in ipairs(packed_docs.functions(all.files)) do
  -- most of the standard library has its examples in the guide instead
  if #doc.parse(entry.doc).examples > 0 then check("clench." .. entry.name, entry) end
end

test("every function of clench is in the tables", function(t)
  local known = {}
  for _, library in ipairs(all.libraries) do
    for _, entry in ipairs(library.functions) do known[library.name .. "." .. entry.name] = true end
  end
  for name, value in next, clench do
    if type(value) == "function" then t.ok(known["clench." .. name], "clench." .. name .. " is in no table") end
  end
end)
