--- Warns of collisions before a search; grasps are not rejected for them.
local script_line = require "clench.script_line"
local supports = require "clench.plan.supports"

-- Names of the pairs in which a body or robot overlaps others, except robots that move in the search and supports of an object; false if there are no such
-- pairs.
local function overlaps(world, thing, moved, stands_on)
  local names = {}
  for _, pair in ipairs(world:colliding(thing)) do
    local a, b = pair[1].robot, pair[2].robot
    local stands = stands_on and (stands_on[pair[1].name] or stands_on[pair[2].name])
    if not (stands or a and moved[a.name] or b and moved[b.name]) then
      names[#names + 1] = ("%s and %s"):format(pair[1].name, pair[2].name)
    end
  end
  return #names > 0 and table.concat(names, ", ")
end

---@param subject string  of the warnings
return function(subject, world, hand, object)
  local moved = {[hand.name] = true}
  local of_arm = hand.parent and overlaps(world, hand.parent, {})
  if of_arm then
    clench.log.warning(script_line() .. ("%s: '%s' collides before anything moves; grasps are not rejected for these collisions: %s"):format(
      subject, hand.parent.name, of_arm))
  end
  if hand.parent then moved[hand.parent.name] = true end
  local stands_on = {}
  for _, body in ipairs(supports.of(hand, object).touched) do stands_on[body.name] = true end
  local of_object = overlaps(world, object, moved, stands_on)
  if of_object then
    clench.log.warning(script_line() .. ("%s: the object overlaps other bodies before anything moves; grasps are not rejected for these overlaps: %s"):format(
      subject, of_object))
  end
end
