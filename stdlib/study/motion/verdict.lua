--- What came of moving a grasp.
local verdict = {}

local Verdict = {__name = "verdict"}

-- " along +x, -y", " in lift": what was not held of what was asked
local function where_lost(self)
  local names = {}
  for _, key in ipairs {"rows", "directions", "axes"} do
    for _, row in ipairs(self[key] or {}) do
      if not row.held then names[#names + 1] = row.phase or row.direction or row.axis end
    end
  end
  if not self.settled.held then return " while it was gripped" end
  return (self.rows and " in " or " along ") .. table.concat(names, ", ")
end

function Verdict:__tostring()
  return ("%s: %s"):format(self.survived and "survived" or "lost" .. where_lost(self), self.protocol)
end

---@param asked string  what was done, in a few words
function verdict.new(trial, job, asked)
  local grip = trial.grip == "forces" and ("gripped with %.3g N of normal forces"):format(job.grip_force) or "gripped by closing motors"
  return setmetatable({
    survived = false, held = 0, settled = trial.settled, grip = trial.grip, contacts = trial.contacts, failures = 0, count = 0,
    protocol = ("%s, %.4g kg, %s, %.3g of the friction; displaced by less than %.3g m and %.3g degrees"):format(asked, job.mass, grip,
      job.friction_share, job.max_distance, math.deg(job.max_angle)),
  }, Verdict)
end

--- the row of a test that was not made, as the hand had lost the object while it gripped it
function verdict.lost_before(trial)
  return {moved = trial.settled.moved, turned = trial.settled.turned, held = false, time = 0.0}
end

--- The row of a test that begins where the hand held the object at rest, with the gravity of the job.
---@param watch fun(): table
function verdict.attempt(trial, job, watch)
  if not trial.settled.held then return verdict.lost_before(trial) end
  trial:reset()
  trial.world.gravity = job.gravity
  return watch()
end

--- Appends a row to a list of the result's.
function verdict.add(result, name, row, trial)
  result[name] = result[name] or {}
  table.insert(result[name], row)
  result.count = result.count + 1
  if row.held then result.held = result.held + 1 end
  result.failures = math.max(result.failures, trial.world.report.failures - trial.failures_before)
end

--- Survived is what was held in all rows.
function verdict.close(result)
  result.survived = result.settled.held and result.held == result.count
  result.count = nil
  return result
end

return verdict
