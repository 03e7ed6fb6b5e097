--- Causes of a search without grasps that lie in the world or in the limits of the search, not in the candidates.
local circumstances = {}

local few_steps, few_candidates = 500, 20
local near = 0.1  -- distance within which a body may be in the way of the hand [m]
local max_named = 4

local function surfaces(hand)
  local list = {}
  for _, body in ipairs(hand.bodies) do
    if body.mesh then list[#list + 1] = body end
  end
  return list
end

--- The robot of the search carries another one.
---@param job table  of clench.plan.job
---@return string?
function circumstances.is_arm(job)
  for _, robot in ipairs(job.given_world.robots) do
    if robot.parent and robot.parent.name == job.hand.name then
      return ("the search moves %s, which carries %s: choose %s as the hand"):format(job.hand.name, robot.name, robot.name)
    end
  end
end

--- The hand passes through an object with which it does not collide.
---@return string?
function circumstances.collisions_off(job)
  for _, body in ipairs(surfaces(job.hand)) do
    if job.world:may_collide(body, job.object) then return nil end
  end
  return ("the collisions of %s and %s are switched off, so that the hand passes through the object: switch them on"):format(job.hand.name, job.object.name)
end

--- Without any friction, contacts press along their normals only.
---@return string?
function circumstances.no_friction(job)
  local list = surfaces(job.hand)
  for _, body in ipairs(list) do
    if job.world:friction(body.material, job.object.material) > 0 then return nil end
  end
  if #list == 0 then return nil end
  return ("the friction between %s and %s is 0: contacts press along their normals only, and few objects can be held so; set the friction of their materials"):format(job.hand.name, job.object.name)
end

--- Bodies near an object, if most candidates collide before they move.
---@return string?
function circumstances.crowded(job, stats)
  local count = stats.rejected and stats.rejected["in collision at the start"] or 0
  if count == 0 or 2 * count < stats.candidates then return nil end
  local texts, is_hand = {}, {}
  for _, body in ipairs(job.hand.bodies) do is_hand[body.name] = true end
  for _, body in ipairs(job.world.bodies) do
    local distance = body ~= job.object and not is_hand[body.name] and job.world:distance(job.object, body) or math.huge
    if distance < near and #texts < max_named then texts[#texts + 1] = distance == 0 and ("%s touches or overlaps it"):format(body.name) or ("%s is %.0f mm from it"):format(body.name, 1000 * distance) end
  end
  if #texts == 0 then return nil end
  return ("the hand finds too little space around %s: %s; move them apart"):format(job.object.name, table.concat(texts, ", "))
end

--- A search that was ended before it could find much.
---@return string?
function circumstances.too_short(stats)
  if stats.out_of_time and stats.candidates then
    return ("the time was over after %.3g s, before all %d candidates were tried: allow more seconds"):format(stats.seconds, stats.candidates)
  end
  if stats.steps and stats.steps > 0 and stats.steps < few_steps then return ("the search made only %d steps: use more steps"):format(stats.steps) end
  if stats.candidates and stats.candidates > 0 and stats.candidates < few_candidates and not stats.primitives then
    return ("only %d candidate%s tried: use more candidates"):format(stats.candidates, stats.candidates == 1 and " was" or "s were")
  end
end

return circumstances
