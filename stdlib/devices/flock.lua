local class = require "clench.class"
local device = require "clench.devices.device"
local loop = clench.loop
local new_options = require "clench.options"

local subject = "devices.flock"
local Flock = class "flock"

local inch = 0.0254
local range = 36 * inch  -- of a full word of a position [m]

function Flock:__tostring() return ("Flock of %d birds at %s"):format(self.birds, self.port.name) end

local function address(bird) return string.char(0xF0 + bird) end

-- words of the record that begins at a byte, of which only the first byte has its high bit set; nil if it is damaged
local function parse(bytes, from, size)
  local words = {}
  for i = from, from + size - 1, 2 do
    local low, high = bytes:byte(i, i + 1)
    if low >= 0x80 ~= (i == from) or high >= 0x80 then return nil end
    local word = ((low << 1 & 0xFF) + 256 * high) << 1 & 0xFFFF
    words[#words + 1] = word >= 0x8000 and word - 0x10000 or word
  end
  return words
end

-- the first record among received bytes; if there is none, nil and the bytes that may begin one. Bytes before the beginning of a record are skipped
local function find_record(received, size)
  local at = received:find "[\x80-\xFF]"
  while at and #received - at + 1 >= size do
    local words = parse(received, at, size)
    if words then return words end
    at = received:find("[\x80-\xFF]", at + 1)
  end
  return nil, at and received:sub(at) or ""
end

-- the words of a record of a bird; nil and the reason if there is none
local function request(self, bird)
  local _ <close> = device.use(self)
  self.port:discard()
  local ok, why = self.port:write(address(bird) .. "B", self.timeout)
  if not ok then return nil, why end
  local last, received, words, more = loop.time() + self.timeout, "", nil, nil
  repeat
    local is_silent = not more
    more, why = self.port:read_some(math.max(0, last - loop.time()))
    if not more then return nil, why == "timeout" and not is_silent and "damaged" or why end
    words, received = find_record(received .. more, 2 * self.mode.words)
    if words then return words end
  until loop.time() > last + self.timeout  -- of a device that never pauses
  return nil, "damaged"
end

local function position_of(words) return {words[1] * range / 32768, words[2] * range / 32768, words[3] * range / 32768} end

local function dot(a, b) return a[1] * b[1] + a[2] * b[2] + a[3] * b[3] end

-- words 4 to 12 are the rows of the rotation; the 6 lowest bits of each have no meaning. nil: they are not a rotation
local function pose_of_matrix(words)
  local rows = {}
  for r = 1, 3 do
    local row = {}
    for c = 1, 3 do row[c] = (words[3 * r + c] & ~0x3F) / 32768 end
    if math.abs(math.sqrt(dot(row, row)) - 1) > 0.05 then return nil end
    for before = 1, r - 1 do
      if math.abs(dot(rows[before], row)) > 0.05 then return nil end
    end
    rows[r] = row
  end
  local function column(c) return {rows[1][c], rows[2][c], rows[3][c]} end
  return clench.pose {xyz = position_of(words), x_axis = column(1), z_axis = column(3)}
end

-- words 4 to 6 are turns about z, y and x
local function pose_of_angles(words)
  local function angle(word) return word * math.pi / 32768 end
  return clench.pose {xyz = position_of(words), rpy = {angle(words[6]), angle(words[5]), angle(words[4])}}
end

local modes = {matrix = {letter = "Z", words = 12, pose = pose_of_matrix}, angles = {letter = "Y", words = 6, pose = pose_of_angles}}

local function read_bird(self, bird)
  local doing = "bird " .. bird
  return device.ask(self, doing, function()
    local records = {}
    for i = 1, self.readings do records[i] = device.ask(self, doing, request, bird) end
    return self.mode.pose(device.median(records))
  end)
end

--- Poses of the birds in the frame of the transmitter.
---@return pose[]
function Flock:read()
  local poses = {}
  for bird = 1, self.birds do poses[bird] = read_bird(self, bird) end
  return poses
end

--- Closes the port.
function Flock:close() device.close(self) end

Flock.__close = function(self) self:close() end

local function write(self, bytes, doing)
  local ok, why = self.port:write(bytes, self.timeout)
  if not ok then device.fail(self, why, doing) end
end

local function configure(self)
  if self.birds > 1 then
    write(self, "P" .. string.char(50, self.birds), "configuration")
    loop.sleep(1)  -- the flock needs it to find all birds
  end
  for bird = 1, self.birds do write(self, address(bird) .. self.mode.letter, "mode") end
end

--- Driver of a Flock of Birds: 1 to 3 trackers on one bus.
---@param options table
---@option port string|port  path of its serial line, or a port
---@option birds? integer [1 to 3] = 1
---@option mode? "matrix"|"angles" = "matrix"  records of rotation matrices or of angles
---@option baud? integer [bit/s, 1 to 10000000] = 115200
---@option timeout? number [s, > 0, <= 3600] = 0.2  for a record
---@option attempts? integer [1 to 1000] = 20  maximum number of attempts to get a correct record; ten if the flock sends nothing
---@option readings? integer [1 to 99] = 1  records of which each word is the median: no checksum protects them
---@return flock flock # `read`, `close`
---@effect edits
--- > simulated = clench.devices.simulated.flock {poses = {clench.pose {xyz = {0.3, 0.1, 0.2}}}}
--- > flock = clench.devices.flock {port = simulated.path}
--- > pose = flock:read()[1]
--- > simulated:close()
--- > (pose.position - clench.vec3(0.3, 0.1, 0.2)):norm() < 3e-4  --> true
return function(options)
  local o = new_options(subject, options)
  local fields = {max_silent = 10, birds = o:get "birds", mode = modes[o:get "mode"], readings = o:get "readings"}
  local flock = setmetatable(device.new(subject, o, fields), Flock)
  configure(flock)
  return flock
end
