-- What `clench check` says of files.
local test, report = require "test", require "clench.report"

test("a body is told with its numbers", function(t)
  local r = report.of "models/objects/flask.iv"
  t.equal(r.kind, "body")
  t.equal(r.wrong, nil)
  local body = clench.world():add_object "models/objects/flask.iv"
  t.equal(r.understood.mass, body.mass)
  t.equal(r.understood.mesh.triangles, body.mesh.triangle_count)
  t.ok(r.understood.mesh.watertight)
end)

test("a robot is told link by link and DOF by DOF", function(t)
  local r = report.of "models/hands/barrett/barrett.cfg"
  t.equal(r.kind, "robot")
  t.equal(#r.understood.dofs, 4)
  t.equal(r.understood.dofs[2].kind, "breakaway")
  t.equal(r.understood.dofs[2].unit, "rad")
  t.equal(#r.understood.chains, 3)
  t.equal(#r.understood.chains[1].joints, 3)
  t.ok(r.understood.eigengrasps >= 1)
end)

test("a world is told with what it holds", function(t)
  local r = report.of "worlds/dlr_flask.wld"
  t.equal(r.kind, "world")
  t.equal(#r.understood.objects, 1)
  t.equal(#r.understood.robots, 1)
  t.equal(#r.understood.overlaps, 0)
end)

test("what is wrong is one sentence, and the log is as it was", function(t)
  local r = report.of "no/such.wld"
  t.equal(r.understood, nil)
  t.ok(r.wrong:find("no such file: no/such.wld", 1, true))
  local heard
  clench.log.sink(function(_, text) heard = text end)
  report.of "tests/data/bad/wld/empty.wld"
  clench.log.sink()
  t.equal(heard, nil)
end)

test("what a file leaves unused is among the ignored", function(t)
  local path = os.tmpname() .. ".wld"
  local file = assert(io.open(path, "w"))
  file:write("Camera\n0 0 0 0 0 0 1\n")
  file:close()
  local r = report.of(path)
  os.remove(path)
  t.equal(r.wrong, nil)
  t.equal(#r.ignored, 1)
  t.ok(r.ignored[1]:find "first line")
end)

test("eigengrasps and virtual contacts are told with their counts", function(t)
  local folder = os.tmpname()
  os.remove(folder)
  local hand = clench.world():add_robot "models/hands/barrett/barrett.cfg"
  local egr, vgr = folder .. ".egr", folder .. ".vgr"
  hand.eigengrasps:save(egr)
  hand:save_virtual_contacts(vgr)
  local grasps, contacts = report.of(egr), report.of(vgr)
  os.remove(egr)
  os.remove(vgr)
  t.equal(grasps.wrong, nil)
  t.equal(grasps.understood, {dofs = 4, count = #hand.eigengrasps.vectors})
  t.equal(contacts.wrong, nil)
  t.equal(contacts.understood, {count = #hand.virtual_contacts, robot = hand.name})
end)
