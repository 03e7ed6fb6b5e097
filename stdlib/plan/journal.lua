--- Records the starts that a search by clench.plan.batch has tried, piece by piece, so that a later run of the same search continues after them and finds the
--- same grasps as an uninterrupted one. A file of JSON lines: a head, then for each piece the grasps that it found and a final line `{"search": ...}`.
local is_stopped = require "clench.is_stopped"
local journal = {}

local format, version = "clench search", 1
local piece_mark = '{"search":'  -- beginning of the line that ends a piece

local Journal = {}
Journal.__index = Journal

local function same(a, b) return clench.json.encode(a) == clench.json.encode(b) end

-- a copy of the grasp with the start as its pregrasp, which is stored bit-exactly
local function carrying(grasp, start)
  local list = clench.grasps()
  list:add(grasp)
  local copy = list[1]
  copy.pregrasp = {pose = start.pose, dofs = start.dofs}
  return copy
end

--- The first line of the file.
---@param search table  identity of the search, plain data
---@param count? integer  number of grasps searched for
function journal.head(search, count)
  return clench.json.encode {format = format, version = version, search = search, count = count} .. "\n"
end

--- The lines of a piece: `count` starts, the first of which has the number `first`.
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

-- the table in a line of JSON; nil: the line has none, or is damaged
local function decoded(line)
  local ok, value = pcall(clench.json.decode, line)
  if not ok and is_stopped(value) then error(value, 0) end
  return ok and type(value) == "table" and value or nil
end

local function is_count(value) return math.type(value) == "integer" and value >= 1 end
local function is_number_or_nil(value) return value == nil or type(value) == "number" end
local function is_boolean_or_nil(value) return value == nil or type(value) == "boolean" end

local function is_note(note)
  return type(note) == "table" and is_count(note.number) and is_number_or_nil(note.retreat) and is_number_or_nil(note.reach)
    and is_boolean_or_nil(note.is_near) and is_boolean_or_nil(note.moved)
end

-- Is this the valid end of a piece?
local function is_piece(piece)
  if type(piece) ~= "table" or not is_count(piece.first) or not is_count(piece.count) or not is_number_or_nil(piece.best_load) then return false end
  if type(piece.found) ~= "table" or type(piece.rejected) ~= "table" then return false end
  for why, count in pairs(piece.rejected) do
    if type(why) ~= "string" or type(count) ~= "number" then return false end
  end
  for i, note in pairs(piece.found) do
    if math.type(i) ~= "integer" or not is_note(note) then return false end
  end
  return true
end

