--- Grasps as rows of numbers for the tables of reports.

-- rounded to integers
local function degrees(x) return math.floor(clench.deg(x) + 0.5) end

--- The direction from which a hand comes that moves along a direction of the world: azimuth from +x towards +y, and elevation.
local function comes_from(direction)
  local d = -direction / direction:norm()
  return degrees(math.atan(d.y, d.x)), degrees(math.asin(math.max(-1, math.min(1, d.z))))
end

--- Puts the world into the state of each grasp in turn, and restores it.
---@param hand robot
---@param object body
---@param grasps grasp[]
---@param visit? fun(row: table, grasp: grasp)  called while the hand holds the object
---@return table[] rows  number, epsilon, load [weights] and perturbed (nil if not verified), held (directions, nil if not shaken), contacts, azimuth and elevation [degrees]
return function(hand, object, grasps, visit)
  local world, rows = hand.world, {}
  local here <close> = world:snapshot()
  for i, grasp in ipairs(grasps) do
    grasp:apply(world, {hand = hand, object = object})
    local azimuth, elevation = comes_from(hand.approach.direction)
    local info = grasp.info
    rows[i] = {number = i, epsilon = grasp.epsilon, load = info.load_margin, perturbed = info.perturbed_epsilon,
               held = info.directions_held, contacts = #grasp.points, azimuth = azimuth, elevation = elevation}
    if visit then visit(rows[i], grasp) end
  end
  world:restore(here)
  return rows
end
