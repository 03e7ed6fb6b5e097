--- Grasps of the last job, with small pictures; a click puts the hand there.
local columns, width, height = 8, 112, 84

local function thumbnails(view, grasps)
  local state = view.gallery or {pictures = {}}
  view.gallery = state
  -- one picture per frame, so that no frame takes long
  local number = #state.pictures + 1
  if number > #grasps or number > 64 then return state.pictures end
  local copy = view.session.world:clone()
  local ok = pcall(function()
    grasps[number]:apply(copy)
    state.pictures[number] = clench.render(copy, {size = {width * 2, height * 2}, quality = "draft", transparent_objects = true})
  end)
  if not ok then state.pictures[number] = false end
  view.needs_frame = true
  return state.pictures
end

local function draw(ui, view)
  local session = view.session
  local job = session.jobs[#session.jobs]
  local ok, grasps = pcall(session.grasps_of, session, job)
  if not job or not ok or #grasps == 0 then return ui:text("Planners put their grasps here.", {color = {0.5, 0.5, 0.5}}) end
  if view.gallery_job ~= job or view.gallery_count ~= #grasps then view.gallery, view.gallery_job, view.gallery_count = nil, job, #grasps end
  local pictures = thumbnails(view, grasps)
  for i, picture in ipairs(pictures) do
    ui:id("grasp" .. i, function(ui)
      ui:group(function(ui)
        if picture and ui:image("grasp " .. i, picture, {width = width, height = height, changed = view.gallery_shown ~= picture}) then
          view:run("grasp.apply", {job = #session.jobs, rank = i})
        end
        ui:text(("grasp %d"):format(i))
      end)
    end)
    if i % columns ~= 0 then ui:same_line() end
  end
end

return {name = "Gallery", place = "bottom", draw = draw}
