-- Views off-screen and their widgets, for tests.
local clench = require "clench"
local view_session = {}

--- A session with a world and a view of it, after its first frame.
---@param world? string  name of a file in worlds
---@param size? integer[]  of the screen [pixels]
function view_session.open(world, size)
  local session = clench.session()
  session:open(("worlds/%s.wld"):format(world or "barrett_mug"), {root = "."})
  local view = clench.view.offscreen {session = session, size = size or {1070, 937}}
  view:frame()
  return session, view
end

--- The labels of all widgets of a new frame, one per line.
function view_session.texts_of(view)
  view:frame()
  local texts = {}
  for _, item in ipairs(view:items()) do texts[#texts + 1] = item.label end
  return "\n" .. table.concat(texts, "\n") .. "\n"
end

--- The first widget of a new frame whose label matches a pattern.
function view_session.item(view, pattern)
  view:frame()
  for _, found in ipairs(view:items()) do
    if found.label:find(pattern) then return found end
  end
  error("no widget matches " .. pattern)
end

--- The first widget on the line of a text, right of it.
function view_session.beside(view, text)
  local left = view_session.item(view, "^" .. text .. "$")
  for _, found in ipairs(view:items()) do
    local overlaps = found.y < left.y + left.height and found.y + found.height > left.y
    if found.kind ~= "text" and found.x > left.x and found.x < left.x + 260 and overlaps then return found end
  end
  error("nothing is beside " .. text)
end

--- Draws frames until all input is applied.
function view_session.settle(view)
  repeat view:frame() until not view.ui:poll()
end

--- Moves the mouse, without clicking.
function view_session.move(view, x, y)
  view.ui:input {kind = "move", x = x, y = y}
  view_session.settle(view)
end

--- Presses or releases a button of the mouse.
---@param code? integer  1: the right one
function view_session.button(view, down, code)
  view.ui:input {kind = "button", code = code or 0, down = down}
  view_session.settle(view)
end

--- Clicks several times without a pause, as in a double click, where view:click_label does.
---@param widget table  one of view:items()
function view_session.clicks(view, widget, count)
  view.ui:input {kind = "move", x = widget.x + math.min(widget.width, 24) / 2, y = widget.y + widget.height / 2}
  for _ = 1, count do
    for _, down in ipairs {true, false} do view.ui:input {kind = "button", code = 0, down = down} end
  end
  view_session.settle(view)
end

return view_session
