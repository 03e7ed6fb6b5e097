--- Pushes the object along each axis of the world in turn, each time from the state in which the hand held it at rest.
local verdict = require "clench.study.motion.verdict"

--- the six directions with their names
local directions = {{"+x", clench.vec3(1, 0, 0)}, {"-x", clench.vec3(-1, 0, 0)}, {"+y", clench.vec3(0, 1, 0)},
                    {"-y", clench.vec3(0, -1, 0)}, {"+z", clench.vec3(0, 0, 1)}, {"-z", clench.vec3(0, 0, -1)}}

---@param trial table
---@param job table  of study.motion.options
---@param result table  of study.motion.verdict; `directions` is added
---@param seconds number  in each direction
---@param force fun(time: number): number  [N]
---@param options? {note?: fun(row: table), until_lost?: boolean, is_steady?: boolean}  note: completes a row; is_steady: the force does not change; until_lost: directions after the first one in which the object is lost are skipped
return function(trial, job, result, seconds, force, options)
  local note, until_lost, steady = options and options.note, options and options.until_lost, options and options.is_steady
  for _, direction in ipairs(directions) do
    local row = verdict.attempt(trial, job, function()
      local push = trial:push(function(time) return direction[2] * force(time) end)
      local watched = steady and trial:watch_steady(seconds) or trial:watch(seconds)
      push:remove()
      return watched
    end)
    row.direction = direction[1]
    if note then note(row) end
    verdict.add(result, "directions", row, trial)
    if until_lost and not row.held then break end
  end
  return verdict.close(result)
end
