--- Contacts in the form of the text protocol: those of one body, in its contact frames, with the forces on it.
local lists = require "clench.control.text.lists"
local units = require "clench.control.text.units"

local line = units.line
local commands = {}

-- axes of the original's contact frame: its third is the inward normal, the first two follow from the body's x axis
local function axes_of(n)
  local x = math.abs(n.x) > 1 - 1e-9 and clench.vec3(0, 0, 1) or clench.vec3(1, 0, 0)
  local tx = n:cross(x)
  tx = tx / tx:norm()
  return tx, n:cross(tx)
end

-- a contact as of one of its bodies: position in the body's frame [m], wrench in the contact frame [N, N m]
local function seen_from(body, contact)
  local is_first = contact.body == body
  local to_body = body.pose:inverse()
  local normal = is_first and contact.normal or -contact.normal
  local force = is_first and contact.force or -contact.force
  -- contact.point lies on the first body; the surface of the second one is away from it by the gap
  local point = is_first and contact.point or contact.point - contact.normal * contact.gap
  local n, f = to_body:rotate(normal), to_body:rotate(force)
  local tx, ty = axes_of(n)
  return {wrench = {f:dot(tx), f:dot(ty), f:dot(n), 0, 0, contact.torsion}, point = to_body * point, gap = contact.gap}
end

local function contacts_of(body)
  local list = {}
  for i, contact in ipairs(body.contacts) do list[i] = seen_from(body, contact) end
  return list
end

local function millimeters(p) return line {p.x * 1e3, p.y * 1e3, p.z * 1e3} end

-- lines of the contacts of one body; kinds: number of data items of each, 1 to 3
local function report(reply, body, kinds, threshold)
  local contacts = contacts_of(body)
  reply[#reply + 1] = tostring(#contacts)
  for _, contact in ipairs(contacts) do
    reply[#reply + 1] = line(contact.wrench)
    if kinds > 1 then reply[#reply + 1] = millimeters(contact.point) end
    if kinds > 2 then reply[#reply + 1] = units.text(1e3 * math.max(0, threshold / 2 - contact.gap)) end
  end
end

-- getContacts k L
function commands.getContacts(world, words)
  local kinds = words:index "the number of data items, 1 to 3"
  if kinds < 1 or kinds > 3 then words.fail("getContacts: expected 1 to 3 data items, got %d", kinds) end
  local bodies, reply = lists.read(words, "body", world.bodies)
  words:done()
  for _, body in ipairs(bodies) do report(reply, body, kinds, world.contact_threshold) end
  return reply
end

-- getAverageContacts L
function commands.getAverageContacts(world, words)
  local bodies, reply = lists.read(words, "body", world.bodies)
  words:done()
  for _, body in ipairs(bodies) do
    local contacts = contacts_of(body)
    local wrench, point, count = {0, 0, 0, 0, 0, 0}, clench.vec3(0, 0, 0), math.max(1, #contacts)
    for _, contact in ipairs(contacts) do
      for i = 1, 6 do wrench[i] = wrench[i] + contact.wrench[i] / count end
      point = point + contact.point / count
    end
    reply[#reply + 1], reply[#reply + 2] = line(wrench), millimeters(point)
  end
  return reply
end

return commands
