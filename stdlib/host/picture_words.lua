--- Converts picture options of the command line to options of clench.render.
local scene = require "clench.host.scene"
local fail = require "clench.host.usage"

local function size_of(text)
  local width, height = text:match "^(%d+)[xX](%d+)$"
  width, height = math.tointeger(tonumber(width)), math.tointeger(tonumber(height))
  if not width or not height or width < 16 or height < 16 or width > 8192 or height > 8192 then
    fail("--size: expected WIDTHxHEIGHT, 16x16 to 8192x8192 pixels, got '%s'", text)
  end
  return {width, height}
end

-- "X,Y,Z[,X,Y,Z[,X,Y,Z]]": position and target of the camera [m], and the direction that is up
local function set_camera(options, text, world)
  if text == "file" then
    if not world or not world.camera then fail "--camera file: the file gives no camera" end
    for key, value in pairs(world.camera) do options[key] = value end
    return
  end
  local x = scene.numbers_of(text)
  if #x ~= 3 and #x ~= 6 and #x ~= 9 then
    fail("--camera: expected X,Y,Z in meters, with a point to look at, X,Y,Z,X,Y,Z, and a direction that is up, or 'file', got '%s'", text)
  end
  for i, key in ipairs {"eye", "target", "up"} do
    if #x >= 3 * i then options[key] = {x[3 * i - 2], x[3 * i - 1], x[3 * i]} end
  end
end

---@param given table<string, string>  options by name
---@param defaults {size: integer[], quality: string, background: string}
---@param world? world  its camera is used by --camera file
---@return table options  of clench.render; drafts have 4 samples per pixel
return function(given, defaults, world)
  local options = {size = given.size and size_of(given.size) or defaults.size, quality = given.quality or defaults.quality,
                   background = given.background or defaults.background, frame = given.frame,
                   outline = tonumber(given.outline), orthographic = given.orthographic and true or nil}
  if options.quality == "draft" then options.samples = 4 end
  if given.camera then set_camera(options, given.camera, world) end
  return options
end
