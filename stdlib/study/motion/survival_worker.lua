--- Work of a thread on a grasp: computes its measures, and whether it survives shaking. For clench.parallel.map.
local held_load = require "clench.study.motion.held_load"

local own = {
  contacts = function(grasp) return #grasp.points end,
  load_margin = function(grasp, object) return held_load.of(object, grasp, held_load.force_ratio) end,
}

---@param grasp grasp
---@param shared {hand: robot, object: body, measures: string[], shake: table}
return function(grasp, shared)
  local hand, object = shared.hand, shared.object
  local placed = grasp:apply(hand.world, {hand = hand, object = object})
  local values = {}
  for _, name in ipairs(shared.measures) do
    if not own[name] then
      values[name] = placed:quality(name)
    else
      values[name] = #placed.points == 0 and 0 or own[name](placed, object)
    end
  end
  local options = {hand = hand, object = object}
  for key, value in pairs(shared.shake) do options[key] = value end
  local verdict = clench.study.shake(options)
  return {values = values, survived = verdict.survived, held = verdict.held, protocol = verdict.asked}
end
