--- The sheet, the table and the page that `clench plan` writes at the end.
local find_three = require "clench.page.three"
local grasp_table = require "clench.plan.grasp_table"
local in_utf8 = require "clench.in_utf8"
local picture_words = require "clench.host.picture_words"
local printable = require "clench.printable"
local report_rows = require "clench.plan.report_rows"
local sheet = require "clench.plan.sheet"
local fail = require "clench.host.usage"

local on_sheet = 24
local sheet_defaults = {size = {320, 240}, quality = "draft", background = "white"}
local Files = {}
Files.__index = Files

local function shown(text) return printable(in_utf8(text)) end

-- files that cannot be written are reported before the search, not after it
local function check(option, path, ending, other)
  if not path then return end
  local given = path:lower():match "%.%w+$"
  if given ~= ending and (not other or given ~= other) then
    fail("%s: expected a file %s%s, got '%s'", option, ending, other and " or " .. other or "", path)
  end
  local ok, problem = pcall(clench.files.check_writable, path)
  if not ok then error(("%s: %s"):format(option, problem.sentence or problem), 0) end
end

--- Checks the options and the files on the disk, without changing anything.
---@param given table<string, string>  options by name
function Files.check(given)
  check("--sheet", given.sheet, ".png")
  check("--table", given.table, ".tex", ".csv")
  check("--report", given.report, ".html")
  for _, name in ipairs {"quality", "size", "frame"} do
    if given[name] and not given.sheet then fail("--%s requires --sheet", name) end
  end
  local drawing = picture_words(given, sheet_defaults)
  if given.report then
    local three, missing = find_three()
    if not three then fail("--report: %s", missing) end
  end
  return setmetatable({sheet = given.sheet, page = given.report, table = given.table, drawing = drawing}, Files)
end

local function draw_sheet(options, hand, object, grasps, notes)
  local pictures, best = {}, {}
  for i = 1, math.min(#grasps, on_sheet) do best[i] = grasps[i] end
  local rows = report_rows(hand, object, best, function() pictures[#pictures + 1] = clench.render(hand.world, options) end)
  return sheet(rows, pictures, notes)
end

local function write_sheet(files, hand, object, grasps, words)
  local notes = {words.title, table.unpack(words.assumptions or {})}
  draw_sheet(files.drawing, hand, object, grasps, notes):save(files.sheet)
  print(("%s: %d pictures"):format(shown(files.sheet), math.min(#grasps, on_sheet)))
end

local function write_page(path, hand, object, grasps, words)
  local html, notes = require "clench.plan.report_page"(hand, object, grasps, words)
  clench.files.save_text(path, html)
  print(("%s: a page of %.1f MB"):format(shown(path), #html / 1e6))
  for _, note in ipairs(notes) do print("  " .. shown(note)) end
end

local function is_there(path)
  local file = io.open(path, "rb")
  if file then file:close() end
  return file ~= nil
end

-- Is there anything to write? Without grasps no sheet is drawn; a page states the reason, unless the file already exists.
local function has_something(path, count, is_page)
  if not path then return false end
  if count > 0 then return true end
  if not is_there(path) then return is_page end
  print(("%s is unchanged, as no grasps were found"):format(in_utf8(path)))
  return false
end

--- Writes the sheet, the table and the page, if requested; a failure of the sheet does not prevent the others.
---@param words {title: string, subtitle: string, report: string, assumptions?: string[]}
function Files:show(hand, object, grasps, words)
  local ok, problem = true, nil
  if has_something(self.sheet, #grasps, false) then ok, problem = pcall(write_sheet, self, hand, object, grasps, words) end
  if has_something(self.table, #grasps, false) then
    grasp_table(self.table, report_rows(hand, object, grasps), words.title)
    print(("%s: %d rows"):format(shown(self.table), #grasps))
  end
  if has_something(self.page, #grasps, true) then write_page(self.page, hand, object, grasps, words) end
  if not ok then error(problem, 0) end
end

return Files
