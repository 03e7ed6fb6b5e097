--- What the planners that try many starts share: starts in rounds, over threads, until there are grasps enough.
local closing = require "clench.plan.closing"
local batch = {}

local chunk, chunks = 4, 16  -- states that one call tries; calls of a round

--- Tries one start after the other, in rounds that do not depend on the threads.
---@param job table  of clench.plan.job
---@param told table  of clench.plan.report
---@param next_state fun(number: integer): table?  nil: no more
---@param options {planner: string, limit: integer, count?: integer, approach?: number, back?: table, refine?: integer, verify?: table, on_grasp?: fun(grasp: grasp)}
---@return grasp[]
function batch.try(job, told, next_state, options)
  told.candidates, told.rejected = 0, {}
  local shared = {hand = job.hand, object = job.object, approach = options.approach, back = options.back,
                  grasp = job.grasp_options, refine = options.refine or 0, verify = options.verify, seed = job.seed,
                  over = job.seconds and job.began + job.seconds}
  local shakes = options.verify and options.verify.shake
  if shakes then told.shaken, told.survived = 0, 0 end
  local found, number = {}, 0
  local bar <close> = clench.progress(options.limit, job.subject)

  local function take(result)
    if result.error then
      told.rejected[result.error] = (told.rejected[result.error] or 0) + 1
      return
    end
    for why, count in pairs(result.rejected) do
      told.rejected[why] = (told.rejected[why] or 0) + count
      if why == "lost when shaken" then told.shaken = told.shaken + count end
    end
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
        if options.on_grasp then options.on_grasp(new.grasp) end
      end
    end
    bar:step(chunk, ("%d grasps"):format(#found))
  end

  job:interruptible(function()
    while not job:is_over() and (not options.count or #found < options.count) do
      local items = {}
      for i = 1, chunks do
        local states = {}
        while #states < chunk and number < options.limit do
          local state = next_state(number + 1)
          if not state then break end
          number = number + 1
          state.number = number
          states[#states + 1] = state
        end
        if #states == 0 then break end
        items[i] = states
      end
      if #items == 0 then break end
      clench.parallel.map("clench.plan.batch_worker", items, {threads = job.threads, shared = shared, each = take})
    end
  end)
  told.candidates = number
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
