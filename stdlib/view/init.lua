--- The viewer: `clench.view.open` shows a session in a window, `clench.view.offscreen` draws the same without a display, with synthetic input.
local check = require "clench.view.check"
local described = require "clench.described"
local raise = require "clench.raise"

local has_ui = pcall(function() return clench.ui end)

local function checked(subject, options, known)
  if not has_ui then raise(subject .. ": this build has no viewer (CLENCH_VIEWER=OFF)") end
  return check.options(subject, options, known)
end

local view = {}

--- A view without a display: the same panels and pictures as in a window, driven by synthetic input.
---@param options {session: table, size?: number[], dark?: boolean, scale?: number}  session: of clench.session; size: width and height [pixels]
---@return table view
function view.offscreen(options)
  options = checked("clench.view.offscreen", options, {"session", "size", "dark", "scale"})
  check.session("clench.view.offscreen", options.session)
  return require "clench.view.viewer" {session = options.session, size = options.size, dark = options.dark, scale = options.scale}
end

--- Opens a window. Its frames are drawn while clench.loop runs; view:wait() shows it until it is closed.
---@param what session|world  session or world to show
---@param options? {size?: number[], dark?: boolean, scale?: number, title?: string}  size: width and height [pixels]
---@return table view
function view.open(what, options)
  options = checked("clench.view.open", options, {"size", "dark", "scale", "title"})
  local session = clench.type(what) == "world" and clench.session(what) or what
  check.session("clench.view.open", session)
  return require "clench.view.viewer" {session = session, window = true, size = options.size, dark = options.dark, scale = options.scale, title = options.title}
end

--- Adds a panel to all views; one of the same name is replaced. An error of a panel is shown in the panel, and does not affect the others.
---@param panel {name: string, draw: fun(ui: ui, view: table), place?: string}  place: "left", "right" or "bottom"
function view.panel(panel)
  if type(panel) ~= "table" or type(panel.name) ~= "string" or type(panel.draw) ~= "function" then
    raise("clench.view.panel: expected {name = string, draw = function}, got " .. described(panel))
  end
  check.options("clench.view.panel", panel, {"name", "draw", "place"})
  check.text("clench.view.panel", "name", panel.name)
  local place = panel.place
  if place ~= nil and place ~= "left" and place ~= "right" and place ~= "bottom" then
    raise("clench.view.panel: place: expected 'left', 'right' or 'bottom', got " .. described(place))
  end
  require("clench.view.layout").add(panel)
end

return view
