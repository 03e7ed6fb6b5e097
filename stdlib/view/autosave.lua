--- Stores the script of the session while it is unsaved, so that a crash loses at most seconds of work; the next start offers to restore it.
--- Each viewer writes a separate file, whose first line identifies the process that wrote it.
local error_text = require "clench.error_text"
local history = require "clench.session.history"
local user_files = require "clench.view.user_files"
local autosave = {}

local quiet_time, longest_time = 5, 60  -- delays after the last and the first change that is not stored yet [s]
local max_files = 20
local mark = "-- autosave "

-- number and start time of a process: the number alone may be reused by another process. nil if it has ended, even if its parent has not noticed yet
local function process(id)
  local text = user_files.read(("/proc/%s/stat"):format(id))
  local rest = text and text:match "%)(.*)$"
  if not rest then return nil end
  local words = {}
  for word in rest:gmatch "%S+" do words[#words + 1] = word end
  if words[1] == "Z" or words[1] == "X" then return nil end
  return {id = text:match "^%d+", start = words[20]}
end

local function name_of(folder, i) return ("%s/autosave-%d.lua"):format(folder, i) end

-- Is it the first line of a file that a viewer has written?
local function is_head(said)
  if type(said) ~= "table" or type(said.id) ~= "string" or not said.id:find "^%d+$" or type(said.time) ~= "string" then return false end
  for _, key in ipairs {"path", "folder", "hand", "object"} do
    if said[key] ~= nil and type(said[key]) ~= "string" then return false end
  end
  return true
end

--- Scripts of processes that no longer exist.
---@param folder string
---@return {file: string, text: string, path?: string, folder?: string, hand?: string, object?: string, time: string, lines: string}[]
function autosave.left(folder)
  local list = {}
  for i = 1, max_files do
    local file = name_of(folder, i)
    local text = user_files.read(file)
    local head, lines = (text or ""):match("^" .. mark:gsub("%-", "%%-") .. "([^\n]*)\n[^\n]*\n[^\n]*\n(.*)$")
    local ok, said = pcall(clench.json.decode, head or "")
    if ok and is_head(said) then
      local owner = process(said.id)
      if not owner or owner.start ~= said.start then
        list[#list + 1] = {file = file, text = text, path = said.path, folder = said.folder, hand = said.hand, object = said.object, time = said.time, lines = lines}
      end
    end
  end
  return list
end

local function named(list, name)
  for _, thing in ipairs(list) do
    if thing.name == name then return thing end
  end
end

local function restore(session, args)
  local world = assert(load('local clench = require "clench"\nlocal world\n' .. args.lines .. "\nreturn world", "=autosave", "t"))()
  history.take(session, world)
  session.path = nil
  session.hand = named(world.robots, args.hand) or session.hand
  session.object = named(world.objects, args.object) or session.object
end

local function add_command(session)
  if session.commands["world.restore"] then return end
  session:command {name = "world.restore", label = "Restore",
                   parameters = {{name = "lines", type = "string", text = "of a session's script"},
                                 {name = "hand", type = "string", optional = true, text = "name of the hand that was the current one"},
                                 {name = "object", type = "string", optional = true, text = "name of the object that was the current one"}},
                   run = restore, script = function(_, args) return args.lines end}
end

-- the script, preceded by the line that identifies its process
local function text_of(session)
  local own = process "self" or {}
  return ("%s%s\n%s\n"):format(mark, clench.json.encode {id = own.id, start = own.start, path = session.path, folder = os.getenv "PWD",
                                                         hand = session.hand and session.hand.name, object = session.object and session.object.name,
                                                         time = os.date "%Y-%m-%d %H:%M"}, session:script())
end

--- Stores the script of a view's session in a folder while it is unsaved, and offers to restore the scripts of earlier viewers.
---@param folder? string  nil: nothing is stored
---@return {tick: fun(now: number), flush: fun(), finish: fun()}
function autosave.keep(view, folder)
  local session = view.session
  local file, first, last, failed
  if folder then
    add_command(session)
    view.left = autosave.left(folder)
  end
  local changed = false
  view.subscriptions[#view.subscriptions + 1] = session:subscribe("changed", function() changed = true end)
  local function free_name()
    for i = 1, max_files do
      if user_files.claim(name_of(folder, i)) then return name_of(folder, i) end
    end
    error(("autosave: %s is full; delete what is not needed"):format(folder), 0)
  end
  local function write()
    file = file or free_name()
    user_files.save(file, text_of(session))
  end
  local function forget()
    if file then os.remove(file) end
    file = nil
  end
  local function flush()
    changed, first, last = false, nil, nil
    if not folder then return end
    if not session:is_modified() then return forget() end
    local ok, problem = pcall(write)
    if not ok and not failed then view:print("autosave: " .. error_text(problem), "error") end
    failed = not ok
  end
  local function tick(now)
    if changed then changed, first, last = false, first or now, now end
    if first and (now - last >= quiet_time or now - first >= longest_time or not session:is_modified()) then flush() end
    if file and not session:is_modified() then forget() end
  end
  return {tick = tick, flush = flush, finish = forget}
end

-- removes an offered file, unless another viewer has restored it and uses its name now
local function drop(offer)
  if user_files.read(offer.file) == offer.text then os.remove(offer.file) end
end

local function take(view, offer)
  local ok, problem = pcall(view.session.run, view.session, "world.restore", {lines = offer.lines, hand = offer.hand, object = offer.object})
  if not ok then
    view.restore_error = error_text(problem)
    return
  end
  view.session.path = offer.path
  for _, kept in ipairs(view.kept) do
    if kept.flush then kept.flush() end
  end
  drop(offer)
  table.remove(view.left, 1)
end

--- Draws the offer to restore the script of an earlier viewer, if there is any.
function autosave.draw(view, ui)
  local offer = view.left and view.left[1]
  if not offer then return end
  ui:window("Restore", {width = 0, modal = true}, function(ui)
    ui:text(("The viewer ended before %s was saved (%s, in %s)."):format(offer.path or "the world", offer.time, offer.folder or "/"))
    if view.restore_error then ui:text(view.restore_error, {color = {0.84, 0.37, 0}}) end
    local restores = ui:button "Restore##left"
    ui:same_line()
    local discards = ui:button "Discard"
    ui:same_line()
    local waits = ui:button "Later"
    if restores then return take(view, offer) end
    if discards then drop(offer) end
    if discards or waits then
      view.restore_error = nil
      table.remove(view.left, 1)
    end
  end)
end

return autosave