-- The pieces before the first invalid one, and the lines of all their grasps. An incomplete last piece is not reported as damage.
---@return table[] pieces, string[] grasps, boolean is_damaged
local function read_pieces(text)
  local pieces, grasps, pending = {}, {}, {}
  for line in text:gmatch "([^\n]*)\n" do
    if line:sub(1, #piece_mark) == piece_mark then
      local value = decoded(line)
      local piece = value and value.search
      if not is_piece(piece) then return pieces, grasps, true end
      local lines = 0
      for _, note in ipairs(piece.found) do lines = lines + (note.moved and 2 or 1) end
      if lines ~= #pending then return pieces, grasps, true end
      pieces[#pieces + 1] = piece
      table.move(pending, 1, #pending, #grasps + 1, grasps)
      pending = {}
    else
      pending[#pending + 1] = line
    end
  end
  return pieces, grasps, false
end

-- The grasps of these lines, which are written to a temporary file and read as a list; nil: a line is damaged. Errors of the temporary file are raised.
local function read_grasps(lines)
  local path = os.tmpname()
  local gone <close> = setmetatable({}, {__close = function() os.remove(path) end})
  clench.grasps():save(path, {format = "jsonl"})
  if #lines > 0 then clench.files.append_text(path, table.concat(lines, "\n")) end
  local ok, list = pcall(clench.grasps, path, {format = "jsonl", confine = path:match "^(.*)/"})
  if ok then return #list == #lines and list or nil end
  local kind = type(list) == "table" and rawget(list, "kind")
  if kind == "file" or kind == "input" then return nil end
  error(list, 0)
end

-- the pieces by the number of their first start; nil: the start of a grasp is missing
local function restored(pieces, grasps)
  local known, at = {}, 0
  for _, piece in ipairs(pieces) do
    local list = {}
    for i, note in ipairs(piece.found) do
      at = at + 1
      local grasp = grasps[at]
      if note.moved then at = at + 1 end
      local before = grasps[at].pregrasp
      if not before then return nil end
      list[i] = {grasp = grasp, number = note.number, numbers = grasp.info,
                 start = {pose = before.pose, dofs = before.dofs, retreat = note.retreat, reach = note.reach, is_near = note.is_near}}
    end
    -- a piece is written twice if a signal interrupts its first note
    known[piece.first] = known[piece.first] or {count = piece.count, grasps = list, rejected = piece.rejected, best_load = piece.best_load}
  end
  return known
end

-- "No such file or directory"
local no_such_file = 2

local function refuse(path, why)
  -- the system's sentence may begin with the path
  if why:sub(1, #path + 2) == path .. ": " then why = why:sub(#path + 3) end
  error(("%s: the journal of the search cannot be read: %s"):format(path, why), 0)
end

-- the result of `file:read(amount)`; nil: the file does not exist. Raises an error if it exists and cannot be read.
local function read_file(path, amount)
  local file, why, code = io.open(path, "rb")
  if not file then
    if code == no_such_file then return nil end
    refuse(path, why)
  end
  local text, fault = file:read(amount)
  file:close()
  if fault then refuse(path, fault) end
  return text or ""
end

--- The head of a journal; nil: the file does not exist, or has no valid head. Raises an error if it cannot be read.
---@param path string
---@return {search: table, count?: integer}? head
---@return boolean? is_damaged  true: the file has another first line
function journal.head_of(path)
  local line = read_file(path, "l")
  if not line then return nil end
  local head = decoded(line)
  if head and head.format == format and head.version == version and type(head.search) == "table" then return head end
  return nil, line ~= ""
end

--- The pieces that a journal records. Raises an error if the file exists and cannot be read.
---@param path string
---@return table<integer, table>? known  pieces by the number of their first start; nil: the file does not exist, or its grasps are damaged
---@return string? text  of these pieces, for a new file
---@return boolean? is_damaged  true: pieces are lost
function journal.read(path)
  local all = read_file(path, "a")
  if not all then return nil end
  local pieces, lines_of_grasps, is_damaged = read_pieces(all:match "^[^\n]*\n(.*)$" or "")
  local grasps = read_grasps(lines_of_grasps)
  local known = grasps and restored(pieces, grasps)
  if not known then return nil, nil, true end
  local lines, first_of = {}, {}
  for first in pairs(known) do first_of[#first_of + 1] = first end
  table.sort(first_of)
  for i, first in ipairs(first_of) do lines[i] = journal.lines(first, known[first].count, known[first]) end
  return known, table.concat(lines), is_damaged
end

--- A journal for clench.plan.batch.
---@param options {known?: table, write: fun(lines: string), is_ended: fun(): boolean, listed?: grasp[], keep?: integer}  known: of journal.read; write: stores a piece; is_ended: returns true if the search must end; listed: grasps of the same search, with or without a record in the journal; keep: minimum number of grasps to keep
function journal.new(options)
  return setmetatable({known = options.known or {}, write = options.write, is_ended = options.is_ended, listed = options.listed or {},
                       keep = options.keep}, Journal)
end

function Journal:note(first, count, result) self.write(journal.lines(first, count, result)) end

--- Recorded pieces that were not taken, in order.
function Journal:rest()
  local rest = {}
  for first, known in pairs(self.known) do rest[#rest + 1] = {first = first, count = known.count, known = known} end
  table.sort(rest, function(a, b) return a.first < b.first end)
  return rest
end

--- Adds the listed grasps that were not found.
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
