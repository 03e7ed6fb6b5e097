--- Settings that the viewer stores from one run to the next: theme, units, navigation, keys, panels that are hidden or in front, sizes of the window
--- and of panels, recent files.
local bindings = require "clench.view.bindings"
local error_text = require "clench.error_text"
local leave = require "clench.view.leave"
local navigation = require "clench.view.navigation"
local splitters = require "clench.view.splitters"
local user_files = require "clench.view.user_files"
local preferences = {}

local max_recent = 10
local interval = 1  -- time between two checks for changes [s]

local function sorted_keys(set)
  local list = {}
  for key in pairs(set) do list[#list + 1] = key end
  table.sort(list)
  return list
end

-- a table by names; nil if it is empty, as JSON would take that for a list
local function named(values) return next(values) and values or nil end

local function text_of(view)
  local size = view.ui.size
  return clench.json.encode({dark = view.dark, units = view.units, hidden = sorted_keys(view.hidden), navigation = view.navigation,
                             keys = named(view.bindings), sizes = view.sizes, shares = named(view.shares), front = named(view.front),
                             size = {math.tointeger(size[1]), math.tointeger(size[2])}, recent = view.recent}, {indent = 2}) .. "\n"
end

-- the texts of a list without control characters; no texts for any other value
local function texts_of(list)
  local texts = {}
  for _, text in ipairs(type(list) == "table" and list or {}) do
    if type(text) == "string" and not text:find "%c" then texts[#texts + 1] = text end
  end
  return texts
end

--- Reads the settings of a file; an empty table if there is none. Raises an error if it is damaged.
function preferences.read(path)
  local text = path and user_files.read(path)
  if not text then return {} end
  local ok, said = pcall(clench.json.decode, text)
  if not ok or type(said) ~= "table" then
    error(("%s: %s; the viewer starts with its defaults"):format(path, ok and "expected settings" or error_text(said)), 0)
  end
  return said
end

--- Size of the window when it was last closed; nil if unknown.
function preferences.size()
  local folder = user_files.settings()
  local ok, said = pcall(preferences.read, folder and folder .. "/viewer.json")
  local size = ok and type(said.size) == "table" and said.size or {}
  for i = 1, 2 do
    if math.type(size[i]) ~= "integer" or size[i] < 320 or size[i] > 8192 then return nil end
  end
  return size
end

-- the values by name that fulfil a condition
local function values_of(said, accepts)
  local values = {}
  for name, value in pairs(type(said) == "table" and said or {}) do
    if type(name) == "string" and accepts(value) then values[name] = value end
  end
  return values
end

local function apply_arrangement(view, said)
  for _, style in ipairs(navigation.styles) do
    if said.navigation == style then view.navigation = style end
  end
  for _, problem in ipairs(bindings.apply(view, said.keys)) do view:print("settings: " .. problem, "error") end
  view.front = values_of(said.front, function(value) return type(value) == "string" end)
  local shares = values_of(said.shares, function(value) return type(value) == "number" and value >= splitters.min_share and value <= 1 - splitters.min_share end)
  view.shares = {left = shares.left, right = shares.right}
  local sizes = values_of(said.sizes, function(value) return type(value) == "number" and value >= splitters.min and value <= 8192 end)
  for name in pairs(view.sizes) do view.sizes[name] = sizes[name] or view.sizes[name] end
end

local function apply(view, said)
  if type(said.dark) == "boolean" and not view.has_theme then view:set_theme(said.dark) end
  local units = type(said.units) == "table" and said.units or {}
  if units.length == "m" or units.length == "mm" then view.units.length = units.length end
  if units.angle == "rad" or units.angle == "deg" then view.units.angle = units.angle end
  for _, name in ipairs(texts_of(said.hidden)) do view.hidden[name] = true end
  view.recent = table.move(texts_of(said.recent), 1, max_recent, 1, {})
  apply_arrangement(view, said)
end

--- Records a file that was opened or saved.
function preferences.add_recent(view, path)
  path = user_files.absolute(path)
  local list = {path}
  for _, other in ipairs(view.recent) do
    if other ~= path and #list < max_recent then list[#list + 1] = other end
  end
  view.recent = list
end

--- Opens a recent file; one that no longer exists is removed from the list.
function preferences.open_recent(view, path)
  leave.ask(view, "open", function()
    if view:run("world.open", {path = path}) or view.session.path == path then return end
    for i, other in ipairs(view.recent) do
      if other == path then table.remove(view.recent, i) break end
    end
  end)
end

--- Applies the settings of a file to a view, and stores them there when they change.
---@param path? string  nil: nothing is stored
---@return {tick: fun(now: number), finish: fun()}
function preferences.keep(view, path)
  local ok, said = pcall(preferences.read, path)
  if not ok then
    -- they may have been edited by hand: they are not overwritten
    local moved = os.rename(path, path .. ".damaged")
    view:print(said .. (moved and "; the file is now " .. path .. ".damaged" or ""), "error")
  end
  apply(view, ok and said or {})
  local known
  local function follow_path()
    local now = view.session.path
    if now and now ~= known then preferences.add_recent(view, now) end
    known = now
  end
  follow_path()
  view.subscriptions[#view.subscriptions + 1] = view.session:subscribe("changed", follow_path)
  local saved, looked, failed
  local function save()
    follow_path()  -- Save As changes nothing else
    local text = text_of(view)
    if not path or text == saved then return end
    local done, problem = pcall(user_files.save, path, text)
    if done then saved, failed = text, nil return end
    if not failed then view:print("settings: " .. error_text(problem), "error") end
    failed = true
  end
  local function tick(now)
    if looked and now - looked < interval then return end
    looked = now
    save()
  end
  return {tick = tick, finish = save}
end

return preferences
