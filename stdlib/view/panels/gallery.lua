--- Grasps of planners and of files, with small pictures; a click moves the hand to a grasp, and two grasps can be compared.
local compare = require "clench.view.compare"
local dialog = require "clench.view.dialog"

local width, height, most = 112, 84, 64  -- size of a picture [pixels], and maximum number of pictures
local gray = {0.5, 0.5, 0.5}

-- lists of grasps: of jobs that have found some, then of files
local function sources_of(session)
  local sources = {}
  for i, job in ipairs(session.jobs) do
    local ok, grasps = pcall(session.grasps_of, session, job)
    if ok and #grasps > 0 then sources[#sources + 1] = {name = ("job %d, %s"):format(i, job.name or ""), grasps = grasps, job = i} end
  end
  for _, list in ipairs(session.lists) do sources[#sources + 1] = {name = list.name, grasps = list.grasps} end
  return sources
end

-- pictures of a list, drawn one per frame, so that no frame takes long
local function pictures_of(view, source)
  local key = ("%s %d"):format(source.name, #source.grasps)
  local state = view.gallery
  if not state or state.key ~= key then state = {key = key, pictures = {}} end
  view.gallery = state
  local number = #state.pictures + 1
  if number > math.min(#source.grasps, most) then return state end
  local copy = view.session.world:clone()
  local ok, problem = pcall(function()
    source.grasps[number]:apply(copy)
    state.pictures[number] = clench.render(copy, {size = {width * 2, height * 2}, quality = "draft", transparent_objects = true})
  end)
  if not ok then state.pictures[number] = {problem = tostring(problem)} end
  view.needs_frame = true
  return state
end

local function apply(view, source, number)
  view:run("grasp.apply", source.job and {job = source.job, rank = number} or {grasp = source.grasps[number]})
end

local function draw_grasp(view, ui, source, state, number)
  local picture, grasp = state.pictures[number], source.grasps[number]
  local label = ("grasp %d"):format(number)
  if type(picture) == "table" then
    if ui:button(("cannot be\nput here##%s"):format(label), {width = width, height = height}) then view:fail(picture.problem) end
    ui:tooltip(picture.problem)
  else
    if ui:image(label, picture, {width = width, height = height}) then apply(view, source, number) end
    ui:tooltip "Moves the hand to this grasp."
  end
  local name = ("%s of %s"):format(label, source.name)
  local epsilon = grasp.epsilon
  local _, changed = ui:checkbox(epsilon and ("%d: %.4f"):format(number, epsilon) or tostring(number), compare.has(view, name))
  if changed then compare.toggle(view, name, grasp, label, source.name) end
  ui:tooltip(("%s: epsilon. Two that are checked are compared."):format(label))
end

local function draw_sources(view, ui, sources, index)
  local names = {}
  for i, source in ipairs(sources) do names[i] = source.name end
  ui:width(260)
  local chosen, changed = ui:combo("##gallery source", index, names)
  if changed then view.gallery_source = names[chosen] end
  ui:same_line()
end

local function draw_buttons(view, ui, source)
  local commands = view.session.commands
  if ui:button "Load…##gallery" then dialog.open(view, commands["grasp.load_grasps"]) end
  ui:same_line()
  ui:disabled(not source, function(ui)
    if ui:button "Save…##gallery" then
      view.ask = {title = "Save Grasps", text = "grasps.jsonl", done = function(path)
        view.session:run("grasp.save_grasps", source.job and {path = path, job = source.job} or {path = path, grasps = source.grasps})
      end}
    end
  end)
end

local function draw(ui, view)
  local session = view.session
  if not session.world then return ui:text("No world is open.", {color = gray}) end
  local sources, index = sources_of(session), nil
  for i, source in ipairs(sources) do
    if source.name == view.gallery_source then index = i end
  end
  index = index or #sources
  local source = sources[index]
  if source then draw_sources(view, ui, sources, index) end
  draw_buttons(view, ui, source)
  if not source then return ui:text("Grasps of planners and of files are shown here.", {color = gray}) end
  ui:same_line()
  ui:text(("%d grasps%s"):format(#source.grasps, #source.grasps > most and (", the first %d are shown"):format(most) or ""), {color = gray})
  local state = pictures_of(view, source)
  ui:child("grasps", {height = 0}, function(ui)
    local columns = math.max(1, math.floor((ui:available()) / (width + 8)))
    for i = 1, #state.pictures do
      ui:id("grasp" .. i, function(ui)
        ui:group(function(ui) draw_grasp(view, ui, source, state, i) end)
      end)
      if i % columns ~= 0 and i < #state.pictures then ui:same_line() end
    end
  end)
end

return {name = "Gallery", place = "bottom", draw = draw}
