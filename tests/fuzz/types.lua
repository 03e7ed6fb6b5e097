-- The type expressions of the API's docs, {x: number, y?: vec3[]}|"none", as trees:
-- {kind = "name", name}, {kind = "literal", text}, {kind = "list", of}, {kind = "record", fields}, {kind = "union", of}.
local parse_union

local function skip_blanks(s, at) return s:find("%S", at) or #s + 1 end

-- {name?: type, [integer]: type}
local function parse_record(s, at)
  local fields = {}
  at = skip_blanks(s, at + 1)
  while s:sub(at, at) ~= "}" and at <= #s do
    local name, optional, after = s:match("^([%w_]+)(%??):%s*()", at)
    if not name then after = s:match("^%[%w+%]:%s*()", at) or #s + 1 end
    local kind, stop = parse_union(s, after)
    fields[#fields + 1] = {name = name, optional = optional == "?", type = kind}
    at = skip_blanks(s, (s:match("^%s*,()", stop) or stop))
  end
  return {kind = "record", fields = fields}, at + 1
end

local function parse_one(s, at)
  local c = s:sub(at, at)
  if c == "{" then return parse_record(s, at) end
  if c == "(" then
    local kind, stop = parse_union(s, at + 1)
    return kind, stop + 1
  end
  local text, after = s:match('^"(.-)"()', at)
  if text then return {kind = "literal", text = text}, after end
  after = s:match("^fun(%b()):?%s*[%w|?]*()", at) and select(2, s:match("^fun(%b()):?%s*[%w|?]*()", at))
  if after then return {kind = "name", name = "function"}, after end
  local name, stop = s:match("^([%w_.]+)()", at)
  if name == "table" and s:sub(stop, stop) == "<" then
    local of, past = parse_union(s, s:match("^<[^,]*,%s*()", stop))
    return {kind = "map", of = of}, past + 1
  end
  return {kind = "name", name = name or "any"}, stop or #s + 1
end

local function parse_lists(s, at)
  local kind
  kind, at = parse_one(s, at)
  while s:sub(at, at + 1) == "[]" or s:sub(at, at) == "?" do
    if s:sub(at, at) == "?" then
      at = at + 1
    else
      kind, at = {kind = "list", of = kind}, at + 2
    end
  end
  return kind, at
end

function parse_union(s, at)
  local first, stop = parse_lists(s, at)
  local all = {first}
  while s:match("^%s*|", stop) do
    all[#all + 1], stop = parse_lists(s, s:match("^%s*|%s*()", stop))
  end
  return #all == 1 and first or {kind = "union", of = all}, stop
end

---@param text string
---@return table
return function(text) return (parse_union(text, 1)) end
