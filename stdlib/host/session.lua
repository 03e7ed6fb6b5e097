--- The console's session: top-level locals persist from one input to the next, shared with the functions that use them.
local load, type, ipairs, unpack = load, type, ipairs, table.unpack
local find, match, sub, rep, concat = string.find, string.match, string.sub, string.rep, table.concat
local insert, remove = table.insert, table.remove
local getupvalue, upvaluejoin = debug.getupvalue, debug.upvaluejoin

local max_names = 150 -- a Lua function has at most 200 locals; the oldest are removed
local names = {} -- in order of declaration
local cells = {} -- for each name, a function that has it as an upvalue, and the number of the upvalue

-- calls visit(kind, text) for each name and mark of a chunk that has compiled
local function each_token(text, visit)
  local at = 1
  while at <= #text do
    local equals = match(text, "^%-%-%[(=*)%[", at) or match(text, "^%[(=*)%[", at)
    local quote = match(text, "^[\"']", at)
    local first, last = find(text, "^[%a_][%w_]*", at)
    if equals then
      _, at = find(text, "]" .. equals .. "]", at, true)
    elseif find(text, "^%-%-", at) then
      at = (find(text, "\n", at, true) or #text)
    elseif quote then
      repeat
        at = find(text, "[\\" .. quote .. "]", at + 1)
        local escaped = sub(text, at, at) == "\\"
        if escaped then at = at + 1 end
      until not escaped
    elseif first then
      visit("name", sub(text, first, last))
      at = last
    elseif not find(text, "^%s", at) then
      visit("mark", sub(text, at, at))
    end
    at = at + 1
  end
end

local change = {["do"] = 1, ["if"] = 1, ["function"] = 1, ["repeat"] = 1, ["end"] = -1, ["until"] = -1}

-- the locals that a chunk declares outside of all blocks
local function declared(text)
  local list, depth, state = {}, 0, nil
  each_token(text, function(kind, word)
    if state == "attribute" then
      -- variables that are closed at the end of their chunk are not kept
      if word == "close" then remove(list) end
      if word == ">" then state = "after" end
      return
    end
    if state == "names" and kind == "name" and word ~= "function" then
      list[#list + 1] = word
      state = "after"
    elseif state == "names" and word == "function" then
      depth, state = depth + 1, "function"
    elseif state == "function" then
      list[#list + 1] = word
      state = nil
    elseif state == "after" and (word == "," or word == "<") then
      state = word == "," and "names" or "attribute"
    else
      state = depth == 0 and word == "local" and "names" or nil
      depth = depth + (kind == "name" and change[word] or 0)
    end
  end)
  local kept, seen = {}, {_ENV = true}
  for i = #list, 1, -1 do
    if not seen[list[i]] then
      seen[list[i]] = true
      insert(kept, 1, list[i])
    end
  end
  return kept
end

local function cell_of(holder, name)
  for i = 1, 255 do
    local upvalue = getupvalue(holder, i)
    if upvalue == name then return {holder, i} end
    if not upvalue then return nil end
  end
end

-- the chunk as a function whose free names are the session's locals; nil and the reason if it does not compile
local function within(text, before)
  local head = #names > 0 and "local " .. concat(names, ",") .. " " or ""
  local make, message = load(before .. head .. "return function(...) " .. text .. "\nend", "=input", "t")
  if not make then return nil, message end
  local chunk = make()
  for _, name in ipairs(names) do
    local own = cell_of(chunk, name)
    if own then upvaluejoin(chunk, own[2], unpack(cells[name])) end
  end
  return chunk
end

local session = {}

--- Compiles the console's input, an expression, "=expression" or statements, to a function.
---@param input string
---@param line integer  number of its first line in messages
---@return function? chunk
---@return boolean|string  keeps: true if its result is an argument for `keep`; or the reason for the absence of a chunk
---@return boolean? incomplete  is the input incomplete?
function session.compile(input, line)
  -- leading newlines set the line number; the newline at the end terminates an open string
  local before = rep("\n", line - 1)
  local marked = sub(input, 1, 1) == "="
  local text = "return " .. (marked and sub(input, 2) or input) .. "\n"
  local ok, message = load(before .. text, "=input", "t")
  if ok then return within(text, before) or ok, false end
  if not marked then
    text = input .. "\n"
    ok, message = load(before .. text, "=input", "t")
  end
  if not ok then return nil, message, find(message, "<eof>$") ~= nil end
  local new = declared(text)
  local chunk = #new > 0 and within(text .. ";return function() return " .. concat(new, ",") .. " end", before)
  if chunk then
    session.new = new
    return chunk, true
  end
  return within(text, before) or ok, false
end

--- Keeps the locals that the last chunk has declared; not called after an error.
---@param holder function  result of the chunk
function session.keep(holder)
  local values = {holder()}
  for i, name in ipairs(session.new) do
    local value = values[i] -- of a constant, which no function has as an upvalue
    cells[name] = cell_of(holder, name) or {function() return value end, 1}
    for k, known in ipairs(names) do if known == name then remove(names, k) break end end
    names[#names + 1] = name
  end
  while #names > max_names do cells[remove(names, 1)] = nil end
end

--- Calls visit(name, value) for each local of the session.
function session.each(visit)
  for _, name in ipairs(names) do
    local _, value = getupvalue(unpack(cells[name]))
    visit(name, value)
  end
end

return session
