--- Records what a search by clench.plan.batch has tried, piece by piece, so that a later run of the same search continues where it ended
--- and finds the same grasps as one without a break. A file of JSON lines: a head, then for each piece the grasps that it found and a line
--- `{"search": ...}` that ends it.
local journal = {}

local format, version = "clench search", 1
local piece_mark = '{"search":'  -- how the line begins that ends a piece

local Journal = {}
Journal.__index = Journal

local function same(a, b) return clench.json.encode(a) == clench.json.encode(b) end

-- the grasp with the start in place of its pregrasp, which is written to the bit
local function carrying(grasp, start)
  local list = clench.grasps()
  list:add(grasp)
  local copy = list[1]
  copy.pregrasp = {pose = start.pose, dofs = start.dofs}
  return copy
end

--- The first line of the file.
---@param search table  what identifies the search, plain data
---@param count? integer  grasps that are searched for
function journal.head(search, count)
  return clench.json.encode {format = format, version = version, search = search, count = count} .. "\n"
end

--- The lines of a piece: `count` starts from number `first` on.
---@param result table  of clench.plan.batch_worker
function journal.lines(first, count, result)
  local lines, notes = {}, {}
  for i, new in ipairs(result.grasps) do
    local start = new.start
    lines[#lines + 1] = clench.json.encode(new.grasp)
    local pregrasp = new.grasp.pregrasp
    local moved = not (pregrasp and same(pregrasp, {pose = start.pose, dofs = start.dofs})) or nil
    if moved then lines[#lines + 1] = clench.json.encode(carrying(new.grasp, start)) end
    notes[i] = {number = new.number, retreat = start.retreat, reach = start.reach, is_near = start.is_near, moved = moved}
  end
  lines[#lines + 1] = clench.json.encode {search = {first = first, count = count, rejected = result.rejected,
                                                    best_load = result.best_load, found = notes}}
  return table.concat(lines, "\n") .. "\n"
end

local function decoded(line)
  local ok, value = pcall(clench.json.decode, line)
  return ok and type(value) == "table" and value or nil
end

-- the pieces up to the first line that is cut short or damaged, and the lines of all their grasps
local function read_pieces(text)
  local pieces, grasps, pending = {}, {}, {}
  for line in text:gmatch "([^\n]*)\n" do
    if line:sub(1, #piece_mark) == piece_mark then
      local value = decoded(line)
      local piece = value and value.search
      if type(piece) ~= "table" or type(piece.found) ~= "table" then break end
      local lines = 0
      for _, note in ipairs(piece.found) do lines = lines + (note.moved and 2 or 1) end
      if lines ~= #pending then break end
      pieces[#pieces + 1] = piece
      table.move(pending, 1, #pending, #grasps + 1, grasps)
      pending = {}
    else
      pending[#pending + 1] = line
    end
  end
  return pieces, grasps
end

-- grasps from their lines, by a list that is written and read
local function read_grasps(lines)
  local path = os.tmpname()
  local gone <close> = setmetatable({}, {__close = function() os.remove(path) end})
  clench.grasps():save(path, {format = "jsonl"})
  if #lines > 0 then clench.files.append_text(path, table.concat(lines, "\n")) end
  return clench.grasps(path, {format = "jsonl", confine = path:match "^(.*)/"})
end

local function restored(pieces, grasps)
  local known, at = {}, 0
  for _, piece in ipairs(pieces) do
    local list = {}
    for i, note in ipairs(piece.found) do
      at = at + 1
      local grasp = grasps[at]
      if note.moved then at = at + 1 end
      local before = grasps[at].pregrasp
      list[i] = {grasp = grasp, number = note.number, numbers = grasp.info,
                 start = {pose = before.pose, dofs = before.dofs, retreat = note.retreat, reach = note.reach, is_near = note.is_near}}
    end
    -- a piece may have been written twice when a signal came in between
    known[piece.first] = known[piece.first] or {count = piece.count, grasps = list, rejected = piece.rejected or {}, best_load = piece.best_load}
  end
  return known
end

--- The head of the file; nil: there is none, or it is no journal.
---@param path string
---@return {search: table, count?: integer}?
function journal.head_of(path)
  local file = io.open(path, "rb")
  if not file then return nil end
  local head = decoded(file:read "l" or "")
  file:close()
  return head and head.format == format and head.version == version and head or nil
end

--- What the file records.
---@param path string
---@return table<integer, table>? known  pieces by the number of their first start; nil: the file is damaged
---@return string? text  of these pieces, for a new file
function journal.read(path)
  local ok, known, text = pcall(function()
    local all = clench.files.read_text(path, {confine = path:match "^(.*)/" or "."})
    local pieces, grasps = read_pieces(all:match "^[^\n]*\n(.*)$" or "")
    local known = restored(pieces, read_grasps(grasps))
    local lines, first_of = {}, {}
    for first in pairs(known) do first_of[#first_of + 1] = first end
    table.sort(first_of)
    for i, first in ipairs(first_of) do lines[i] = journal.lines(first, known[first].count, known[first]) end
    return known, table.concat(lines)
  end)
  if ok then return known, text end
end

--- What clench.plan.batch is given.
---@param options {known?: table, write: fun(lines: string), is_ended: fun(): boolean, listed?: grasp[], keep?: integer}  known: of journal.read; write: stores a piece; is_ended: is the search to end? listed: grasps of the same search that need not be known; keep: at least so many grasps are kept
function journal.new(options)
  return setmetatable({known = options.known or {}, write = options.write, is_ended = options.is_ended, listed = options.listed or {},
                       keep = options.keep}, Journal)
end

function Journal:note(first, count, result) self.write(journal.lines(first, count, result)) end

--- Known pieces that were not taken, in order.
function Journal:rest()
  local rest = {}
  for first, known in pairs(self.known) do rest[#rest + 1] = {first = first, count = known.count, known = known} end
  table.sort(rest, function(a, b) return a.first < b.first end)
  return rest
end

--- Adds those of the listed grasps that were not found.
---@param found grasp[]
function Journal:add_listed(found)
  local numbers = {}
  for _, grasp in ipairs(found) do numbers[grasp.info.number] = true end
  for _, grasp in ipairs(self.listed) do
    local number = grasp.info.number
    if not number or not numbers[number] then found[#found + 1] = grasp end
    if number then numbers[number] = true end
  end
end

return journal
