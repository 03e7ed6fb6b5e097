-- Reads PNG files of 8 bits per channel without alpha, and writes them uncompressed: a second implementation, for comparisons of pictures in tests.
local png = {}

local function reader(data)
  local at, bits, count = 1, 0, 0
  local self = {}
  function self.take(n)
    while count < n do
      bits = bits | data:byte(at) << count
      at, count = at + 1, count + 8
    end
    local value = bits & (1 << n) - 1
    bits, count = bits >> n, count - n
    return value
  end
  function self.align() bits, count = bits >> (count & 7), count - (count & 7) end
  return self
end

-- the Huffman code of lengths of symbols (RFC 1951, 3.2.2): symbols by length and code
local function code_of(lengths, count)
  local by_length, next_code, code = {}, {}, 0
  for length = 1, 15 do by_length[length], next_code[length] = {}, 0 end
  local many = {}
  for symbol = 0, count - 1 do many[lengths[symbol] or 0] = (many[lengths[symbol] or 0] or 0) + 1 end
  for length = 1, 15 do
    code = (code + (length > 1 and many[length - 1] or 0)) << 1
    next_code[length] = code
  end
  for symbol = 0, count - 1 do
    local length = lengths[symbol] or 0
    if length > 0 then
      by_length[length][next_code[length]] = symbol
      next_code[length] = next_code[length] + 1
    end
  end
  return by_length
end

local function symbol_of(input, code)
  local bits = 0
  for length = 1, 15 do
    bits = bits << 1 | input.take(1)
    local symbol = code[length][bits]
    if symbol then return symbol end
  end
  error "png: invalid code"
end

local function fixed_codes()
  local lengths, far = {}, {}
  for i = 0, 287 do lengths[i] = i < 144 and 8 or i < 256 and 9 or i < 280 and 7 or 8 end
  for i = 0, 29 do far[i] = 5 end
  return code_of(lengths, 288), code_of(far, 30)
end

local order = {16, 17, 18, 0, 8, 7, 9, 6, 10, 5, 11, 4, 12, 3, 13, 2, 14, 1, 15}

local function dynamic_codes(input)
  local near, far, count = input.take(5) + 257, input.take(5) + 1, input.take(4) + 4
  local lengths, all, n = {}, {}, 0
  for i = 1, count do lengths[order[i]] = input.take(3) end
  local code = code_of(lengths, 19)
  while n < near + far do
    local symbol = symbol_of(input, code)
    local value, times = symbol, 1
    if symbol == 16 then value, times = all[n - 1], input.take(2) + 3 end
    if symbol == 17 then value, times = 0, input.take(3) + 3 end
    if symbol == 18 then value, times = 0, input.take(7) + 11 end
    for _ = 1, times do all[n], n = value, n + 1 end
  end
  return code_of(all, near), code_of(table.move(all, near, near + far - 1, 0, {}), far)
end

