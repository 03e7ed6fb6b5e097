--- What the planners that try many starts share: starts in rounds, over threads, until there are grasps enough.
local closing = require "clench.plan.closing"
local distinct = require "clench.plan.distinct"
local neighbour = require "clench.plan.neighbour"
local batch = {}

local chunk, chunks = 2, 32  -- states that one call tries, so few that what is found is soon told; calls of a round

-- Once there are grasps, each second pair of starts begins near those, as long as that succeeds no less often than elsewhere; otherwise
-- each eighth.
local function near_by_turns(founders, tally)
  local function near_is_good()
    local near, elsewhere = tally.near, tally.elsewhere
    return near.found * elsewhere.tried >= elsewhere.found * near.tried
  end
  return function(number)
    return #founders > 0 and number % 4 >= 2 and (near_is_good() or number % 16 >= 14)
  end
end

local function start_near(job, founders, number)
  local hand = job.hand
  local approach = hand.pose:inverse() * hand.approach.point  -- in its base
  local random = clench.random(job.seed, -number)
  local founder = founders[random:integer(1, #founders)]
  local state = neighbour(founder.start, founder.grasp.pose * approach, random, random:uniform(0.5, 3), hand, job.object)
  state.is_near = true
  return state
end

local nothing_recorded = {known = {}, is_ended = function() return false end, note = function() end}

--- Tries one start after the other, in rounds that do not depend on the threads.
---@param job table  of clench.plan.job
---@param told table  of clench.plan.report; `complete`: did the search end by itself, rather than by time or a signal?
---@param next_state? fun(number: integer): table?  nil: no more; absent: the search ended before its starts were prepared
---@param options {planner: string, limit: integer, count?: integer, distance?: number, near_found?: boolean, approach?: number, back?: table, refine?: integer, verify?: table, on_grasp?: fun(grasp: grasp), journal?: table}  journal: of clench.plan.journal: starts that it knows are not tried again
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
  local is_near_turn = options.near_found and near_by_turns(founders, tally) or function() return false end
  local function tally_of(is_near) return is_near and tally.near or tally.elsewhere end
  local bar <close> = clench.progress(options.limit, job.subject)
  local tried = 0
  -- whichever ends the search: all that may be tried, or grasps enough
  local function show()
    tried = tried + chunk
    local part = math.min(1, math.max(tried / options.limit, options.count and unlike / options.count or 0))
    bar:step(math.max(0, part * options.limit - bar.done), ("%d grasps"):format(#found))
  end

  local journal = options.journal or nothing_recorded
  local out_of_time = false

  ---@param piece {first: integer, count: integer, known?: table}
  local function take(result, piece)
    if result.error then
      if result.kind == "stopped" then return end  -- by Ctrl-C, which is told apart
      told.rejected[result.error] = (told.rejected[result.error] or 0) + 1
      return
    end
    if not result.counted then
      result.counted = true
      for why, count in pairs(result.rejected) do
        told.rejected[why] = (told.rejected[why] or 0) + count
        if why == "lost when shaken" then told.shaken = told.shaken + count end
      end
    end
    if result.rejected["no time left"] then out_of_time = true end
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
        local of_its_kind = tally_of(new.start.is_near)
        of_its_kind.found = of_its_kind.found + 1
        if options.on_grasp and not piece.known then options.on_grasp(new.grasp) end
      end
    end
    if piece.known then
      journal.known[piece.first] = nil
    elseif not result.noted and not result.rejected["no time left"] then
      result.noted = true
      journal:note(piece.first, piece.count, result)
    end
    show()
  end

  -- the next starts of one call; nil: no more
  local function next_piece()
    local first, states = number + 1, {}
    local known = journal.known[first]
    while number < options.limit and #states < (known and known.count or chunk) do
      local is_near = is_near_turn(number + 1)
      local state = known and {} or is_near and start_near(job, founders, number + 1) or next_state(number + 1)
      if not state then break end
      number = number + 1
      state.number = number
      local of_its_kind = tally_of(is_near)
      of_its_kind.tried = of_its_kind.tried + 1
      states[#states + 1] = state
    end
    return #states > 0 and {first = first, count = #states, states = states, known = known} or nil
  end

  local exhausted = false

  -- what is known takes its place among what is tried, so that the order is that of a search without a break
  local function run_round()
    local pieces, items, tried_pieces = {}, {}, {}
    for i = 1, chunks do
      local piece = next_piece()
      if not piece then
        exhausted = true
        break
      end
      piece.place = i
      pieces[i] = piece
      if not piece.known then
        items[#items + 1] = piece.states
        tried_pieces[#tried_pieces + 1] = piece
      end
    end
    local done = 0
    local function take_known(up_to)
      while done < up_to do
        local piece = pieces[done + 1]
        if piece.known then take(piece.known, piece) end
        done = done + 1
      end
    end
    if #items > 0 then
      shared.over = job.seconds and job.began + job.seconds
      clench.parallel.map("clench.plan.batch_worker", items, {threads = job.threads, shared = shared, each = function(result, i)
        local piece = tried_pieces[i]
        take_known(piece.place - 1)
        take(result, piece)
      end})
    end
    take_known(#pieces)
  end

  local function is_enough() return options.count and unlike >= options.count end
  -- a round of which something is known is tried to its end
  local function goes_on()
    return next_state and job:goes_on() and not journal:is_ended() and not exhausted and (not is_enough() or next(journal.known) ~= nil)
  end

  job:search_in_time(function()
    while goes_on() do run_round() end
  end)
  told.candidates = number
  if number == 0 then told.late_start = job:late_start() end
  told.complete = not job.stopped and not job.cancelled and not journal:is_ended() and not out_of_time and (exhausted or is_enough() or false)
  -- what was known of later starts is kept when the search ends before them
  for _, piece in ipairs(options.journal and options.journal:rest() or {}) do take(piece.known, piece) end
  return found
end

--- the largest epsilon first; of equal ones the earlier; those that no search has numbered last
function batch.sort(found)
  table.sort(found, function(a, b)
    if a.epsilon ~= b.epsilon then return a.epsilon > b.epsilon end
    return (a.info.number or math.huge) < (b.info.number or math.huge)
  end)
  return found
end

return batch
