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

return view_session
