--- Finds requests whose id is null: decoded objects do not distinguish these from notifications, which have no id.

-- Does an object, without strings, have a null id of its own?
local function has_mark(object)
  if not object:find "N" then return false end
  return object:sub(2, -2):gsub("%b{}", ""):gsub("%b[]", ""):find "N" ~= nil
end

---@param line string  valid JSON: a request, or a batch
---@return table<integer, boolean> # by the number of the request in the batch; of a single request by 1
return function(line)
  local found = {}
  if not line:find '"id"%s*:%s*null' then return found end
  -- without strings all brackets and commas belong to the structure; N marks a null id
  local plain = line:gsub("\\.", "x"):gsub('"id"%s*:%s*null', "N"):gsub('"[^"]*"', "")
  local batch = plain:match "^%s*%[(.*)%]%s*$"
  if not batch then
    found[1] = has_mark(plain:match "^%s*(.-)%s*$") or nil
    return found
  end
  local number = 0
  local requests = batch:gsub("%b{}", function(object) return has_mark(object) and "N" or "" end):gsub("%b[]", "")
  for request in (requests .. ","):gmatch "([^,]*)," do
    number = number + 1
    found[number] = request:find "N" and true or nil
  end
  return found
end
