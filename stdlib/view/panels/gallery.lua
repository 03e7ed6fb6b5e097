--- Grasps of planners and of files, with small pictures; a click moves the hand to a grasp, and two grasps can be compared.
local ask_path = require "clench.view.ask_path"
local compare = require "clench.view.compare"
local dialog = require "clench.view.dialog"

local width, height, most = 112, 84, 64  -- size of a picture [pixels], and maximum number of pictures
local gray = {0.5, 0.5, 0.5}

-- lists of grasps: of jobs that have found some, then of files
local function sources_of(session)
  local sources = {}
  for i, job in ipairs(session.jobs) do
    local ok, grasps = pcall(session.grasps_of, session, job)
    if ok and #grasps > 0 then sources[#sources + 1] = {name = ("job %d, %s"):format(i, job.name or ""), grasps = grasps, job = i, key = job} end
  end
  for _, list in ipairs(session.lists) do sources[#sources + 1] = {name = list.name, grasps = list.grasps, key = list} end
  return sources
end

-- identifies the picture of a grasp: hand, object, pose and DOFs
local function key_of(grasp)
  local p, q, dofs = grasp.pose.position, grasp.pose.quat, grasp.dofs
  return ("%s\0%s\0"):format(grasp.hand_name, grasp.object_name) .. string.pack(("d"):rep(7 + #dofs), p.x, p.y, p.z, q[1], q[2], q[3], q[4], table.unpack(dofs))
end

local function new_picture(view, grasp)
  local copy, picture = view.session.world:clone(), nil
  local ok, problem = pcall(function()
    grasp:apply(copy)
    picture = clench.render(copy, {size = {width * 2, height * 2}, quality = "draft", transparent_objects = true})
  end)
  return ok and picture or {problem = tostring(problem)}
end

-- key of the scene: names and poses of objects and obstacles
local function scene_of(world)
  local parts = {}
  for _, bodies in ipairs {world.objects, world.obstacles} do
    for _, body in ipairs(bodies) do
      local p, q = body.pose.position, body.pose.quat
      parts[#parts + 1] = string.pack("zddddddd", body.name, p.x, p.y, p.z, q[1], q[2], q[3], q[4])
    end
  end
  return table.concat(parts)
end

-- Pictures of the first grasps of a list; false for one that is not made yet. One is made per frame, so that no frame takes long, and kept while the list grows
-- or changes its order, and until an object or obstacle has moved.
local function pictures_of(view, source)
  view.gallery = view.gallery or {by_key = {}}
  local gallery, list, has_new = view.gallery, {}, false
  local is_moving = view.session.gesture ~= nil
  if not is_moving then gallery.scene = scene_of(view.session.world) end
  for i = 1, math.min(#source.grasps, most) do
    local key = key_of(source.grasps[i])
    local kept = gallery.by_key[key]
    if not has_new and (not kept or not is_moving and kept.scene ~= gallery.scene) then
      kept, has_new = {picture = new_picture(view, source.grasps[i]), scene = not is_moving and gallery.scene}, true
      gallery.by_key[key], view.needs_frame = kept, true
    end
    list[i] = kept and kept.picture or false
  end
  return list
end

local function apply(view, source, number)
  view:run("grasp.apply", source.job and {job = source.job, rank = number} or {grasp = source.grasps[number]})
end

local function draw_picture(view, ui, source, picture, number, label)
  local size = {width = width * view.scale, height = height * view.scale}
  if not picture then
    ui:disabled(true, function(ui) ui:button("…##" .. label, size) end)
  elseif type(picture) == "table" then
    if ui:button(("cannot be\nput here##%s"):format(label), size) then view:fail(picture.problem) end
    ui:tooltip(picture.problem)
  else
    if ui:image(label, picture, size) then apply(view, source, number) end
    ui:tooltip "Moves the hand to this grasp."
  end
end

local function draw_grasp(view, ui, source, picture, number)
  local grasp = source.grasps[number]
  local label = ("grasp %d"):format(number)
  draw_picture(view, ui, source, picture, number, label)
  -- by its contents: while a search runs, better grasps take its place in the list
  local key, epsilon = source.name .. "\0" .. key_of(grasp), grasp.epsilon
  local _, changed = ui:checkbox(("%s###compare %d"):format(epsilon and ("%d: %.4f"):format(number, epsilon) or number, number), compare.has(view, key))
  if changed then compare.toggle(view, key, grasp, label, source.name) end
  ui:tooltip(("%s: epsilon. Two that are checked are compared."):format(label))
end

local function draw_sources(view, ui, sources, index)
  local names = {}
  for i, source in ipairs(sources) do names[i] = source.name end
  ui:width(260 * view.scale)
  local chosen, changed = ui:combo("##gallery source", index, names)
  if changed then view.gallery_source = sources[chosen].key end
  ui:same_line()
end

local function draw_buttons(view, ui, source)
  local commands = view.session.commands
  if ui:button "Load…##gallery" then dialog.open(view, commands["grasp.load_grasps"]) end
  ui:same_line()
  ui:disabled(not source, function(ui)
    if ui:button "Save…##gallery" then
      ask_path.open(view, "Save Grasps", "grasps.jsonl", "grasp.save_grasps", function(path)
        view.session:run("grasp.save_grasps", source.job and {path = path, job = source.job} or {path = path, grasps = source.grasps})
      end)
    end
  end)
end

local function draw(ui, view)
  local session = view.session
  if not session.world then return ui:text("No world is open.", {color = gray}) end
  local sources, index = sources_of(session), nil
  for i, source in ipairs(sources) do
    if source.key == view.gallery_source then index = i end
  end
  index = index or #sources
  local source = sources[index]
  if source then draw_sources(view, ui, sources, index) end
  draw_buttons(view, ui, source)
  if not source then return ui:text("Grasps of planners and of files are shown here.", {color = gray}) end
  ui:same_line()
  ui:text(("%d grasps%s"):format(#source.grasps, #source.grasps > most and (", the first %d are shown"):format(most) or ""), {color = gray})
  local pictures = pictures_of(view, source)
  ui:child("grasps", {height = 0}, function(ui)
    local columns = math.max(1, math.floor((ui:available()) / (width * view.scale + 8)))
    for i, picture in ipairs(pictures) do
      ui:id("grasp" .. i, function(ui)
        ui:group(function(ui) draw_grasp(view, ui, source, picture, i) end)
      end)
      if i % columns ~= 0 and i < #pictures then ui:same_line() end
    end
  end)
end

return {name = "Gallery", place = "bottom", draw = draw}
