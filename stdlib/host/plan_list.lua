--- The lists that `clench plan -o` writes: the main list, which is the first one of JSON lines or else the first one, and copies of it in other formats. Grasps
--- are appended as they are found; at the end the list is replaced by the best grasps, best first.
--- Until the search is complete, a list of JSON lines is accompanied by the journal of its search, which --resume reads.
local error_text = require "clench.error_text"
local identity = require "clench.host.plan_identity"
local is_stopped = require "clench.is_stopped"
local journal = require "clench.plan.journal"
local fail = require "clench.host.usage"

local List = {}
List.__index = List

local function refuse(text, ...) error(text:format(...), 0) end

local function folder_of(path)
  local folder = path:match "^(.*)/"
  return folder == "" and "/" or folder or "."
end

-- does the extension of a name determine the format?
local function has_known_ending(path)
  local ending = path:match "[^/](%.[^./]*)$"
  return ending ~= nil and pcall(function() return clench.grasps():check_save("list" .. ending) end)
end

-- The format of a list. With several lists, --format applies only to names whose extension does not determine it.
local function format_of(path, given)
  local said = given.format
  if said and #given.o > 1 and has_known_ending(path) then said = nil end
  local ok, format = pcall(function() return clench.grasps():check_save(path, {format = said}) end)
  if not ok and format.kind == "input" then fail("-o: %s", format.sentence) end
  if not ok then error(format, 0) end
  -- /dev/stdout may be a link to a file, which the list would replace under another name
  if path:find "^/dev/" then refuse("-o: %s: expected a file to write, got a special file", path) end
  return {path = path, format = format, given_format = said}
end

