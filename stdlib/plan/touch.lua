--- Links that may and must touch in a grasp: fingertip grasps, power grasps, or links by their names.
local described = require "clench.described"
local opposition = require "clench.plan.opposition"
local touch = {}

-- the last link of each finger that has a surface
local function fingertips(hand)
  local tips = {}
  for _, finger in ipairs(opposition.fingers(hand)) do
    for i = #finger.links, 1, -1 do
      if finger.links[i].mesh then
        tips[#tips + 1] = finger.links[i].name
        break
      end
    end
  end
  return tips
end

-- the base and all links outside of the fingers
local function palm(hand)
  local in_finger, names = {}, {}
  for _, finger in ipairs(opposition.fingers(hand)) do
    for _, link in ipairs(finger.links) do in_finger[link.name] = true end
  end
  if hand.base.mesh then names[1] = hand.base.name end
  for _, link in ipairs(hand.links) do
    if link.mesh and not in_finger[link.name] then names[#names + 1] = link.name end
  end
  return names
end

local kinds = {
  any = function() end,
  fingertip = function(hand) return {may = fingertips(hand), must = {}} end,
  power = function(hand, read)
    local names = palm(hand)
    if #names == 0 then read:fail("contacts: 'power' requires a palm with a surface, which this hand does not have") end
    return {must = {names}}
  end,
}

local function link_name(read, hand, place, name)
  if type(name) ~= "string" then read:expected(place, "the name of a link", name) end
  local ok, link = pcall(hand.link, hand, name)
  if not ok then read:fail("%s: %s", place, (tostring(link):gsub("^.-hand:link: ", ""))) end
  return link.name
end

local function read_names(read, hand, place, list)
  if type(list) ~= "table" then read:expected(place, "a list of names of links", list) end
  local names = {}
  for i, name in ipairs(list) do names[i] = link_name(read, hand, ("%s[%d]"):format(place, i), name) end
  return names
end

local function read_links(read, hand, given)
  if type(given) ~= "table" then read:expected("touch", "a table {must =, may =} of names of links", given) end
  local own = read:table "touch"
  local must, may = own:raw "must" or {}, own:raw "may"
  own:done()
  local out = {must = {}, may = may and read_names(read, hand, "touch.may", may)}
  if type(must) ~= "table" then read:expected("touch.must", "a list of names of links", must) end
  for i, names in ipairs(must) do
    local place = ("touch.must[%d]"):format(i)
    out.must[i] = type(names) == "table" and read_names(read, hand, place, names) or {link_name(read, hand, place, names)}
  end
  return out
end

--- The options `contacts` and `touch` of a planner.
---@return {may?: string[], must: string[][]}?  must: of each list at least one link must touch
function touch.read(read, hand)
  local contacts, links = read:raw "contacts", read:raw "touch"
  if contacts ~= nil and links ~= nil then read:fail("expected contacts or touch, got both") end
  if links ~= nil then return read_links(read, hand, links) end
  local kind = kinds[contacts == nil and "any" or contacts]
  if not kind then read:expected("contacts", "'fingertip', 'power' or 'any'", contacts) end
  return kind(hand, read)
end

touch.forbidden, touch.missing = "touched with links that may not touch", "not touched with all links that must touch"

local function has_any(set, names)
  for _, name in ipairs(names) do
    if set[name] then return true end
  end
  return false
end

--- returns  nil, or the fault of the links that touch
function touch.fault(wanted, grasp)
  if not wanted then return nil end
  local touching, may = {}, {}
  for _, name in ipairs(grasp.links) do touching[name] = true end
  for _, name in ipairs(wanted.may or {}) do may[name] = true end
  if wanted.may then
    for name in pairs(touching) do
      if not may[name] then return touch.forbidden end
    end
  end
  for _, names in ipairs(wanted.must) do
    if not has_any(touching, names) then return touch.missing end
  end
end

return touch
