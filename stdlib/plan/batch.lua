--- Shared by the planners that try many starts: starts are tried in rounds, over threads, until enough grasps are found.
local call_script = require "clench.call_script"
local closing = require "clench.plan.closing"
local distinct = require "clench.plan.distinct"
local is_stopped = require "clench.is_stopped"
local neighbor = require "clench.plan.neighbor"
local verification = require "clench.plan.verification"
local batch = {}

local chunk, chunks = 2, 32  -- states per call, few so that grasps are reported soon; calls per round

-- Once there are grasps, every second pair of starts is sampled near them while such starts succeed at least as often as others;
-- otherwise every eighth.
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
  local approach = hand.pose:inverse() * hand.approach.point  -- in the frame of its base
  local random = clench.random(job.seed, -number)
  local founder = founders[random:integer(1, #founders)]
  local state = neighbor(founder.start, founder.grasp.pose * approach, random, random:uniform(0.5, 3), hand, job.object)
  state.is_near = true
  return state
end

local nothing_recorded = {known = {}, is_ended = function() return false end, note = function() end}

local causes_shown = 2

--- "640 candidates, 3 grasps; no force closure 310, too weak against loads 120"
---@param state {candidates: integer, grasps: integer, rejected: table<string, integer>, hint?: string}
---@return string
function batch.text(state)
  local causes = {}
  for why in pairs(state.rejected) do
    if why ~= "no time left" then causes[#causes + 1] = why end
  end
  table.sort(causes, function(a, b)
    if state.rejected[a] ~= state.rejected[b] then return state.rejected[a] > state.rejected[b] end
    return a < b
  end)
  for i, why in ipairs(causes) do causes[i] = ("%s %d"):format(why, state.rejected[why]) end
  local text = ("%d candidates, %d grasps"):format(state.candidates, state.grasps)
  if #causes > 0 then text = text .. "; " .. table.concat(causes, ", ", 1, math.min(causes_shown, #causes)) end
  return state.hint and text .. "; " .. state.hint or text
end

--- Tries starts in rounds whose results do not depend on the number of threads.
---@param job table  of clench.plan.job
---@param stats table  of clench.plan.report; sets `complete`: false if the time, a signal or a cancellation ended the search
---@param next_state? fun(number: integer): table?  returns nil after the last start; absent: the search ended before its starts were prepared
---@param options {planner: string, limit: integer, count?: integer, keep_searching?: boolean, distance?: number, near_found?: boolean, approach?: number, back?: table, refine?: integer, verify?: table, on_grasp?: fun(grasp: grasp), on_progress?: fun(state: table), hint?: (fun(found: integer): string?), journal?: table}  keep_searching: the search does not end at `count` grasps; hint: called after each round until it returns a sentence; journal: of clench.plan.journal; starts that it records are not tried again
---@return grasp[]  may be more than `count`: rounds are completed, and similar grasps count once
function batch.try(job, stats, next_state, options)
  stats.candidates, stats.rejected = 0, {}
  local shared = {hand = job.hand, object = job.object, approach = options.approach, back = options.back,
                  grasp = job.grasp_options, refine = options.refine or 0, verify = options.verify, touch = job.touch, seed = job.seed}
  stats.verify = options.verify
  if options.verify and options.verify.shake then stats.shaken, stats.survived = 0, 0 end
  local found, founders, number, unlike = {}, {}, 0, 0
  local is_new = distinct(job.hand, job.object, options.distance or 0)
  local tally = {near = {tried = 0, found = 0}, elsewhere = {tried = 0, found = 0}}
  local is_near_turn = options.near_found and near_by_turns(founders, tally) or function() return false end
  local function tally_of(is_near) return is_near and tally.near or tally.elsewhere end
  local bar <close> = clench.progress(options.limit, job.subject)
  local tried = 0
  local count = not options.keep_searching and options.count or nil
  -- progress towards the limit of starts, towards `count` grasps, or towards the end of the time, whichever is furthest
  local function show()
    tried = tried + chunk
    local in_time = job.seconds and job:elapsed() / job.seconds or 0
    local part = math.min(1, math.max(tried / options.limit, count and unlike / count or 0, in_time))
    local state = {candidates = math.min(tried, number), grasps = #found, rejected = stats.rejected, elapsed = job:elapsed(), hint = stats.hint}
    bar:step(math.max(0, part * options.limit - bar.done), batch.text(state))
    if options.on_progress then call_script(job.subject .. ": on_progress", options.on_progress, state) end
  end

  local journal = options.journal or nothing_recorded
  local out_of_time = false

  local function note_shaken(count, survived)
    stats.shaken, stats.survived = (stats.shaken or 0) + count, (stats.survived or 0) + survived
  end

  ---@param piece {first: integer, count: integer, known?: table}
  local function take(result, piece)
    if result.error then
      if is_stopped(result) then  -- by the deadline or by Ctrl-C
        out_of_time = true
        return
      end
      stats.rejected[result.error] = (stats.rejected[result.error] or 0) + 1
      return
    end
    if not result.counted then
      result.counted = true
      for why, count in pairs(result.rejected) do
        stats.rejected[why] = (stats.rejected[why] or 0) + count
        if why == verification.lost_when_shaken then note_shaken(count, 0) end
      end
    end
    if result.rejected["no time left"] then out_of_time = true end
    if result.best_load then stats.best_load = math.max(result.best_load, stats.best_load or 0) end
    for _, new in ipairs(result.grasps) do
      local numbers = new.numbers or {}
      numbers.number, numbers.seed = new.number, job.seed
      -- `take` is called again with the same result if Ctrl-C interrupted it
      if not new.taken then
        new.taken = true
        if numbers.survived then note_shaken(1, numbers.survived) end
        found[#found + 1] = closing.note(new.grasp, options.planner, numbers)
        founders[#founders + 1] = new
        if is_new(new.grasp) then unlike = unlike + 1 end
        local of_its_kind = tally_of(new.start.is_near)
        of_its_kind.found = of_its_kind.found + 1
        if options.on_grasp and not piece.known then call_script(job.subject .. ": on_grasp", options.on_grasp, new.grasp) end
      end
    end
    if piece.known then
      journal.known[piece.first] = nil
    elseif not result.noted and not result.rejected["no time left"] then
      journal:note(piece.first, piece.count, result)
      result.noted = true
    end
    show()
  end

  -- the next starts for one call; nil: there are no more
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

  -- recorded pieces are taken in their place among the tried ones: the order is that of an uninterrupted search
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

  local function is_enough() return count and unlike >= count end
  -- rounds with recorded pieces are completed
  local function goes_on()
    return next_state and job:goes_on() and not journal:is_ended() and not exhausted and (not is_enough() or next(journal.known) ~= nil)
  end

  local ended = job:search_in_time(function()
    while goes_on() do
      run_round()
      if options.hint and not stats.hint then stats.hint = options.hint(#found) end
    end
    return true
  end)
  stats.candidates, stats.hint = number, nil
  if number == 0 then stats.late_start = job:late_start() end
  stats.out_of_time = out_of_time or nil
  stats.complete = ended == true and not job.stopped and not journal:is_ended() and not out_of_time
    and (exhausted or is_enough() or false)
  -- recorded pieces of later starts are kept if the search ends before them
  for _, piece in ipairs(options.journal and options.journal:rest() or {}) do take(piece.known, piece) end
  return found
end

--- Sorts by decreasing epsilon, then by start number; grasps without a number come last.
function batch.sort(found)
  table.sort(found, function(a, b)
    if a.epsilon ~= b.epsilon then return a.epsilon > b.epsilon end
    return (a.info.number or math.huge) < (b.info.number or math.huge)
  end)
  return found
end

return batch
