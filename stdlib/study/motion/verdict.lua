--- The result of a test that moves a grasp.
local drives = require "clench.drives"
local held_text = require "clench.held_text"
local verdict = {}

local Verdict = {__name = "verdict"}

-- " along +x, -y", " in lift": the tests in which the object was lost
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

local nouns = {rows = "phases", directions = "directions", axes = "axes"}

function Verdict:__tostring()
  for key, noun in pairs(nouns) do
    local rows = self[key]
    if rows then
      local where = self.survived and "" or ", lost" .. where_lost(self)
      return ("%s%s: %s"):format(held_text(self.held, #rows, noun), where, self.protocol)
    end
  end
  return ("lost%s: %s"):format(where_lost(self), self.protocol)
end

local how = {forces = "by forces in equilibrium", close = "by closing motors", none = "by no motor"}

-- the requested grip
local function grip_asked(trial, job)
  return trial.grip == "forces" and ("gripped with %.3g N of normal forces"):format(job.grip_force) or "gripped " .. how[trial.grip]
end

-- the measured grip, and the requested one if they differ
local function grip_measured(trial, job)
  local measured, asked = ("%.3g"):format(trial.grip_force), ("%.3g"):format(job.grip_force)
  local text = ("gripped with %s N of normal forces"):format(measured)
  if trial.grip ~= "forces" then return text .. " " .. how[trial.grip] end
  return measured == asked and text or ("%s, %s N requested"):format(text, asked)
end

local function protocol(trial, job, asked, grip)
  local text = ("%s, %.4g kg, %s, %.3g of the friction; displaced by less than %.3g m and %.3g degrees"):format(asked, job.mass, grip,
    job.friction_share, job.max_distance, math.deg(job.max_angle))
  local unlimited = drives.unlimited_text(trial.unlimited_efforts)
  return unlimited and ("%s; %s"):format(text, unlimited) or text
end

---@param asked string  short description of the test
function verdict.new(trial, job, asked)
  return setmetatable({
    survived = false, held = 0, settled = trial.settled, grip = trial.grip, grip_force = trial.grip_force,
    unlimited_efforts = trial.unlimited_efforts, contacts = trial.contacts, failures = 0, count = 0,
    protocol = protocol(trial, job, asked, grip_measured(trial, job)), asked = protocol(trial, job, asked, grip_asked(trial, job)),
  }, Verdict)
end

--- the row of a test that was skipped, as the hand had lost the object while it gripped it
function verdict.lost_before(trial)
  return {moved = trial.settled.moved, turned = trial.settled.turned, held = false, time = 0.0}
end

--- Runs a test from the state in which the hand held the object at rest, with the gravity of the job, and returns its row.
---@param watch fun(): table
function verdict.attempt(trial, job, watch)
  if not trial.settled.held then return verdict.lost_before(trial) end
  trial:reset()
  trial.world.gravity = job.gravity
  return watch()
end

--- Appends a row to a list in the result.
function verdict.add(result, name, row, trial)
  result[name] = result[name] or {}
  table.insert(result[name], row)
  result.count = result.count + 1
  if row.held then result.held = result.held + 1 end
  result.failures = math.max(result.failures, trial.world.report.failures - trial.failures_before)
end

--- Completes the result: the grasp survived if the object was held in all rows.
function verdict.close(result)
  result.survived = result.settled.held and result.held == result.count
  result.count = nil
  return result
end

return verdict
