--- The text protocol of GraspIt!: one command per line, replies as lines. Every line is answered by its reply or by a line that begins with
--- "Error"; `render`, `moveToContacts` and an empty line have no reply.
local error_text = require "clench.error_text"
local error_value = require "clench.error_value"
local is_stopped = require "clench.is_stopped"
local new_words = require "clench.control.text.words"
local old = require "clench.control.text.old"
local printable = require "clench.printable"
local text = {}

local commands = {}
for _, group in ipairs {"contacts", "robots", "dynamics"} do
  for name, run in pairs(require("clench.control.text." .. group)) do
    commands[name] = run
  end
end
for name, run in pairs(old.commands) do commands[name] = run end

-- the command with which the words begin
local function command_of(words)
  local name = words:next()
  local seconds = old.second_words[name]
  if seconds then
    local second = words:next()
    return seconds[second or ""] or words.fail("there is no command '%s %s'", name, second or "")
  end
  return commands[name] or words.fail("there is no command '%s'", words.command)
end

-- state: data of a client that are kept between its lines
local function run(session, state, line)
  local words = new_words(line)
  if #words == 0 then return {} end
  if state.pending then
    local reply = old.continue(state, words)
    if reply then return reply end
  end
  local command = command_of(words)
  local world = session.world or words.fail "no world is open"
  return command(world, words, session, state)
end

local function sentence_of(problem)
  if type(problem) == "table" and rawget(problem, "reply") then return problem.reply end
  local ours = debug.getmetatable(problem) == error_value
  return "Error: " .. (ours and problem.sentence or error_text(problem))
end

--- Answers a line.
---@return string reply  lines, each with its end
function text.answer(session, state, line)
  local ok, reply = pcall(run, session, state, line)
  if not ok then
    if is_stopped(reply) then error(reply, 0) end
    reply = {sentence_of(reply)}
  end
  for i, one in ipairs(reply) do reply[i] = printable(one) .. "\n" end
  return table.concat(reply)
end

return text
