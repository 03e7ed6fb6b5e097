-- scripts/models/primitives.lua
--- The objects' shapes approximated by a few cubes, spheres, cylinders and cones, for planners [mm].

local function row(...)
  local out = {}
  for i, x in ipairs {...} do out[i] = ("%.6g"):format(x) end
  return table.concat(out, " ")
end

-- sizes by name, in the order of the lists below
local kinds = {
  Cube = {"width", "height", "depth"}, Sphere = {"radius"}, Cylinder = {"radius", "height"},
  Cone = {"bottomRadius", "height"},
}

---@param about string
---@param list table[]  {kind, sizes..., at = center, turn? = axis and angle}; cylinders and cones are along z unless turned, cubes have x, y, z
local function file(about, list)
  local out = {"#Inventor V2.1 ascii", "# " .. about .. "; made by scripts/make_models.lua [mm]", "Separator {"}
  for _, p in ipairs(list) do
    local fields = {}
    for i, name in ipairs(kinds[p[1]]) do fields[i] = name .. " " .. row(p[i + 1]) end
    -- Inventor's cylinders and cones are along y
    local turn = p.turn or (p[1] == "Cylinder" or p[1] == "Cone") and {1, 0, 0, math.pi / 2}
    out[#out + 1] = "  Separator {"
    out[#out + 1] = "    Translation { translation " .. row(table.unpack(p.at)) .. " }"
    if turn then out[#out + 1] = "    Rotation { rotation " .. row(table.unpack(turn)) .. " }" end
    out[#out + 1] = ("    %s { %s }"):format(p[1], table.concat(fields, " "))
    out[#out + 1] = "  }"
  end
  out[#out + 1] = "}"
  out[#out + 1] = ""
  return table.concat(out, "\n")
end

local folder = "models/objects/primitives/"
return {
  {folder .. "flask.iv", text = file("conical flask: a cone and its neck",
    {{"Cone", 66, 220, at = {0, 0, 110}}, {"Cylinder", 22, 50, at = {0, 0, 195}}})},
  {folder .. "mug.iv", text = file("mug: a cylinder and a box for the handle",
    {{"Cylinder", 41, 95, at = {0, 0, 47.5}}, {"Cube", 36, 14, 62, at = {57.5, 0, 50}}})},
  {folder .. "glass.iv", text = file("drinking glass: a cylinder", {{"Cylinder", 34, 140, at = {0, 0, 70}}})},
  {folder .. "plane.iv", text = file("toy plane: fuselage, wings and tail", {
    {"Cylinder", 16, 184, at = {-4, 0, 33}, turn = {0, 0, 1, math.pi / 2}}, {"Cube", 46, 190, 8, at = {20, 0, 24}},
    {"Cube", 28, 72, 6, at = {-80, 0, 35}}, {"Cube", 30, 5, 32, at = {-82, 0, 50}},
  })},
}
