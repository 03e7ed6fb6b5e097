--- Saves a recorded run as a page of HTML that plays in 3-D.
local find_three = require "clench.page.three"
local raise = require "clench.raise"
local read_options = require "clench.options"
local run = require "clench.page.run"

local doc = [[
@param options table
@option title? string = "Recorded run"  title of the page
@option speed? number [> 0] = 1  1: real time
@option three? string[]  possible files of three.js]]

---@param recording table
---@param path string
---@param _ string
---@param options {title?: string, speed?: number, three?: string[]}  three: possible files of three.js
---@return integer frames
return function(recording, path, _, options)
  local read = read_options("recording:save", options, nil, nil, doc)
  local title = read:get "title"
  local speed = read:get "speed"
  local places = read:raw "three"
  if places ~= nil and type(places) ~= "table" then read:expected("three", "a list of files", places) end
  for i, path in ipairs(places or {}) do
    if type(path) ~= "string" then read:expected(("three[%d]"):format(i), "the name of a file", path) end
  end
  read:done()
  local three, missing = find_three(places)
  if not three then raise("recording:save: " .. missing) end
  local data, notes = run.data_of(recording)
  data.speed = speed
  local times = recording.times
  local words = ("%d frames, from %.3f s to %.3f s"):format(#times, times[1], times[#times])
  for _, note in ipairs(notes) do words = words .. "; " .. note end
  clench.files.save_text(path, run.page_of(title, words, data, three))
  return #times
end
