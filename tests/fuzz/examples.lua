-- Statements of the API's fuzzer made from the examples of the API's pages: each runs in a separate environment, unchanged or with one part made
-- hostile. Examples name every argument, so they reach code that random arguments miss.
local here = debug.getinfo(1, "S").source:match "^@(.*/)" or ""
local stage = dofile(here .. "stage.lua")
local spoil = dofile(here .. "spoil.lua")
local doc = require "clench.host.doc"
local examples = {}

--- The steps of a doc's examples: {entry, keys, lines}; the last line gives the value.
---@param step table   of entries.lua
---@param text string  its doc
---@return table[]
function examples.steps(step, text)
  local steps, lines = {}, {}
  for _, example in ipairs(doc.parse(text).examples) do
    table.move(example.prepare, 1, #example.prepare, #lines + 1, lines)
    lines[#lines + 1] = example.code
    steps[#steps + 1] = {entry = step.entry, name = step.name, class = step.class, keys = step.keys, lines = table.move(lines, 1, #lines, 1, {})}
  end
  return steps
end

local function compiles(line) return load("return " .. line) or load(line) end

--- Source of a call that runs a step's lines.
---@param step table
---@param hostile? fun(part: string): string  replaces one part of one line
---@return string
function examples.source(step, hostile)
  local lines = table.move(step.lines, 1, #step.lines, 1, {})
  if hostile then
    local i = math.random(#lines)
    lines[i] = spoil(lines[i], hostile, compiles)
  end
  for i, line in ipairs(lines) do lines[i] = ("%q"):format(line):gsub("\\\n", "\\n") end
  return ("example(%s)"):format(table.concat(lines, ", "))
end

--- `example` of the statements: runs its lines in a fresh environment and returns the last one's value.
---@param globals table  globals in addition to those of the stage
function examples.runner(globals)
  return function(...)
    local env, value = stage(globals), nil
    for _, line in ipairs {...} do
      local chunk = load("return " .. line, "=fuzz", "t", env) or assert(load(line, "=fuzz", "t", env))
      value = chunk()
    end
    return value
  end
end

return examples
