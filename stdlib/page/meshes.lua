--- Encodes meshes and poses for pages: each mesh once, in base64.
local base64 = require "clench.base64"
local meshes = {}

local large = 200000  -- number of triangles above which a page becomes slow
local max_image_bytes = 16 << 20  -- of all images of a page; beyond this limit triangles have colors instead

--- Packs numbers in chunks, since string.pack takes a limited number of arguments.
function meshes.packed(format, count, number)
  local parts, values = {}, {}
  for i = 1, count do
    values[#values + 1] = number(i)
    if #values == 192 or i == count then
      parts[#parts + 1] = string.pack("<" .. format:rep(#values), table.unpack(values))
      values = {}
    end
  end
  return table.concat(parts)
end

-- one color per triangle, as bytes; nil if the body has one color
local function packed_colors(body)
  local colors = body.triangle_colors
  if not colors or #colors ~= body.visual_mesh.triangle_count then return nil end
  local function byte(i) return math.floor(255 * colors[(i - 1) // 3 + 1][(i - 1) % 3 + 1] + 0.5) end
  return base64(meshes.packed("B", 3 * #colors, byte))
end

-- images by their indices in the page's list, and texture coordinates of triangles; nil if the images exceed the limit of the page
local function packed_textures(self, body)
  local textures = body.textures
  if not textures then return nil end
  local bytes = 0
  for _, image in ipairs(textures.images) do
    if not self.number_of_image[image.jpeg] then bytes = bytes + #image.jpeg end
  end
  if self.image_bytes + bytes > max_image_bytes then
    self.notes[#self.notes + 1] = ("the textures of %s are omitted: the images of a page are limited to %d MB"):format(body.name, max_image_bytes >> 20)
    return nil
  end
  self.image_bytes = self.image_bytes + bytes
  local list = {}
  for i, image in ipairs(textures.images) do
    if not self.number_of_image[image.jpeg] then
      self.images[#self.images + 1] = "data:image/jpeg;base64," .. base64(image.jpeg)
      self.number_of_image[image.jpeg] = #self.images
    end
    list[i] = {image = self.number_of_image[image.jpeg] - 1, tint = image.tint, wrap = {image.wrap_u, image.wrap_v}}
  end
  return {list = list, numbers = base64(textures.numbers), places = base64(textures.places)}
end

local function packed_mesh(self, body)
  local mesh = body.visual_mesh
  local flat = {}
  for _, v in ipairs(mesh.vertices) do
    flat[#flat + 1], flat[#flat + 2], flat[#flat + 3] = v.x, v.y, v.z
  end
  local indices = {}
  for _, t in ipairs(mesh.triangles) do
    for k = 1, 3 do indices[#indices + 1] = t[k] - 1 end
  end
  local wide = #flat // 3 > 65536
  return {positions = base64(meshes.packed("f", #flat, function(i) return flat[i] end)),
          indices = base64(meshes.packed(wide and "I4" or "I2", #indices, function(i) return indices[i] end)), wide = wide,
          colors = packed_colors(body), textures = packed_textures(self, body)}
end

--- Rounds to a micrometer.
function meshes.rounded(x)
  local value = math.floor(x * 1e6 + 0.5) / 1e6
  return value == 0 and 0 or value
end

--- Seven numbers: x y z [m], then the quaternion w x y z.
function meshes.numbers(pose)
  local p, q, rounded = pose.position, pose.quat, meshes.rounded
  return {rounded(p.x), rounded(p.y), rounded(p.z), rounded(q[1]), rounded(q[2]), rounded(q[3]), rounded(q[4])}
end

local Meshes = {}
Meshes.__index = Meshes

--- Adds the mesh of a body unless the list has it, and returns its index, from 0.
function Meshes:add(body)
  local mesh = packed_mesh(self, body)
  local key = mesh.positions .. mesh.indices .. (mesh.colors or "")
  if mesh.textures then
    key = key .. mesh.textures.numbers .. mesh.textures.places
    for _, texture in ipairs(mesh.textures.list) do
      key = key .. ("|%d %g %g %g %s %s"):format(texture.image, texture.tint[1], texture.tint[2], texture.tint[3], texture.wrap[1], texture.wrap[2])
    end
  end
  if not self.number_of[key] then
    self.list[#self.list + 1] = mesh
    self.number_of[key] = #self.list
  end
  if body.visual_mesh.triangle_count > large then
    self.notes[#self.notes + 1] = ("the mesh of %s has %d triangles: the page is large, and its view may be slow"):format(body.name, body.visual_mesh.triangle_count)
  end
  return self.number_of[key] - 1
end

--- An empty list of meshes; `images`: images of textures, as data URIs; `notes`: sentences about large meshes and omitted textures.
function meshes.new()
  return setmetatable({list = {}, images = {}, notes = {}, number_of = {}, number_of_image = {}, image_bytes = 0}, Meshes)
end

return meshes
