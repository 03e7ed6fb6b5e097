--- Requests of HTTP/1.1 (RFC 9112), read strictly: a request that two readers could interpret differently is refused, as is one with a body.
local request = {}

request.max_head = 16384  -- [bytes]
local max_fields = 100

local token = "^[%w!#$%%&'*+.^_`|~-]+$"
-- fields that mean something here: a second one of the same name makes a request ambiguous
local single = {host = true, origin = true, upgrade = true, ["content-length"] = true, ["transfer-encoding"] = true,
                ["sec-websocket-key"] = true, ["sec-websocket-version"] = true}

local function fault(status, format, ...) return nil, status, format:format(...) end

local function read_fields(lines)
  local fields, count = {}, 0
  for i = 2, #lines do
    local name, value = lines[i]:match "^([^:]*):[ \t]*(.*)$"
    value = value and value:match "^(.*[^ \t])" or ""
    if not name or not name:find(token) then return fault(400, "line %d is no header field", i) end
    if value:find "[\0-\8\10-\31\127]" then return fault(400, "line %d has control characters", i) end
    name, count = name:lower(), count + 1
    if fields[name] and single[name] then return fault(400, "%s is given twice", name) end
    if count > max_fields then return fault(431, "there are more than %d header fields", max_fields) end
    fields[name] = fields[name] and fields[name] .. ", " .. value or value
  end
  return fields
end

-- the lines of a head; each ends in CR LF, and no other CR or LF is in it
local function lines_of(head)
  local lines = {}
  for line in (head .. "\r\n"):gmatch "(.-)\r\n" do
    if line:find "[\r\n%z]" then return fault(400, "a line ends in something else than CR LF") end
    lines[#lines + 1] = line
  end
  return lines
end

-- path and parameters of a target; escaped characters are not supported, since no page here needs them
local function read_target(target)
  local path, query = target:match "^(/[%w/._-]*)%??(.*)$"
  if not path then return fault(400, "the target is no path") end
  local parameters = {}
  for part in query:gmatch "[^&]+" do
    local name, value = part:match "^([^=]*)=?(.*)$"
    if parameters[name] then return fault(400, "the parameter '%s' is given twice", name:gsub("%W", "?")) end
    parameters[name] = value
  end
  return path, parameters
end

local function check(fields, method)
  if not fields.host then return fault(400, "there is no field Host") end
  if not fields.host:find "^[%w.-]+:?%d*$" and not fields.host:find "^%[[%x:.]+%]:?%d*$" then return fault(400, "Host: expected a name and a port") end
  if fields["transfer-encoding"] or (fields["content-length"] or "0") ~= "0" then return fault(400, "a request has no body here") end
  if method ~= "GET" then return fault(405, "only GET is served") end
  return true
end

--- Reads the head of a request, without the empty line that ends it.
---@param head string
---@return {path: string, parameters: table, fields: table}? request  names of fields in lower case
---@return integer? status  of the refusal
---@return string? reason
function request.read(head)
  local lines, status, reason = lines_of(head)
  if not lines then return nil, status, reason end
  local method, target, major, minor = lines[1]:match "^(%u+) ([!-~]+) HTTP/(%d)%.(%d)$"
  if not method then return fault(400, "the first line is no request of HTTP") end
  if major ~= "1" or minor ~= "1" then return fault(505, "only HTTP/1.1 is served") end
  local fields
  fields, status, reason = read_fields(lines)
  if not fields then return nil, status, reason end
  local ok
  ok, status, reason = check(fields, method)
  if not ok then return nil, status, reason end
  local path, parameters, why = read_target(target)
  if not path then return nil, parameters, why end
  return {path = path, parameters = parameters, fields = fields}
end

return request
