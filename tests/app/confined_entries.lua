-- Tries every entry of the API that opens a file, in a process whose reading is confined: clench run --confine IN confined_entries.lua IN OUT.
-- IN contains `link`, a link to the folder OUT, which contains `file`. An entry whose documentation speaks of files must be listed here.
local inside, outside = ...
local doc = require "clench.host.doc"
local packed_docs = require "clench.signature.packed_docs"

local anywhere = {confine = "/"}
local world = clench.world()
local hand = world:add_robot("models/hands/barrett/barrett.cfg", anywhere)
local arm = world:add_robot("models/arms/puma560/puma560.cfg", anywhere)
local box = world:add_object(clench.shapes.box {0.1, 0.1, 0.1})
local picture = clench.render(world, {size = {16, 16}, quality = "draft"})
local empty = clench.world()
local recording, log = empty:record(), empty:log {quantities = {"energy"}}
empty:run(0.1)

-- entries that read the path; `[{key}]` passes it as that option
local readers = {
  ["clench.file_kind"] = clench.file_kind,
  ["clench.convert"] = function(path) clench.convert(path, inside .. "/x.obj") end,
  ["clench.convert{folder}"] = function(path) clench.convert(inside .. "/names_file.urdf", inside .. "/x.xml", {folder = path:match "^(.*)/"}) end,
  ["clench.convert{package}"] = function(path) clench.convert(inside .. "/names_package.urdf", inside .. "/x.xml", {package = path:match "^(.*)/"}) end,
  ["clench.convert{eigengrasps}"] = function(path) clench.convert(inside .. "/plain.urdf", inside .. "/x.xml", {eigengrasps = path}) end,
  ["clench.convert{virtual_contacts}"] = function(path) clench.convert(inside .. "/plain.urdf", inside .. "/x.xml", {virtual_contacts = path}) end,
  ["clench.load"] = clench.load,
  ["clench.load{folder}"] = function(path) clench.load(inside .. "/names_file.urdf", {folder = path:match "^(.*)/"}) end,
  ["clench.load{package}"] = function(path) clench.load(inside .. "/names_package.urdf", {package = path:match "^(.*)/"}) end,
  ["clench.load{eigengrasps}"] = function(path) clench.load(inside .. "/plain.urdf", {eigengrasps = path}) end,
  ["clench.load{virtual_contacts}"] = function(path) clench.load(inside .. "/plain.urdf", {virtual_contacts = path}) end,
  ["clench.grasps"] = clench.grasps,
  ["clench.csv.read"] = clench.csv.read,
  ["clench.files.list"] = clench.files.list,
  ["clench.files.exists"] = clench.files.exists,
  ["clench.port.replay"] = function(path) clench.port.replay(path):close() end,
  ["clench.plan.primitive{primitives}"] = function(path) clench.plan.primitive {hand = hand, object = box, primitives = path} end,
  ["clench.report.of"] = function(path)
    local r = clench.report.of(path)
    if r.error then error(r.error, 0) end
  end,
  ["clench.report.of{folder}"] = function(path)
    local r = clench.report.of(inside .. "/names_file.urdf", {folder = path:match "^(.*)/"})
    if r.error then error(r.error, 0) end
  end,
  ["clench.report.of{package}"] = function(path)
    local r = clench.report.of(inside .. "/names_package.urdf", {package = path:match "^(.*)/"})
    if r.error then error(r.error, 0) end
  end,
  ["world:add_object"] = function(path) world:add_object(path) end,
  ["world:add_obstacle"] = function(path) world:add_obstacle(path) end,
  ["world:add_robot"] = function(path) world:add_robot(path) end,
  ["world:add_robot{folder}"] = function(path) world:add_robot(inside .. "/names_file.urdf", {folder = path:match "^(.*)/"}) end,
  ["world:add_robot{package}"] = function(path) world:add_robot(inside .. "/names_package.urdf", {package = path:match "^(.*)/"}) end,
  ["world:add_robot{eigengrasps}"] = function(path) world:add_robot(inside .. "/plain.urdf", {eigengrasps = path}) end,
  ["world:add_robot{virtual_contacts}"] = function(path) world:add_robot(inside .. "/plain.urdf", {virtual_contacts = path}) end,
  ["robot:mount_on{adapter}"] = function(path) hand:mount_on(arm, {adapter = path}) end,
}
for _, name in ipairs {"eigengrasps", "virtual_contacts", "object_contacts", "primitives", "pregrasps", "read_text", "glove_calibration",
                       "glove_poses", "arrays"} do
  readers["clench.files." .. name] = clench.files[name]
