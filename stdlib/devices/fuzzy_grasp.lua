local new_options = require "clench.options"

local subject = "devices.fuzzy_grasp"
local max_openings = 100  -- of a chain by one step
local bisections = 30

-- does one of these bodies collide with something other than the hand?
local function collides(world, hand, bodies)
  for _, body in ipairs(bodies) do
    for _, pair in ipairs(world:colliding(body)) do
      if pair[1].robot ~= hand or pair[2].robot ~= hand then return true end
    end
  end
  return false
end

-- Retreats from a collision until it just ends: set(x) sets the retreat, from 0 to max_steps. Returns "free" if there is no collision, "contact", or "failed".
local function retreat(set, is_free, max_steps)
  if is_free() then return "free" end
  for step = 1, max_steps do
    set(step)
    if is_free() then
      local free, blocked = step, step - 1
      for _ = 1, bisections do
        local middle = (free + blocked) / 2
        set(middle)
        if is_free() then free = middle else blocked = middle end
      end
      set(free)
      return "contact"
    end
  end
  return "failed"
end

-- places the palm; backs it off if it collides
local function place_palm(world, hand, pose, step, tries)
  local back = hand.approach.direction * -step
  hand.pose = pose
  return retreat(function(x) hand.pose = clench.pose {xyz = back * x} * pose end, function() return not collides(world, hand, {hand.base}) end, tries)
end

-- the DOFs by which a chain opens, each with its sign
local function openings_of(hand, chain)
  local out, seen, info = {}, {}, hand.dof_info
  for _, joint in ipairs(chain.joints) do
    local d = joint.dof
    if d and not seen[d] and info[d].default_velocity ~= 0 then
      seen[d] = true
      out[#out + 1] = {dof = d, sense = info[d].default_velocity > 0 and -1 or 1}
    end
  end
  return out
end

-- DOFs with those of a chain opened by an angle, as far as their limits allow
local function opened(dofs, limits, openings, angle)
  local out = {table.unpack(dofs)}
  for _, opening in ipairs(openings) do
    local d = opening.dof
    out[d] = math.max(limits[d][1], math.min(limits[d][2], dofs[d] + opening.sense * angle))
  end
  return out
end

-- opens a chain that collides
local function open_chain(world, hand, chain, step)
  local start, limits, openings = hand.dofs, hand.dof_limits, openings_of(hand, chain)
  local function set(x) hand:set_dofs(opened(start, limits, openings, step * x)) end
  return retreat(set, function() return not collides(world, hand, chain.links) end, #openings > 0 and max_openings or 0)
end

--- Moves a hand according to the readings of a tracker and a glove, which agree with the world only roughly: a colliding palm is backed off against
--- the approach direction until it only touches, and each colliding finger is opened until it only touches. If that fails, the hand does not move.
---@param options table
---@option hand robot
---@option pose pose  of the base, as returned by `clench.devices.tracker_map`
---@option dofs? number[]  as returned by `clench.devices.glove_map`; by default the present ones. They are clamped to their limits [rad or m]
---@option back_off? number [m, > 0] = 0.01  step against the approach direction
---@option tries? integer [1 to 1000] = 3  such steps
---@option opening? number [rad or m, > 0] = 0.1  step by which each finger opens
---@return {ok: boolean, palm: string, chains: string[]} # "free", "contact" or "failed", for the palm and for each chain; no chains if the palm has failed
---@effect reads
--- > clench.devices.fuzzy_grasp {hand = hand, pose = hand.pose}.palm  --> free
return function(options)
  local o = new_options(subject, options)
  local hand, pose, dofs = o:get "hand", o:get "pose", o:get "dofs"
  local back_off, tries, opening = o:get "back_off", o:get "tries", o:get "opening"
  o:done()
  local world, old_pose, old_dofs = hand.world, hand.pose, hand.dofs
  local function back(result)
    hand:set_posture(old_pose, old_dofs)
    result.ok = false
    return result
  end
  -- invalid numbers are rejected before anything moves
  hand:set_posture(old_pose, dofs or old_dofs)
  local result = {ok = true, palm = place_palm(world, hand, pose, back_off, tries), chains = {}}
  if result.palm == "failed" then return back(result) end
  for i, chain in ipairs(hand.chains) do
    result.chains[i] = open_chain(world, hand, chain, opening)
    result.ok = result.ok and result.chains[i] ~= "failed"
  end
  return result.ok and result or back(result)
end
