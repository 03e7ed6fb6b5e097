--- The question for the path of a file to write: a field, files to choose from, and a question before one is replaced.
local paths = require "clench.view.paths"
local status = require "clench.view.status"
local with_ending = require "clench.session.with_ending"
local ask_path = {}

--- Opens the question.
---@param title string
---@param text string  the suggested path
---@param files table|string  which files are listed, as of a command's parameter; or a command that has one
---@param done fun(path: string)  writes the file
function ask_path.open(view, title, text, files, done)
  if type(files) == "string" then
    local parameter = (view.session.commands[files].parameters or {})[1] or {}
    local of_command = parameter.files or {}  -- a script may have replaced the command
    files = {endings = of_command.endings, kinds = of_command.kinds, ending = of_command.ending, writes = true}
  end
  view.ask = {title = title, text = text, files = files, done = done, list = {}}
end

local function save(view, ask)
  local answered = ask.question
  ask.error, ask.question = nil, not answered and paths.question(ask.files, ask.text) or nil
  if ask.question then return end
  local path = ask.files.ending and with_ending(ask.text, ask.files.ending) or ask.text
  local ok, problem = pcall(function()
    if answered and answered.prepare then answered.prepare() end
    ask.done(path)
  end)
  if not ok then
    ask.error = tostring(problem)
    return
  end
  view.ask = nil
  status.note(view, "Saved " .. path)
end

--- Does a question wait for its answer?
function ask_path.is_asking(view) return view.ask ~= nil or view.leaving ~= nil or #(view.left or {}) > 0 end

--- Draws the question, if it is open.
function ask_path.draw(view, ui)
  local ask = view.ask
  if not ask then return end
  local width = 420 * view.scale
  local open = ui:window(ask.title, {x = (ui.size[1] - width) / 2, y = ui.size[2] / 4, width = width, modal = true, can_close = true}, function(ui)
    ui:width(340 * view.scale)
    local text, _, entered = ui:text_input("path", ask.text, {on_enter = true, focus = not ask.shown})
    ask.text, ask.shown = text, true
    local chosen, accepted = paths.draw(view, ui, ask.files, ask.list, ask.text, ask.error and 3 or ask.question and 1 or 0)
    ask.text = chosen or ask.text
    local question, pressed = paths.draw_button(ui, ask.question, ask.text, "Save##ask")
    ask.question = question
    if pressed or not question and (entered or accepted) then save(view, ask) end
    ui:same_line()
    if ui:button "Cancel##ask" then view.ask = nil end
    if ask.error then ui:text(ask.error, {color = {0.84, 0.37, 0}, wrap = true}) end
  end)
  if not open then view.ask = nil end
end

return ask_path
