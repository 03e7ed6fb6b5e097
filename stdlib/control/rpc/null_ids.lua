--- Finds requests whose id is null: decoded objects do not distinguish these from notifications, which have no id.

-- the end of the string that begins at a quote
local function end_of_string(line, at)
  repeat
    at = line:find('["\\]', at + 1)
    local is_escape = at and line:byte(at) == 92
    if is_escape then at = at + 1 end
  until not is_escape
  return at or #line
end

---@param line string  valid JSON: a request, or a batch
---@return table<integer, boolean> # by the number of the request in the batch; of a single request by 1
return function(line)
  local found = {}
  if not line:find '"id"%s*:%s*null' then return found end
  local of_request = line:find "^%s*%[" and 2 or 1  -- depth of its fields
  local depth, number, at = 0, 1, 1
  while true do
    at = line:find('["{}%[%],]', at)
    if not at then return found end
    local c, last = line:sub(at, at), at
    if c == '"' then
      last = end_of_string(line, at)
      if depth == of_request and line:sub(at, last) == '"id"' and line:find("^%s*:%s*null", last + 1) then found[number] = true end
    elseif c == "," then
      if depth == of_request - 1 then number = number + 1 end
    else
      depth = depth + (c:find "[{%[]" and 1 or -1)
    end
    at = last + 1
  end
end