-- the path without its parts "." and its doubled slashes
local function without_dots(path)
  local parts = {}
  for part in path:gmatch "[^/]+" do
    if part ~= "." then parts[#parts + 1] = part end
  end
  return (path:find "^/" and "/" or "") .. table.concat(parts, "/")
end

-- all lists, first the one that is written during the search
local function lists_of(given)
  local lists, known = {}, {}
  for i, path in ipairs(given.o) do
    local plain = without_dots(path)
    if known[plain] then fail("-o: %s is given twice", path) end
    known[plain] = true
    lists[i] = format_of(path, given)
  end
  for i, list in ipairs(lists) do
    if list.format == "jsonl" then
      table.insert(lists, 1, table.remove(lists, i))
      break
    end
  end
  return lists
end

--- Checks the options and the files on the disk, without changing anything. Returns nil without -o.
---@param given {o: string[], format?: string, overwrite?: string, resume?: string}
function List.check(given)
  local is_without = #given.o == 0
  if given.format and is_without then fail "--format requires -o FILE" end
  for _, name in ipairs {"overwrite", "resume"} do
    if given[name] and is_without then fail("--%s requires -o FILE", name) end
  end
  if given.overwrite and given.resume then fail "expected --overwrite or --resume, got both" end
  if is_without then return nil end
  local lists = lists_of(given)
  local main = table.remove(lists, 1)
  local format = main.format
  local self = setmetatable({path = main.path, given_format = main.given_format, copies = lists, is_overwriting = given.overwrite ~= nil,
                             is_resuming = given.resume ~= nil, kept = clench.grasps(), known = {}, pending = ""}, List)
  self.format, self.journal_path = format, self.path .. ".search"
  if self.is_resuming and format ~= "jsonl" then
    fail("--resume: expected a list of JSON lines, -o FILE.jsonl, got '%s'", self.path)
  end
  if format == "jsonl" then clench.files.check_writable(self.journal_path) end
  return self
end

local function first_line(path)
  local file = io.open(path, "rb")
  if not file then return nil end
  local line = file:read "l"
  file:close()
  return line
end

-- the first line as a table, and true if more follows; nil: the file does not exist or is empty
local function look_at(path)
  local file, why, code = io.open(path, "rb")
  if not file then
    if code == 2 then return nil end
    refuse("-o: %s", why)
  end
  local line = file:read "l"
  local has_more = file:read(0) ~= nil
  file:close()
  if not line then return nil end
  local ok, head = pcall(clench.json.decode, line)
  if not ok and is_stopped(head) then error(head, 0) end
  return ok and type(head) == "table" and head.format == "clench grasps" and head or {}, has_more
end

local function search_in(head) return type(head.notes) == "table" and type(head.notes.search) == "table" and head.notes.search or nil end

-- an existing list is replaced only with --overwrite
function List:refuse_to_replace(head, has_grasps)
  if not head.format then refuse("-o: %s exists already; --overwrite replaces it", self.path) end
  if not has_grasps then return end
  local there = search_in(head)
  if not there then refuse("-o: %s exists already and does not identify its search; --overwrite replaces it", self.path) end
  local difference = identity.difference(there, self.search)
  if difference then refuse("-o: %s is the list of another search: %s; --overwrite replaces it", self.path, difference) end
  refuse("-o: %s is the list of this search: --resume continues it, --overwrite restarts it", self.path)
end

function List:check_same(path, there)
  if not there then refuse("--resume: %s does not identify its search; --overwrite replaces it", path) end
  local difference = identity.difference(there, self.search)
  if difference then refuse("--resume: %s is of another search: %s", path, difference) end
end

-- Reads the journal, if it exists. Raises an error if it cannot be read.
function List:read_journal()
  local head, is_damaged = journal.head_of(self.journal_path)
  self.is_journal_damaged = is_damaged
  if not head then return end
  self:check_same(self.journal_path, head.search)
  local known, text
  known, text, self.is_journal_damaged = journal.read(self.journal_path)
  if not known then return end
  self.known, self.pending, self.has_journal = known, text, true
  self.earlier_count = math.max(self.earlier_count or 0, math.tointeger(head.count) or 0)
end

function List:resume(head)
  if head then
    self:check_same(self.path, search_in(head))
    self.kept = clench.grasps(self.path, {format = "jsonl", confine = folder_of(self.path)})
    local there = search_in(head)
    self.earlier_count = math.tointeger(there.count)
    if there.complete ~= nil then self.earlier_count = math.max(self.earlier_count or 0, #self.kept) end
    if not self.count then self.count = math.tointeger(there.count) end
    self.is_complete = there.complete == true and (self.count or 0) <= (math.tointeger(there.count) or -1)
    if self.is_complete then return end
  end
  self:read_journal()
  if not self.count then self.count = self.earlier_count end
  if #self.kept > 0 and not self.has_journal then
    io.stderr:write(("clench plan: without %s the search starts again; the grasps of %s are kept\n"):format(self.journal_path, self.path))
  end
end

--- Compares the search with that of a list on the disk, without changing anything.
---@param search table  of plan_identity
---@param count? integer  number of grasps searched for; nil: the number of the list that is continued
function List:compare(search, count)
  self.search, self.count = search, count
  for _, copy in ipairs(self.copies) do
    if not self.is_overwriting and not self.is_resuming and look_at(copy.path) then
      refuse("-o: %s exists already; --overwrite replaces it", copy.path)
    end
  end
  local head, has_more = look_at(self.path)
  self.first_line = first_line(self.path)
  self.is_replacing = self.is_overwriting and head ~= nil
  if self.is_overwriting then return end
  if self.format ~= "jsonl" then
    if head then refuse("-o: %s exists already; --overwrite replaces it", self.path) end
  elseif self.is_resuming then
    if head and not head.format then refuse("--resume: %s is not a list of grasps", self.path) end
    self:resume(head)
  elseif head then
    self:refuse_to_replace(head, has_more)
  end
end

function List:notes(more)
  local search = {}
  for _, from in ipairs {self.search, {count = self.count}, more or {}} do
    for key, value in pairs(from) do search[key] = value end
  end
  return {search = search}
end

-- Raises an error if another program has replaced the list. A removed list is written again at the end.
function List:check_ours()
  local line = first_line(self.path)
  if line and line ~= self.first_line then refuse("%s was replaced by another program: it is not written", self.path) end
  return line ~= nil
end

-- renames a damaged journal
function List:put_aside_journal()
  if not self.is_journal_damaged then return end
  local aside = self.path .. ".search.damaged"
  local ok, why = os.rename(self.journal_path, aside)
  if not ok then refuse("%s is damaged and cannot be renamed to %s: %s", self.journal_path, aside, why) end
  self.is_journal_damaged = nil
  io.stderr:write(("clench plan: warning: %s is damaged; it is renamed to %s, and the lost part is searched again\n"):format(
    self.journal_path, aside))
end

-- Starts storing grasps and pieces in files, which replace older ones.
function List:start()
  self:check_ours()
  self.started = true
  self.kept:save(self.path, {format = "jsonl", notes = self:notes()})
  self.first_line = first_line(self.path)
  self:put_aside_journal()
  clench.files.save_text(self.journal_path, journal.head(self.search, self.keep) .. self.pending)
  self.pending = nil
end

-- after the first error nothing more is written, and the search ends
function List:try(write)
  if self.fault then return end
  local ok, problem = pcall(write)
  if ok then return end
  if is_stopped(problem) then error(problem, 0) end
  self.fault = error_text(problem)
end

--- Stores a grasp immediately, so that it survives the end of the process.
function List:add(grasp)
  if self.format ~= "jsonl" then return end
  self:try(function()
    if not self.started then
      self.kept:add(grasp)
      self:start()
    elseif self:check_ours() then
      clench.files.append_text(self.path, clench.json.encode(grasp))
    end
  end)
end

-- During the search the list also contains the grasps of the journal and of the earlier list.
local function add_known(list, record, earlier)
  local numbers = {}
  local function add(grasp)
    local number = grasp.info.number
    if number and numbers[number] then return end
    if number then numbers[number] = true end
    list:add(grasp)
  end
  for _, piece in ipairs(record:rest()) do
    for _, new in ipairs(piece.known.grasps) do add(new.grasp) end
  end
  for _, grasp in ipairs(earlier) do add(grasp) end
end

function List:write_piece(lines)
  if self.started then
    self:check_ours()
    clench.files.append_text(self.journal_path, lines)
  else
    self.pending = self.pending .. lines
    if not self.is_replacing then self:start() end
  end
end

--- The journal for clench.plan.sample; nil: lists of this format cannot be continued.
function List:journal()
  if self.format ~= "jsonl" then return nil end
  local earlier = {}
  for i, grasp in ipairs(self.kept) do earlier[i] = grasp end
  -- a search for fewer grasps than before keeps all of the list
  local keep = (self.earlier_count or 0) > self.count and #earlier or 0
  self.keep = math.max(keep, self.count)
  local record = journal.new {
    known = self.known, listed = earlier, keep = keep,
    is_ended = function() return self.fault ~= nil end,
    write = function(lines) self:try(function() self:write_piece(lines) end) end,
  }
  self.kept = clench.grasps()
  add_known(self.kept, record, earlier)
  return record
end

-- Saves copies in other formats; existing files are replaced only if there are grasps.
function List:save_copies(grasps)
  for _, copy in ipairs(self.copies) do
    if #grasps > 0 or not look_at(copy.path) then grasps:save(copy.path, {format = copy.given_format}) end
  end
end

--- Replaces the lists by the grasps found, best first.
---@param grasps grasps
---@param is_search_complete boolean
---@return string? note  for the user
function List:save(grasps, is_search_complete)
  local ok, note = pcall(self.save_main, self, grasps, is_search_complete)
  if not ok and is_stopped(note) then error(note, 0) end
  -- a failure of one list does not prevent the others
  self:save_copies(grasps)
  if not ok then error(note, 0) end
  return note
end

function List:save_main(grasps, is_search_complete)
  if self.is_complete then return nil end
  if #grasps == 0 and self.is_replacing then
    return ("%s is unchanged, as no grasps were found"):format(self.path)
  end
  if self.format ~= "jsonl" then
    grasps:save(self.path, {format = self.given_format})
    return nil
  end
  if not self.started then self:start() end
  self:check_ours()
  grasps:save(self.path, {format = "jsonl", notes = self:notes {complete = is_search_complete}})
  if is_search_complete then
    os.remove(self.journal_path)
    return nil
  end
  return ("%s: --resume continues this search"):format(self.path)
end

return List
