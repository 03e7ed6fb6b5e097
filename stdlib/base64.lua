-- stdlib/base64.lua
--- Encodes bytes as base64 (RFC 4648, section 4), for inline data of pages.
local letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/"

-- both letters for every 12 bits
local pair = {}
for n = 0, 4095 do
  local high, low = n // 64 + 1, n % 64 + 1
  pair[n] = letters:sub(high, high) .. letters:sub(low, low)
end

---@param bytes string
---@return string
return function(bytes)
  local out, count = {}, 0
  local byte = string.byte
  local whole = #bytes - #bytes % 3
  for i = 1, whole, 3 do
    local a, b, c = byte(bytes, i, i + 2)
    local n = a << 16 | b << 8 | c
    out[count + 1], out[count + 2] = pair[n >> 12], pair[n & 4095]
    count = count + 2
  end
  local a, b = byte(bytes, whole + 1, whole + 2)
  if b then
    local n = a << 16 | b << 8
    out[count + 1] = pair[n >> 12] .. pair[n & 4095]:sub(1, 1) .. "="
  elseif a then
    out[count + 1] = pair[a << 4] .. "=="
  end
  return table.concat(out)
end
