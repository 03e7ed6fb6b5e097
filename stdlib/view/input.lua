--- Synthetic input of a view, like that of a user's mouse and keyboard. Each function returns when all of its input has been handled.
local check = require "clench.view.check"
local context = require "clench.view.context"
local described = require "clench.described"
local keys = require "clench.view.keys"
local menu_tree = require "clench.view.menu_tree"
local raise = require "clench.raise"
local suggest = require "clench.suggest"
local input = {}

local max_steps = 10000  -- of a drag

-- draws frames until no input waits, and one more in which widgets settle
local function settle(view)
  local count = 0
  repeat
    view:frame()
    count = count + 1
  until not view.ui:poll() or count > 1000
  view:frame()
  while context.appears(view) and view.panels_visible do view:frame() end
end
input.settle = settle

local function move(view, x, y) view.ui:input {kind = "move", x = x, y = y} end
local function button(view, down, code) view.ui:input {kind = "button", code = code or 0, down = down} end

--- Presses and releases a mouse button at a pixel.
function input.click(view, x, y, code)
  check.numbers("view:click", "x y", x, y)
  move(view, x, y)
  settle(view)
  button(view, true, code)
  settle(view)
  button(view, false, code)
  settle(view)
end

--- Drags from one pixel to another in steps.
function input.drag(view, x, y, to_x, to_y, options)
  check.numbers("view:drag", "x y to_x to_y", x, y, to_x, to_y)
  options = check.options("view:drag", options, {"steps", "button"})
  check.integer("view:drag", "steps", options.steps, 1, max_steps)
  check.integer("view:drag", "button", options.button, 0, 2)
  local steps, code = options.steps or 10, options.button or 0
  move(view, x, y)
  settle(view)
  button(view, true, code)
  settle(view)
  for i = 1, steps do
    move(view, x + (to_x - x) * i / steps, y + (to_y - y) * i / steps)
    settle(view)
  end
  button(view, false, code)
  settle(view)
end

--- Presses a shortcut such as "ctrl+z".
function input.key(view, shortcut)
  check.text("view:key", "shortcut", shortcut, 100)
  local codes = keys.codes(shortcut)
  for _, code in ipairs(codes) do view.ui:input {kind = "key", code = code, down = true} end
  settle(view)
  for i = #codes, 1, -1 do view.ui:input {kind = "key", code = codes[i], down = false} end
  settle(view)
end

--- Types a text.
function input.type(view, text)
  check.text("view:type", "text", text)
  for _, code in utf8.codes(text) do view.ui:input {kind = "text", text = utf8.char(code)} end
  settle(view)
end

--- The widget with a label.
---@param kind? string  of the widget
function input.find(view, label, kind)
  local found, labels = nil, {}
  for _, item in ipairs(view.ui.items) do
    labels[#labels + 1] = item.label
    if item.label == label and (not kind or item.kind == kind) and (not found or item.kind ~= "text") then found = item end
  end
  if found then return found end
  raise(("view: there is no %s '%s' on screen%s"):format(kind or "widget", label, suggest(label, labels)))
end

--- Clicks on the widget with a label.
function input.click_label(view, label, kind)
  check.text("view:click_label", "label", label, 1000)
  settle(view)
  local item = input.find(view, label, kind)
  if not item.enabled then raise(("view: '%s' is disabled"):format(label)) end
  input.click(view, item.x + math.min(item.width, 24) / 2, item.y + item.height / 2)
end

-- labels of entries may contain a slash
local function is_shown(view, label, kind)
  for _, item in ipairs(view.ui.items) do
    if item.label == label and item.kind == kind then return true end
  end
  return false
end

--- Chooses the entry of a menu: "Grasp/Auto Grasp". Submenus of commands may be left out.
function input.menu(view, path)
  check.text("view:menu", "path", path, 1000)
  settle(view)
  if not path:find "^[^/]+/." then raise(("view:menu: path: expected a menu and its entry, as in 'Grasp/Auto Grasp', got %s"):format(described(path))) end
  local rest = menu_tree.complete(view.session, path)
  while not is_shown(view, rest, "menu item") do
    local part, others = rest:match "^([^/]+)/(.+)$"
    if not part then break end
    input.click_label(view, part, "menu")
    rest = others
  end
  input.click_label(view, rest, "menu item")
end

return input
