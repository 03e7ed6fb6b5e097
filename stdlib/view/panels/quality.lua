--- Measures of the current grasp that the user has chosen, and its contacts with their forces; both are updated when something moves.
local curves = require "clench.view.curves"
local replay = require "clench.view.replay"
local units = require "clench.view.units"
local gray = {0.5, 0.5, 0.5}

local function measured(grasp, name)
  local ok, value = pcall(grasp.quality, grasp, name)
  return ok and value or nil, not ok and tostring(value) or nil
end

local function refresh(view)
  local session = view.session
  if not (session.hand and session.object) then return nil end
  local hand, object = replay.shown(view, session.hand), replay.shown(view, session.object)
  if not (hand and object) then return nil end
  local contacts = replay.world(view):contacts(hand, object)
  local quality = {contacts = contacts, measures = {}, errors = {}}
  if #contacts == 0 then return quality end
  local ok, grasp = pcall(clench.grasp, hand, object)
  if not ok then
    quality.error = tostring(grasp)
    return quality
  end
  for _, name in ipairs(view.measures) do quality.measures[name], quality.errors[name] = measured(grasp, name) end
  return quality
end

local function index_of(list, name)
  for i, item in ipairs(list) do
    if item == name then return i end
  end
end

-- a combo of the measures that are not yet shown
local function draw_choice(view, ui)
  local names, by_name = {"Add a measure"}, {}
  for _, measure in ipairs(view.known_measures) do
    by_name[measure.name] = measure
    if not index_of(view.measures, measure.name) then names[#names + 1] = measure.name end
  end
  ui:width(-50 * view.scale)
  local chosen, changed = ui:combo("more", 1, names)
  if changed and chosen > 1 then
    view.measures[#view.measures + 1] = names[chosen]
    view.quality_stamp = nil
  end
  return by_name
end

local function draw_measures(view, ui, quality)
  local by_name = draw_choice(view, ui)
  local dropped
  ui:table("measures", {"measure", "value", "##drop"}, {}, function(ui)
    for i, name in ipairs(view.measures) do
      local measure, value = by_name[name], quality.measures[name]
      ui:next_column() ui:text(name)
      ui:tooltip(("%s\nrange %s%s\n%s"):format(measure.what, measure.range, measure.unit ~= "1" and ", " .. measure.unit or "", measure.source))
      ui:next_column()
      ui:text(not value and "–" or value ~= value and "not a number" or ("%.4g%s"):format(value, measure.unit ~= "1" and " " .. measure.unit or ""))
      if quality.errors[name] then ui:tooltip(quality.errors[name]) end
      ui:next_column()
      if ui:button("x##drop" .. name) then dropped = i end
      ui:tooltip("Do not show " .. name)
    end
  end)
  if dropped then table.remove(view.measures, dropped) end
end

local function short_name(contact, hand)
  local name = contact.link and contact.link.name or contact.other.name
  local start = hand.name .. "_"
  return name:sub(1, #start) == start and name:sub(#start + 1) or name
end

local function draw_contacts(view, ui, contacts)
  ui:text(#contacts == 1 and "1 contact" or ("%d contacts"):format(#contacts))
  if #contacts == 0 then return end
  local known = false  -- are there forces?
  for _, contact in ipairs(contacts) do known = known or contact.force ~= nil and contact.force:norm() > 0 end
  -- columns are as wide as their texts when a table appears
  ui:table(known and "contacts with forces" or "contacts", {"link", "fx", "fy", "fz [N]"}, {}, function(ui)
    for i, contact in ipairs(contacts) do
      local force = contact.force
      ui:next_column()
      if ui:selectable(("%d %s##contact%d"):format(i, short_name(contact, view.session.hand), i), view.highlighted == i) then
        view.highlighted = view.highlighted ~= i and i or nil
        view.listed = view.highlighted
      end
      if view.highlighted == i and view.listed ~= i then
        view.listed, view.needs_frame = i, true
        ui:reveal()  -- it was clicked in the picture
      end
      local p = contact.point
      ui:tooltip(("at %s, %s, %s, mu %.3g, gap %s%s"):format(units.text(view, p.x, "m"), units.text(view, p.y, "m"), units.text(view, p.z, "m"), contact.mu,
                                                       units.text(view, contact.gap, "m"), known and "" or "; forces are known after dynamics have run"))
      for _, axis in ipairs {"x", "y", "z"} do
        ui:next_column()
        ui:text(known and ("%.2f"):format(force[axis] + 0.0):gsub("^%-(0%.00)$", "%1") or "–")
      end
    end
  end)
end

local function draw(ui, view)
  local session = view.session
  view.measures, view.known_measures = view.measures or {"epsilon", "volume"}, view.known_measures or clench.measures()
  if view.quality_stamp ~= view.stamp then
    view.quality, view.quality_stamp = refresh(view), view.stamp
    curves.sample(view)
  end
  local quality = view.quality
  if not quality then return ui:text(view.replay and "The recorded state lacks the hand or the object." or "A hand and an object are needed.", {color = gray, wrap = true}) end
  ui:text(("%s on %s"):format(session.hand.name, session.object.name))
  if quality.error then ui:text(quality.error, {wrap = true}) end
  draw_measures(view, ui, quality)
  ui:separator()
  draw_contacts(view, ui, quality.contacts)
end

return {name = "Grasp Quality", place = "left", draw = draw}
