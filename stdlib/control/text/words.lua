--- The words of a line of the text protocol, read one by one. Invalid words raise {reply = text}.
local Words = {}
Words.__index = Words

function Words.fail(format, ...) error({reply = "Error: " .. format:format(...)}, 0) end

local function shown(word) return #word > 40 and word:sub(1, 40) .. "..." or word end

--- The next word; nil at the end.
function Words:next()
  self.at = self.at + 1
  return self[self.at]
end

function Words:peek() return self[self.at + 1] end

local function read(self, what, pattern)
  local word = self:next()
  if not word then Words.fail("%s: expected %s, got the end of the line", self.command, what) end
  local number = word:match(pattern) and tonumber(word)
  if not number or number - number ~= 0 then Words.fail("%s: expected %s, got %s", self.command, what, shown(word)) end
  return number
end

--- A finite number in decimal notation.
function Words:number(what) return read(self, what or "a number", "^[+-]?[%d.]+[eE]?[+-]?%d*$") end

--- An integer >= 0.
function Words:index(what)
  local number = math.tointeger(read(self, what or "an index", "^%d+$"))
  return number or Words.fail("%s: expected %s below 2^63", self.command, what or "an index")
end

--- A given number of numbers.
function Words:numbers(count, what)
  if count > #self - self.at then Words.fail("%s: expected %d numbers (%s), got %d", self.command, count, what, #self - self.at) end
  local list = {}
  for i = 1, count do list[i] = self:number() end
  return list
end

--- The number of DOFs of a robot, which a line must repeat.
function Words:dof_count(robot)
  local count = self:index "the number of DOFs"
  if count ~= #robot.dofs then Words.fail("robot has %d DOF.", #robot.dofs) end
  return count
end

--- A time > 0; the default if there are no more words, and one is given [s].
function Words:seconds(default)
  local seconds = default and not self:peek() and default or self:number "a time in seconds"
  if seconds <= 0 then Words.fail("%s: expected a time > 0 s, got %.9g", self.command, seconds) end
  return seconds
end

--- Rejects further words.
function Words:done()
  local word = self:next()
  if word then Words.fail("%s: one word too many: %s", self.command, shown(word)) end
end

---@param line string
return function(line)
  local words = setmetatable({at = 0}, Words)
  for word in line:gmatch "%S+" do words[#words + 1] = word end
  words.command = words[1] and shown(words[1])
  return words
end
