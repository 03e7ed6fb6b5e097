--- Unbalanced wrenches of the selected bodies in the picture.
local net_wrench = require "clench.session.net_wrench"
local replay = require "clench.view.replay"
local wrenches = {}

--- The wrenches to be drawn, as an option of `ui:show`; nil: not shown.
function wrenches.of(view)
  if not view.shows_wrenches then return nil end
  local list = {}
  for _, thing in ipairs(view.session.selection) do
    local body = clench.type(thing) == "body" and replay.shown(view, thing)
    if body then list[#list + 1] = net_wrench.of(body) end
  end
  return #list > 0 and list or nil
end

return wrenches
