--- SHA-1 (FIPS 180-4), which the handshake of RFC 6455 asks for. It protects nothing there, and is used for nothing else.
local mask = 0xffffffff

local function rotated(x, n) return (x << n | x >> 32 - n) & mask end

-- function and constant of round t, from 0
local function round_of(t, b, c, d)
  if t < 20 then return b & c | ~b & d, 0x5a827999 end
  if t < 40 then return b ~ c ~ d, 0x6ed9eba1 end
  if t < 60 then return b & c | b & d | c & d, 0x8f1bbcdc end
  return b ~ c ~ d, 0xca62c1d6
end

-- the words of a block, extended to 80
local function words_of(block)
  local w = {string.unpack((">I4"):rep(16), block)}
  for t = 17, 80 do w[t] = rotated(w[t - 3] ~ w[t - 8] ~ w[t - 14] ~ w[t - 16], 1) end
  return w
end

local function add_block(h, block)
  local w = words_of(block)
  local a, b, c, d, e = table.unpack(h)
  for t = 0, 79 do
    local f, k = round_of(t, b, c, d)
    a, b, c, d, e = (rotated(a, 5) + (f & mask) + e + k + w[t + 1]) & mask, a, rotated(b, 30), c, d
  end
  for i, x in ipairs {a, b, c, d, e} do h[i] = (h[i] + x) & mask end
end

--- The digest of some bytes, as 20 bytes.
---@param bytes string
---@return string
return function(bytes)
  local padded = bytes .. "\x80" .. ("\0"):rep((55 - #bytes) % 64) .. (">I8"):pack(8 * #bytes)
  local h = {0x67452301, 0xefcdab89, 0x98badcfe, 0x10325476, 0xc3d2e1f0}
  for at = 1, #padded, 64 do add_block(h, padded:sub(at, at + 63)) end
  return (">I4I4I4I4I4"):pack(table.unpack(h))
end
