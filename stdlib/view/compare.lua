--- Two grasps side by side: their pictures by one camera, which turns with that of the view, and their measures in one table.
local camera = require "clench.view.camera"
local compare = {}

local width, height = 300, 240  -- size of a picture at scale 1 [pixels]
local gray, orange = {0.5, 0.5, 0.5}, {0.84, 0.37, 0}

-- the list of chosen grasps, at most two
local function chosen(view)
  view.compared = view.compared or {}
  return view.compared
end

--- Is a grasp chosen?
---@param id string  identifies it
function compare.has(view, id)
  for _, entry in ipairs(chosen(view)) do
    if entry.id == id then return true end
  end
  return false
end

--- Chooses a grasp, or removes it from the choice. A third grasp replaces the first.
---@param id string  identifies it
---@param grasp grasp
---@param short string  its name within its list
---@param source string  name of the list
function compare.toggle(view, id, grasp, short, source)
  local list = chosen(view)
  for i, entry in ipairs(list) do
    if entry.id == id then
      table.remove(list, i)
      return
    end
  end
  if #list == 2 then table.remove(list, 1) end
  list[#list + 1] = {id = id, label = ("%s of %s"):format(short, source), short = short, source = source, grasp = grasp, values = {}}
end

-- short names, unless the grasps are from different lists
local function names_of(list)
  if list[1].source == list[2].source then return {list[1].short, list[2].short} end
  return {list[1].label, list[2].label}
end

-- measures the grasp in a copy of the world, anew when that has changed
local function place(view, entry)
  if entry.placed_in == view.world_hash then return end
  entry.placed_in, entry.world, entry.values = view.world_hash, view.session.world:clone(), {}
  entry.measured, entry.error = nil, nil
  local ok, result = pcall(entry.grasp.apply, entry.grasp, entry.world)
  if ok then entry.measured = result else entry.error = tostring(result) end
end

local function value_of(entry, name)
  if entry.values[name] == nil then
    local ok, value = pcall(entry.measured.quality, entry.measured, name)
    entry.values[name] = ok and value == value and value or false
  end
  return entry.values[name]
end

-- a camera that sees both grasps, from the direction of the view's
local function camera_of(view, list)
  local first = list[1]
  if first.beside ~= list[2].world then
    first.beside, first.camera = list[2].world, clench.camera({list[1].world, list[2].world}, {size = {width, height}})
  end
  local base, seen = first.camera, view.camera
  local distance = 1.2 * (base.eye - base.target):norm()  -- it was chosen for another direction
  return {eye = base.target + (seen.eye - seen.target):unit() * distance, target = base.target, up = seen.up, field_of_view = base.field_of_view}
end

local function draw_picture(view, ui, entry, number, seen)
  ui:group(function(ui)
    if ui:button("Apply##compared" .. number) then view:run("grasp.apply", {grasp = entry.grasp}) end
    ui:tooltip "Moves the hand to this grasp."
    ui:same_line()
    ui:text(entry.label)
    if entry.error then return ui:text(entry.error, {color = orange, wrap = true}) end
    local key = ("%s %s %s"):format(entry.placed_in, view.display.transparent_objects, camera.key(seen))
    if entry.key ~= key then
      entry.picture = clench.render(entry.world, {size = {width, height}, quality = "draft", camera = seen, transparent_objects = view.display.transparent_objects})
      entry.key = key
    end
    ui:image("compared " .. number, entry.picture, {width = width * view.scale, height = height * view.scale})
  end)
end

-- rows of the table: name, the two values, and the better one, if that is known
local function rows_of(view, list, names)
  local rows, higher = {}, {}
  for _, measure in ipairs(view.known_measures or {}) do higher[measure.name] = measure.higher_is_better end
  local function add(name, a, b, is_higher_better)
    local better = ""
    if a and b and is_higher_better ~= nil then better = a == b and "equal" or names[(a > b) == is_higher_better and 1 or 2] end
    rows[#rows + 1] = {name, a, b, better}
  end
  for _, name in ipairs(view.measures or {"epsilon", "volume"}) do add(name, value_of(list[1], name), value_of(list[2], name), higher[name]) end
  add("contacts", #list[1].measured.contacts, #list[2].measured.contacts)
  local a, b = list[1].grasp.info.energy, list[2].grasp.info.energy
  if a and b then add("energy", a, b, false) end
  return rows
end

local function text_of(value) return not value and "–" or math.type(value) == "integer" and tostring(value) or ("%.5g"):format(value) end

local function draw_table(view, ui, list)
  local names = names_of(list)
  ui:table("compared measures", {"measure", names[1] .. "##first", names[2] .. "##second", "better"}, {}, function(ui)
    for _, row in ipairs(rows_of(view, list, names)) do
      ui:next_column() ui:text(row[1])
      for i = 1, 2 do
        ui:next_column()
        ui:text(text_of(row[1 + i]))
      end
      ui:next_column() ui:text(row[4])
    end
  end)
end

--- Draws the window while two grasps are chosen.
function compare.draw(view, ui)
  local list = view.compared
  if not list or #list < 2 or not view.session.world then return end
  for _, entry in ipairs(list) do place(view, entry) end
  local scale = view.scale
  local open = ui:window("Compare Grasps", {x = 215 * scale, y = 150 * scale, width = (2 * width + 40) * scale, height = (height + 240) * scale, movable = true, resizable = true, can_close = true}, function(ui)
    local seen = camera_of(view, list)
    draw_picture(view, ui, list[1], 1, seen)
    ui:same_line(16)
    draw_picture(view, ui, list[2], 2, seen)
    if list[1].measured and list[2].measured then draw_table(view, ui, list) end
    ui:text("The pictures turn with the camera of the view; the measures are those of the panel Grasp Quality.", {color = gray, wrap = true})
  end)
  if not open then view.compared = nil end
end

return compare
