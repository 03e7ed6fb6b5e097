--- The energy "dynamic": the time for which the closed hand holds the object in simulation. For clench.energy.dynamic.
local read_options = require "clench.options"

local defaults = {seconds = 0.5, grip_seconds = 0.3, settle = 0.3}

-- sum over all directions of the fraction of the time for which the object was held
local function held_parts(verdict, seconds)
  local sum = 0
  for _, row in ipairs(verdict.directions) do sum = sum + (row.held and 1 or math.min(1, row.time / seconds)) end
  return sum
end

---@param options {hand: robot, object: body, shake?: table, contacts?: string}
---@return fun(): number
return function(options)
  local read = read_options("clench.energy.dynamic", options)
  local hand, object = read:get "hand", read:get "object"
  if object.world ~= hand.world then read:fail("object: '%s' belongs to another world than the hand", object.name) end
  local given = read:get "shake" or {}
  local far = clench.energy.contact {hand = hand, object = object, contacts = read:get "contacts"}
  read:done()
  local shake = {hand = hand, object = object}
  for key, value in pairs(defaults) do shake[key] = value end
  for key, value in pairs(given) do shake[key] = value end

  return function()
    local world = hand.world
    local away = 1 + far()
    local here <close> = world:snapshot()
    hand:autograsp()
    local grasp, energy = clench.grasp(hand, object), away
    if #grasp.points > 1 and grasp:quality "epsilon" > 0 then
      local verdict = clench.study.shake(shake)
      if verdict.settled.held then energy = -held_parts(verdict, shake.seconds) end
    end
    world:restore(here)
    return energy
  end
end
