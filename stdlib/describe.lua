local descriptions = require "clench.signature.descriptions"
local packed_docs = require "clench.signature.packed_docs"
local described = require "clench.described"
local raise = require "clench.raise"
local suggest = require "clench.suggest"
local getupvalue, insert, ipairs, type = debug.getupvalue, table.insert, ipairs, type

-- name, doc, and function or closure id of every entry, in the order of the pages
local function list_entries()
  local all, list = clench.entries(), {}
  local function add(owner, mark, entries, kind)
    for _, entry in ipairs(entries) do
      insert(list, {name = owner .. mark .. entry.name, doc = entry.doc, id = entry.id, kind = kind, settable = entry.settable})
    end
  end
  for _, library in ipairs(all.libraries) do
    add(library.name, ".", library.fields, "field")
    add(library.name, ".", library.functions, "function")
  end
  for _, class in ipairs(all.classes) do
    add(class.variable, ".", class.fields, "field")
    add(class.variable, ":", class.methods, "method")
    add(class.variable, ".", class.operators, "operator")
  end
  for _, entry in ipairs(packed_docs.functions(all.files)) do
    insert(list, {name = "clench." .. entry.name, doc = entry.doc, fn = entry.fn, kind = "function"})
  end
  return list
end

local function describe(entry)
  local parsed = descriptions.parse(entry.doc)
  parsed.name, parsed.kind, parsed.unused = entry.name, entry.kind, nil
  -- getters and operators change nothing
  if entry.kind == "field" or entry.kind == "operator" then parsed.effect = parsed.effect or "reads" end
  if entry.kind == "field" then
    parsed.settable = entry.settable == true
    for key, value in pairs(parsed.type or {}) do
      -- the text of a field is its doc, followed by the prose of its @type line
      if key ~= "text" then parsed[key] = value elseif value ~= "" then parsed.text = parsed.text .. " " .. value end
    end
  end
  return parsed
end

local function is_entry(entry, x, id)
  if type(x) == "string" then return entry.name == x end
  return entry.fn == x or id ~= nil and entry.id == id
end

local function fail_unknown(x, list)
  if type(x) ~= "string" then raise("describe: this function is not an entry of clench; functions of scripts have no description") end
  local names = {}
  for i, entry in ipairs(list) do names[i] = entry.name end
  raise(("describe: there is no entry '%s'%s; names are as in clench.rad, hand:autograsp and hand.dofs"):format(x, suggest(x, names)))
end

--- Describes a function, method or field as data: `name`, `kind` ("function", "method", "field" or "operator"), `text`, `parameters`, `returns`, `examples`
--- ({prepare, code, result} each), and `effect`: "reads" (changes nothing), "edits" (changes a world or another value, or acts on a device), "files" (may
--- read or write files) or "long" (takes long, and can run as a job); `files` is true if it may read or write files beside another effect. A parameter has
--- `name`, `type`, `optional`, `text`, and if stated `unit`, `min`, `max` (`min_open`, `max_open`: the bound itself is excluded), `default` and `fields`, the
--- options of a table, described in the same form. A field has `type`, `unit` and `settable`.
---@param entry? function|string  the function or its name: "clench.rad", "hand:autograsp", "hand.dofs"; by default all entries are described
---@return table # one description, or a list of all
---@effect reads
--- > clench.describe(clench.rad).parameters[1].unit  --> degrees
--- > clench.describe("clench.plan.sample").parameters[1].fields[3].default  --> 100
--- > clench.describe(hand.autograsp).effect, clench.describe(clench.plan.sample).effect  --> edits, long
--- > clench.describe "clench.rda"  --> error: did you mean 'clench.rad'?
return function(entry)
  if entry ~= nil and type(entry) ~= "function" and type(entry) ~= "string" then
    raise(("describe: expected a function or the name of an entry, got %s"):format(described(entry)))
  end
  local list, found = list_entries(), {}
  local id
  if type(entry) == "function" then _, id = getupvalue(entry, 1) end
  for _, one in ipairs(list) do
    if entry == nil then insert(found, describe(one)) elseif is_entry(one, entry, id) then return describe(one) end
  end
  if entry ~= nil then fail_unknown(entry, list) end
  return found
end
