--- The files that `clench plan` writes: grasps while it runs, and in the end the list, the sheet and the page.
local find_three = require "clench.page.three"
local in_utf8 = require "clench.in_utf8"
local printable = require "clench.printable"
local report_rows = require "clench.plan.report_rows"

local Files = {}
Files.__index = Files

local function shown(text) return printable(in_utf8(text)) end

local function fail(text, ...) error({usage = text:format(...)}, 0) end

local function check_ending(option, path, ending)
  if path and path:sub(-#ending):lower() ~= ending then
    fail("%s: expected a file %s, got '%s'", option, ending, path)
  end
end

-- a file that cannot be written is told before the search, not after it
local function check_folder(option, path)
  if not path then return end
  local file, why = io.open(path, "ab")
  if not file then error(("%s: %s"):format(option, why), 0) end
  local empty = file:seek "end" == 0
  file:close()
  if empty then os.remove(path) end
end

-- a list without grasps; an ending that names no format is a wrong option
local function begin_list(path, format)
  local ok, problem = pcall(function() clench.grasps():save(path, {format = format}) end)
  if ok then return end
  if problem.kind == "input" then fail("-o: %s", problem.sentence) end
  error(problem, 0)
end

--- Looks whether all can be written, and begins the list of grasps.
---@param given {o?: string, format?: string, sheet?: string, report?: string}
function Files.open(given)
  local self = setmetatable({out = given.o, format = given.format, sheet = given.sheet, page = given.report}, Files)
  if self.format and not self.out then fail "--format says how -o FILE is written, and there is no -o" end
  check_ending("--sheet", self.sheet, ".png")
  check_ending("--report", self.page, ".html")
  check_folder("--sheet", self.sheet)
  check_folder("--report", self.page)
  if self.page then
    local three, missing = find_three()
    if not three then fail("--report: %s", missing) end
  end
  if not self.out then return self end
  begin_list(self.out, self.format)
  local file, why = io.open(self.out, "a+b")
  if not file then error(("-o: %s"):format(why), 0) end
  if (file:read "l" or ""):find '^{"format":"clench grasps"' then self.lines = file else file:close() end
  return self
end

--- Appends a grasp to a list of JSON lines, at once: who ends the program keeps it.
function Files:add(grasp)
  if not self.lines then return end
  local ok, why = self.lines:write(clench.json.encode(grasp), "\n")
  if ok then ok, why = self.lines:flush() end
  if not ok then error(("%s could not be written: %s"):format(self.out, why), 0) end
end

--- The list, best first, written whole.
function Files:save(grasps)
  if self.lines then self.lines:close() end
  if not self.out then return end
  grasps:save(self.out, {format = self.format})
end

local on_sheet = 24

local function draw_sheet(hand, object, grasps)
  local pictures, captions = {}, {}
  local best = {}
  for i = 1, math.min(#grasps, on_sheet) do best[i] = grasps[i] end
  report_rows(hand, object, best, function(row)
    pictures[#pictures + 1] = clench.render(hand.world, {size = {320, 240}, quality = "draft", background = "white"})
    captions[#captions + 1] = ("%d: epsilon %.3f"):format(row.number, row.epsilon) .. (row.load and (", load %.1f"):format(row.load) or "")
  end)
  return clench.sheet {pictures = pictures, captions = captions}
end

local function write_sheet(path, hand, object, grasps)
  draw_sheet(hand, object, grasps):save(path)
  print(("%s: %d pictures"):format(shown(path), math.min(#grasps, on_sheet)))
end

local function write_page(path, hand, object, grasps, words)
  local html, notes = require "clench.plan.report_page"(hand, object, grasps, words)
  clench.files.save_text(path, html)
  print(("%s: a page of %.1f MB"):format(shown(path), #html / 1e6))
  for _, note in ipairs(notes) do print("  " .. shown(note)) end
end

--- The contact sheet and the page, where they are asked for and there is something to show; each also when the other fails.
---@param words {title: string, subtitle: string, report: string}
function Files:show(hand, object, grasps, words)
  local ok, problem = true, nil
  if #grasps > 0 and self.sheet then ok, problem = pcall(write_sheet, self.sheet, hand, object, grasps) end
  if self.page then write_page(self.page, hand, object, grasps, words) end
  if not ok then error(problem, 0) end
end

return Files