end

-- entries that write to the path
local writers = {
  ["clench.convert"] = function(path) clench.convert(inside .. "/flask.iv", path .. ".obj") end,
  ["clench.files.save_text"] = function(path) clench.files.save_text(path, "text") end,
  ["clench.files.append_text"] = function(path) clench.files.append_text(path, "text") end,
  ["clench.files.check_writable"] = clench.files.check_writable,
  ["clench.files.make_folder"] = clench.files.make_folder,
  ["clench.export_html"] = function(path) clench.export_html(hand.world, path .. ".html") end,
  ["clench.devices.save_postures"] = function(path) clench.devices.save_postures(path, {{sensors = {1}}}) end,
  ["clench.devices.save_calibration"] = function(path) clench.devices.save_calibration(path, {slopes = {{1}}, intercepts = {0}}) end,
  ["clench.port.listen"] = function(path) clench.port.listen {path = path}:close() end,
  ["clench serve --token-file"] = function(path) require "clench.save_secret"(path, "token") end,
  ["port:record"] = function(path)
    local a, b = clench.port.pair()
    a:record(path)
    a:close()
    b:close()
  end,
  ["clench.files.save_arrays"] = function(path) clench.files.save_arrays(path, {a = {1}}) end,
  ["clench.files.save_object_contacts"] = function(path) clench.files.save_object_contacts(path, {}) end,
  ["clench.files.save_pregrasps"] = function(path) clench.files.save_pregrasps(path, {}) end,
  ["clench.files.save_gif"] = function(path) clench.files.save_gif(path, {picture}) end,
  ["clench.csv.write"] = function(path) clench.csv.write(path, {{a = 1}}) end,
  ["clench.latex.write"] = function(path) clench.latex.write(path, {{a = 1}}) end,
  ["world:save"] = function(path) clench.world():save(path .. ".wld") end,
  ["grasp:save"] = function(path) clench.grasp(hand, box):save(path .. ".xml") end,
  ["mesh:save"] = function(path) box.mesh:save(path .. ".obj") end,
  ["hand:save_virtual_contacts"] = function(path) hand:save_virtual_contacts(path .. ".vgr") end,
  ["eigengrasps:save"] = function(path) hand.eigengrasps:save(path .. ".egr") end,
  ["picture:save"] = function(path) picture:save(path .. ".png") end,
  ["plot:save"] = function(path) clench.plot {series = {{x = {0, 1}, y = {0, 1}}}}:save(path .. ".svg") end,
  ["grasps:save"] = function(path) clench.grasps():save(path .. ".jsonl") end,
  ["grasps:check_save"] = function(path) clench.grasps():check_save(path .. ".jsonl") end,
  ["log:save"] = function(path) log:save(path .. ".csv") end,
  ["recording:save"] = function(path) recording:save(path .. ".gif", {size = {16, 16}}) end,
  -- files written next to the named file, in a folder that is a link
  ["clench.convert{beside}"] = function(path)
    clench.convert(inside .. "/flask.iv", path:match "^(.*)/link/" .. "/linked.xml")
  end,
  ["grasp:save{beside}"] = function(path)
    clench.grasp(hand, box):save(path:match "^(.*)/link/" .. "/linked.xml")
  end,
}

-- entries whose documentation speaks of files, but which open none
local neither = {
  ["clench.render"] = "options of pictures",
  ["clench.files.csv_records"] = "takes the contents of a file, and its name for errors",
  ["clench.test.path"] = "writes temporary files of its own only",
  ["clench.catalog"] = "reads the folders of its own models",
  ["clench.shapes.tube"] = "its path is a line in space",
  ["clench.study.compare"] = "grasps that came from files",
  ["motion:weld"] = "its `to` is a body",
  ["clench.port.connect"] = "connects to a socket, and opens no file",
}

-- --- files ---

local file_keys = {folder = true, package = true, eigengrasps = true, virtual_contacts = true, adapter = true, primitives = true}
local function looks_like_files(param)
  local words = " " .. param.name .. " " .. (param.text or "") .. " "
  return param.type:find "string" and (words:find "%f[%a]paths?%f[%A]" or words:find "%f[%a]files?%f[%A]")
    or param.name:find "^path" or param.type:find "confine%?" or param.name == "to" and param.type == "string"
