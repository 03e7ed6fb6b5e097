--- A queue of items by time, earliest first; items with equal times in the order of their numbers. Adding and removing take logarithmic time.
local class = require "clench.class"

local Queue = class "time queue"

function Queue:__tostring() return ("time queue of %d"):format(#self.heap) end

local function comes_before(a, b) return a.at < b.at or a.at == b.at and a.number < b.number end

local function put(self, entry, place)
  self.heap[place] = entry
  self.places[entry.thing] = place
end

-- moves an entry from a place of the binary heap towards its root, while it precedes its parent
local function rise(self, entry, place)
  local heap = self.heap
  while place > 1 and comes_before(entry, heap[place // 2]) do
    put(self, heap[place // 2], place)
    place = place // 2
  end
  put(self, entry, place)
end

-- moves an entry from a place away from the root, while a child precedes it
local function sink(self, entry, place)
  local heap = self.heap
  while true do
    local child = 2 * place
    if child < #heap and comes_before(heap[child + 1], heap[child]) then child = child + 1 end
    if child > #heap or not comes_before(heap[child], entry) then break end
    put(self, heap[child], place)
    place = child
  end
  put(self, entry, place)
end

--- Adds an item that is not in the queue.
---@param thing any
---@param at number  its time
---@param number integer  its order among items with the same time
function Queue:add(thing, at, number) rise(self, {thing = thing, at = at, number = number}, #self.heap + 1) end

--- Removes an item, if it is in the queue.
function Queue:remove(thing)
  local heap, place = self.heap, self.places[thing]
  if not place then return end
  self.places[thing] = nil
  local last = table.remove(heap)
  if place > #heap then return end
  -- the last entry fills the gap
  rise(self, last, place)
  sink(self, last, self.places[last.thing])
end

--- The earliest time; nil if the queue is empty.
---@return number?
function Queue:first_time() return self.heap[1] and self.heap[1].at end

--- Removes and returns the first item if its time is at most `now`.
---@return any thing, number at  nil: no time has been reached
function Queue:take(now)
  local first = self.heap[1]
  if not first or first.at > now then return nil end
  self:remove(first.thing)
  return first.thing, first.at
end

return function() return setmetatable({heap = {}, places = {}}, Queue) end
