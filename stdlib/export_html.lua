--- Writes a world as one page of HTML that a browser shows in 3-D without a server: a camera that the mouse turns, a list of the bodies with their
--- visibility, contacts with their friction cones, the poses of grasps, and a recorded run with a slider of time.
local described = require "clench.described"
local find_three = require "clench.page.three"
local meshes = require "clench.page.meshes"
local raise = require "clench.raise"
local read_options = require "clench.options"
local run = require "clench.page.run"

-- half of the diagonal of a body's bounds [m]
local function size_of(body)
  local bounds = body.bounds_in_world
  return bounds and (bounds.high - bounds.low):norm() / 2 or 0.05
end

-- contacts of robots with objects: point, normal, coefficient of friction, size of the object
local function contacts_of(world)
  local list = {}
  for _, robot in ipairs(world.robots) do
    for _, object in ipairs(world.objects) do
      for _, contact in ipairs(world:contacts(robot, object)) do
        local p, n, rounded = contact.point, contact.normal, meshes.rounded
        list[#list + 1] = {rounded(p.x), rounded(p.y), rounded(p.z), rounded(n.x), rounded(n.y), rounded(n.z), contact.mu, size_of(object)}
      end
    end
  end
  return list
end

-- raises an error if the frames of a page are not grasps, or not a recorded run
local function check_frames(subject, grasps, recording)
  if grasps and recording then raise(subject .. ": expected grasps or a recording, got both") end
  if grasps and #grasps == 0 then raise(subject .. ": grasps: expected at least one, got none") end
  for i = 1, #(grasps or {}) do
    if clench.type(grasps[i]) ~= "grasp" then raise(("%s: grasps[%d]: expected a grasp, got %s"):format(subject, i, described(grasps[i]))) end
  end
  if not recording then return end
  if type(recording.each) ~= "function" or type(recording.times) ~= "table" then
    raise(("%s: recording: expected a recorded run of world:record, got %s"):format(subject, described(recording)))
  end
  if #recording.times == 0 then raise(subject .. ": recording: it is empty: the world has not run since it was created") end
end

-- frames of a page: one of the world, one for each grasp, or those of a recording
local function frames_of(world, grasps, recording)
  if recording then return recording end
  local times = {0}
  for i = 2, #(grasps or {}) do times[i] = i - 1 end
  return {times = times, each = function(_, visit)
    if not grasps then return visit(world, 1, 0) end
    local copy = world:clone()
    for i, grasp in ipairs(grasps) do
      grasp:apply(copy)
      visit(copy, i, i - 1)
    end
  end}
end

--- Writes a world as a page of HTML, which shows it in 3-D in a browser without a server.
---@param world world  world to be shown
---@param path string  its name ends in .html
---@param options? table  contents of the page
---@option title? string = "World"  title of the page
---@option grasps? grasps|table  grasps of the world's hand and object, each a frame of the page
---@option recording? table  recorded run of the world (see world:record)
---@option max_size? number [bytes, >= 1] = 1e9  largest size of the page
---@option three? string[]  files in which three.js may be
---@return integer bytes
---@effect files
--- > clench.export_html(world, "page.txt")  --> error: expected a name that ends in .html, got 'page.txt'
return function(world, path, options)
  local subject = "clench.export_html"
  if clench.type(world) ~= "world" then raise(subject .. ": world: expected a world, got " .. described(world)) end
  if type(path) ~= "string" or not path:lower():find "%.html?$" then
    raise(subject .. ": path: expected a name that ends in .html, got " .. described(path))
  end
  local read = read_options(subject, options or {})
  local title, max_size = read:get "title", read:get "max_size"
  local grasps, recording, three_files = read:checked "grasps", read:checked "recording", read:checked "three"
  read:done()
  check_frames(subject, grasps, recording)
  local three, missing = find_three(three_files)
  if not three then raise(subject .. ": " .. missing) end
  local data, notes = run.data_of(frames_of(world, grasps, recording))
  data.speed = 1
  data.plays = recording ~= nil
  if not grasps and not recording then data.contacts = contacts_of(world) end
  local words = ("%d bodies"):format(#data.parts)
  if grasps then words = words .. (", %d grasps"):format(#grasps) end
  for _, note in ipairs(notes) do words = words .. "; " .. note end
  local page = run.page_of(title, words, data, three)
  if #page > max_size then raise(("%s: the page has %d bytes, more than max_size = %d"):format(subject, #page, max_size)) end
  clench.files.save_text(path, page)
  return #page
end
