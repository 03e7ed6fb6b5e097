-- Run by `clench view --script` in window_test.sh: prints events of the window and the positions of its widgets.
local folder = os.getenv "WINDOW_TEST"
local function write(name, text)
  local file <close> = assert(io.open(folder .. "/" .. name .. ".new", "w"))
  file:write(text)
  file:close()
  assert(os.rename(folder .. "/" .. name .. ".new", folder .. "/" .. name))
end

-- a picture that is drawn within a frame of the window, as those of the gallery are
local picture
clench.view.panel {name = "Picture", draw = function(ui)
  if picture == nil then picture = select(2, pcall(clench.render, session.world, {size = {64, 48}, quality = "draft"})) end
end}

-- frames that take long while a file exists, as on a loaded machine
clench.view.panel {name = "Slow", place = "left", draw = function()
  local file = io.open(folder .. "/slow")
  if not file then return end
  file:close()
  local finish = clench.clock() + 0.25
  repeat until clench.clock() > finish
end}

clench.loop.every(0.1, function()
  if view.is_closed then return end
  local lines = {}
  for _, item in ipairs(view.ui.items) do
    lines[#lines + 1] = ("%d %d %s"):format(item.x + math.min(item.width, 24) // 2, item.y + item.height // 2, item.label)
  end
  write("items.txt", table.concat(lines, "\n") .. "\n")
  local eye = view.camera.eye
  write("state.txt", ("hash %s\neye %.4f %.4f %.4f\nframes %d\nmodified %s\npicture %s\ndrawn %d\ntyped %s\nlast %s\n"):format(
    session.world:hash(), eye.x, eye.y, eye.z, view.frames, tostring(session:is_modified()), tostring(picture), view.ui.pictures_drawn, view.console_text, view.lines[#view.lines] and view.lines[#view.lines].text or ""))
end)
