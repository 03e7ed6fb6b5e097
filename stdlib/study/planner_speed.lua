local read_options = require "clench.options"

local all = {"contact", "potential_quality", "guided_potential_quality", "autograsp_quality", "strict_autograsp"}

--- Speed of annealing with a hand and an object on this machine, by energy: GraspIt!'s "Time Test".
---@param options table  hand, object and length of the runs
---@option hand robot  hand of the search
---@option object body  object of the search
---@option energies? string[]  names in clench.energy, all by default
---@option steps? integer [1 to 1000000000] = 1000  number of steps with each energy
---@option seed? integer = 1  seed of the random numbers
---@return {energy: string, steps: integer, seconds: number, steps_per_second: number, accepted: number, in_collision: number}[]  accepted: fraction of the steps; in_collision: colliding neighbors per step
---@effect long
--- > rows = clench.study.planner_speed {hand = hand, object = flask, energies = {"contact"}, steps = 50}
--- > rows[1].energy, rows[1].steps, rows[1].steps_per_second > 0  --> contact, 50, true
--- > clench.study.planner_speed {hand = hand, object = flask, step = 5}  --> error: unknown key 'step'
return function(options)
  local read = read_options("study.planner_speed", options)
  local hand, object, energies = read:get "hand", read:get "object", read:get("energies", all)
  local steps = read:get "steps"
  local seed = read:get "seed"
  read:done()
  local rows = {}
  for i, name in ipairs(energies) do
    local search = clench.annealing {hand = hand, object = object, world = hand.world:clone(), seed = seed,
                                     energy = clench.energy[name] {hand = hand, object = object}}
    local began = clench.clock()
    local taken = search:run(steps)
    local seconds = clench.clock() - began
    local counts = search.counts
    rows[i] = {energy = name, steps = taken, seconds = seconds, steps_per_second = taken / math.max(seconds, 1e-9),
               accepted = counts.accepted / math.max(taken, 1), in_collision = counts.in_collision / math.max(taken, 1)}
  end
  return rows
end
