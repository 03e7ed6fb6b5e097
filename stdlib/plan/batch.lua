--- What the planners that try many starts share: starts in rounds, over threads, until there are grasps enough.
local closing = require "clench.plan.closing"
local distinct = require "clench.plan.distinct"
local neighbour = require "clench.plan.neighbour"
local batch = {}

local chunk, chunks = 2, 32  -- states that one call tries, so few that what is found is soon told; calls of a round

-- Once there are grasps, each second pair of starts begins near those, as long as that succeeds no less often than elsewhere; otherwise
-- each eighth.
local function starts_near_found(job, next_state, founders, tally)
  local hand = job.hand
  local approach = hand.pose:inverse() * hand.approach.point  -- in its base
  local function near_is_good()
    local near, elsewhere = tally.near, tally.elsewhere
    return near.found * elsewhere.tried >= elsewhere.found * near.tried
  end
  return function(number)
    if #founders == 0 or number % 4 < 2 or not near_is_good() and number % 16 < 14 then return next_state(number) end
    local random = clench.random(job.seed, -number)
    local founder = founders[random:integer(1, #founders)]
    local state = neighbour(founder.start, founder.grasp.pose * approach, random, random:uniform(0.5, 3), hand, job.object)
    state.is_near = true
    return state
  end
end

--- Tries one start after the other, in rounds that do not depend on the threads.
---@param job table  of clench.plan.job
---@param told table  of clench.plan.report
---@param next_state? fun(number: integer): table?  nil: no more; absent: the search ended before it was there
---@param options {planner: string, limit: integer, count?: integer, distance?: number, near_found?: boolean, approach?: number, back?: table, refine?: integer, verify?: table, on_grasp?: fun(grasp: grasp)}
---@return grasp[]  more than `count`: rounds are tried to their end, and what is alike does not count
function batch.try(job, told, next_state, options)
  told.candidates, told.rejected = 0, {}
  local shared = {hand = job.hand, object = job.object, approach = options.approach, back = options.back,
                  grasp = job.grasp_options, refine = options.refine or 0, verify = options.verify, touch = job.touch, seed = job.seed}
  local shakes = options.verify and options.verify.shake
  told.verify = options.verify
  if shakes then told.shaken, told.survived = 0, 0 end
  local found, founders, number, unlike = {}, {}, 0, 0
  local is_new = distinct(job.hand, job.object, options.distance or 0)
  local tally = {near = {tried = 0, found = 0}, elsewhere = {tried = 0, found = 0}}
  if options.near_found and next_state then next_state = starts_near_found(job, next_state, founders, tally) end
  local function tally_of(state) return state.is_near and tally.near or tally.elsewhere end
  local bar <close> = clench.progress(options.limit, job.subject)
  local tried = 0
  -- whichever ends the search: all that may be tried, or grasps enough
  local function show()
    tried = tried + chunk
    local part = math.min(1, math.max(tried / options.limit, options.count and unlike / options.count or 0))
    bar:step(math.max(0, part * options.limit - bar.done), ("%d grasps"):format(#found))
  end

  local function take(result)
    if result.error then
      if result.kind == "stopped" then return end  -- by Ctrl-C, which is told apart
      told.rejected[result.error] = (told.rejected[result.error] or 0) + 1
      return
    end
    for why, count in pairs(result.rejected) do
      told.rejected[why] = (told.rejected[why] or 0) + count
      if why == "lost when shaken" then told.shaken = told.shaken + count end
    end
    if result.best_load then told.best_load = math.max(result.best_load, told.best_load or 0) end
    for _, new in ipairs(result.grasps) do
      local numbers = new.numbers or {}
      numbers.number, numbers.seed = new.number, job.seed
      -- a call that Ctrl-C has broken off is made again
      if not new.taken then
        new.taken = true
        if shakes then
          told.shaken = told.shaken + 1
          if numbers.survived == 1 then told.survived = told.survived + 1 end
        end
        found[#found + 1] = closing.note(new.grasp, options.planner, numbers)
        founders[#founders + 1] = new
        if is_new(new.grasp) then unlike = unlike + 1 end
        tally_of(new.start).found = tally_of(new.start).found + 1
        if options.on_grasp then options.on_grasp(new.grasp) end
      end
    end
    show()
  end

  job:search_in_time(function()
    while next_state and job:goes_on() and (not options.count or unlike < options.count) do
      local items = {}
      for i = 1, chunks do
        local states = {}
        while #states < chunk and number < options.limit do
          local state = next_state(number + 1)
          if not state then break end
          number = number + 1
          state.number = number
          tally_of(state).tried = tally_of(state).tried + 1
          states[#states + 1] = state
        end
        if #states == 0 then break end
        items[i] = states
      end
      if #items == 0 then break end
      shared.over = job.seconds and job.began + job.seconds
      clench.parallel.map("clench.plan.batch_worker", items, {threads = job.threads, shared = shared, each = take})
    end
  end)
  told.candidates = number
  if number == 0 then told.late_start = job:late_start() end
  return found
end

--- the largest epsilon first; of equal ones the earlier
function batch.sort(found)
  table.sort(found, function(a, b)
    if a.epsilon ~= b.epsilon then return a.epsilon > b.epsilon end
    return a.info.number < b.info.number
  end)
  return found
end

return batch