end

local listed, unlisted = {}, {}
for _, list in ipairs {readers, writers, neither} do
  for name in pairs(list) do listed[name] = true end
end
local found = {}
local function look(name, text)
  for _, param in ipairs(doc.parse(text).params) do
    if looks_like_files(param) then
      found[name] = true
      if not listed[name] and not listed[name .. "{primitives}"] and not listed[name .. "{adapter}"] then unlisted[#unlisted + 1] = name end
      for key in param.type:gmatch "([%w_]+)%??: " do
        if file_keys[key] and not listed[name .. "{" .. key .. "}"] then unlisted[#unlisted + 1] = name .. "{" .. key .. "}" end
      end
    end
  end
end
local all = clench.entries()
for _, library in ipairs(all.libraries) do
  for _, entry in ipairs(library.functions) do look(library.name .. "." .. entry.name, entry.doc) end
end
for _, class in ipairs(all.classes) do
  for _, entry in ipairs(class.methods) do look(class.name .. ":" .. entry.name, entry.doc) end
end
for _, entry in ipairs(packed_docs.functions(all.files)) do look("clench." .. entry.name, entry.doc) end
table.sort(unlisted)
assert(#unlisted == 0, "entries that open files are not tried here: " .. table.concat(unlisted, ", "))
local count = 0
for _ in pairs(found) do count = count + 1 end
assert(count > 25, count)

-- the descriptions say the same: these are the entries with the effect `files`, apart from those that touch files of their own only
local own_files = {["clench.catalog"] = true, ["clench.test.path"] = true, ["clench.test.folder"] = true, ["clench.test.run_file"] = true}
local variables = {}
for _, class in ipairs(all.classes) do variables[class.name] = class.variable end
local tried = {}
for _, list in ipairs {readers, writers} do
  for name in pairs(list) do tried[name:gsub("{.*", ""):gsub("^(%w+):", function(class) return (variables[class] or class) .. ":" end)] = true end
end
local different = {}
for _, entry in ipairs(clench.describe()) do
  local touches = entry.files == true and not own_files[entry.name]
  if touches ~= (tried[entry.name] == true) then different[#different + 1] = entry.name end
end
assert(#different == 0, "the effect of these entries does not fit this list: " .. table.concat(different, ", "))

-- --- reading ---

local paths = {outside .. "/file", inside .. "/../out/file", inside .. "/link/file", inside .. "/linked", outside .. "/none"}
for name, read in pairs(readers) do
  for _, path in ipairs(paths) do
    -- a given folder is one in which names are looked up: names in it may not leave it
    local given = name:find "[{]folder" or name:find "[{]package"
    if not (given and path:find "linked$") then
      local ok, message = pcall(read, path)
      message = tostring(message)
      local says = message:find("lies outside of", 1, true) or given and (message:find("no such file", 1, true) or message:find("no package", 1, true))
      assert(not ok and says, ("%s read '%s': %s"):format(name, path, message))
    end
  end
end

-- a world in Lua is a program
local ok, message = pcall(clench.load, inside .. "/world.lua")
assert(not ok and message:find "a world in Lua is a program", message)

-- --- writing: never through a link inside the folder ---

for name, write in pairs(writers) do
  local failed, why = pcall(write, inside .. "/link/" .. name:gsub("%W", "_"))
  assert(not failed and tostring(why):find("a link leads out of", 1, true), ("%s wrote through a link: %s"):format(name, tostring(why)))
  if not name:find "{" then
    -- outside of the confined folder, a script may write to paths that it names itself
    local done, problem = pcall(write, outside .. "/written/" .. name:gsub("%W", "_"))
    assert(done, ("%s: %s"):format(name, tostring(problem)))
  end
end
-- --- ports: any device or socket that a script names, but none through a link inside the folder ---

local line <close> = clench.port.pty()
clench.port.serial {path = line.path}:close()
local listener <close> = clench.port.listen {path = outside .. "/written/socket"}
clench.port.connect(outside .. "/written/socket"):close()
for _, open in ipairs {function(path) clench.port.serial {path = path} end, clench.port.connect} do
  local opened, reason = pcall(open, inside .. "/link/written/socket")
  assert(not opened and tostring(reason):find("a link leads out of", 1, true), tostring(reason))
end
print "all confined"