local function base_and_extra(symbol, first, step)
  local base, extra = first, 0
  for i = 0, symbol - 1 do base = base + (1 << math.max(0, i // step - 1)) end
  extra = math.max(0, symbol // step - 1)
  return base, extra
end

-- RFC 1951
local function inflate(data)
  local input, out = reader(data), {}
  repeat
    local is_last, kind = input.take(1), input.take(2)
    if kind == 0 then
      input.align()
      local length = input.take(16)
      input.take(16)
      for _ = 1, length do out[#out + 1] = input.take(8) end
    else
      local near, far
      if kind == 1 then near, far = fixed_codes() else near, far = dynamic_codes(input) end
      local symbol = symbol_of(input, near)
      while symbol ~= 256 do
        if symbol < 256 then
          out[#out + 1] = symbol
        else
          local length, extra = base_and_extra(symbol - 257, 3, 4)
          length = symbol == 285 and 258 or length + input.take(extra)
          local distance, more = base_and_extra(symbol_of(input, far), 1, 2)
          distance = distance + input.take(more)
          for _ = 1, length do out[#out + 1] = out[#out + 1 - distance] end
        end
        symbol = symbol_of(input, near)
      end
    end
  until is_last == 1
  return out
end

local function nearest(a, b, c)
  local p = a + b - c
  local pa, pb, pc = math.abs(p - a), math.abs(p - b), math.abs(p - c)
  return pa <= pb and pa <= pc and a or pb <= pc and b or c
end

-- undoes the filters of rows
local function unfiltered(bytes, width, height)
  local row, above, at = 3 * width, nil, 1
  local rows = {}
  for y = 1, height do
    local filter, line = bytes[at], {}
    for i = 1, row do
      local a, b, c = line[i - 3] or 0, above and above[i] or 0, above and above[i - 3] or 0
      local guess = filter == 1 and a or filter == 2 and b or filter == 3 and (a + b) // 2 or filter == 4 and nearest(a, b, c) or 0
      line[i] = (bytes[at + i] + guess) & 255
    end
    rows[y], above, at = line, line, at + row + 1
  end
  return rows
end

--- The picture of a file.
---@return {width: integer, height: integer, rows: integer[][]}  of each row the bytes red, green, blue of each pixel
function png.read(path)
  local file <close> = assert(io.open(path, "rb"))
  local data, at, parts = file:read "a", 9, {}
  local width, height = string.unpack(">I4I4", data, 17)
  assert(data:byte(25) == 8 and data:byte(26) == 2 and data:byte(29) == 0, path .. ": expected 8 bits each of red, green and blue")
  while at < #data do
    local length, name = string.unpack(">I4c4", data, at)
    if name == "IDAT" then parts[#parts + 1] = data:sub(at + 8, at + 7 + length) end
    at = at + 12 + length
  end
  return {width = width, height = height, rows = unfiltered(inflate(table.concat(parts):sub(3)), width, height)}
end

local function crc(text)
  local sum = 0xffffffff
  for i = 1, #text do
    sum = sum ~ text:byte(i)
    for _ = 1, 8 do sum = sum >> 1 ~ (sum & 1 == 1 and 0xedb88320 or 0) end
  end
  return sum ~ 0xffffffff
end

local function adler(text)
  local a, b = 1, 0
  for i = 1, #text do
    a = (a + text:byte(i)) % 65521
    b = (b + a) % 65521
  end
  return b << 16 | a
end

--- Writes a picture.
function png.write(path, picture)
  local lines, stored = {}, {"\x78\x01"}
  for y, row in ipairs(picture.rows) do
    for x = 1, #row, 3000 do lines[#lines + 1] = (x == 1 and "\0" or "") .. string.char(table.unpack(row, x, math.min(#row, x + 2999))) end
    assert(#row == 3 * picture.width, "row " .. y)
  end
  local text = table.concat(lines)
  for i = 1, #text, 65535 do
    local part = text:sub(i, i + 65534)
    stored[#stored + 1] = string.pack("<BI2I2", i + 65535 > #text and 1 or 0, #part, ~#part & 0xffff) .. part
  end
  stored[#stored + 1] = string.pack(">I4", adler(text))
  local file <close> = assert(io.open(path, "wb"))
  file:write "\x89PNG\r\n\x1a\n"
  for _, chunk in ipairs {{"IHDR", string.pack(">I4I4BBBBB", picture.width, picture.height, 8, 2, 0, 0, 0)}, {"IDAT", table.concat(stored)}, {"IEND", ""}} do
    file:write(string.pack(">I4", #chunk[2]), chunk[1], chunk[2], string.pack(">I4", crc(chunk[1] .. chunk[2])))
  end
end

--- The pixels in which two pictures of one size differ, black on white, and their number.
---@return table picture, integer count
function png.difference(a, b)
  local rows, count = {}, 0
  for y = 1, a.height do
    local row, one, other = {}, a.rows[y], b.rows[y]
    for i = 1, 3 * a.width, 3 do
      local same = one[i] == other[i] and one[i + 1] == other[i + 1] and one[i + 2] == other[i + 2]
      row[i], row[i + 1], row[i + 2] = same and 255 or 0, same and 255 or 0, same and 255 or 0
      count = count + (same and 0 or 1)
    end
    rows[y] = row
  end
  return {width = a.width, height = a.height, rows = rows}, count
end

return png
