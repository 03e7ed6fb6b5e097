--- The status bar: the last message, in orange if it is an error, the file, the tool, and the bodies that overlap.
local error_text = require "clench.error_text"
local printable = require "clench.printable"
local replay = require "clench.view.replay"
local status = {}

local gray, orange = {0.5, 0.5, 0.55}, {0.84, 0.37, 0}
local max_pairs = 3  -- pairs of overlapping bodies that are named
local slow = 0.005  -- time of a collision query beyond which it is left out during drags and playback [s]

--- Shows a warning in the console and in the status bar, where it stays until the next action.
function status.warn(view, text)
  view.status, view.failed = text, text
  view:print(text, "error")
end

--- Shows an error in the same way.
function status.fail(view, problem) status.warn(view, printable(error_text(problem), "\n\t")) end

--- Shows a message until the next action.
function status.note(view, text) view.status, view.old_status = text, text end

--- Removes a message once something else has been done.
---@param event table  "changed" of the session
function status.settle(view, event)
  local is_action = event.command or event.undo or event.redo or event.selection or type(event.gesture) == "string"
  if not is_action then return end
  -- a message that is new comes from this action
  local is_old = view.status == view.failed or view.status == view.old_status
  if is_old then view.status, view.failed = "Ready", nil end
  view.old_status = view.status
end

--- Shows a message that a command has logged, in the console and in the status bar.
function status.log(view, diagnostic)
  local text = tostring(diagnostic.message or diagnostic.text or diagnostic)
  local file = type(diagnostic.file) == "string" and diagnostic.file:match "[^/]+$"
  if file then text = ("%s:%s %s"):format(file, diagnostic.line and ("%d:"):format(diagnostic.line) or "", text) end
  view:print(text, diagnostic.severity)
  view.status, view.old_status = text:match "^[^\n]*", nil
end

local function names_of(pair) return ("%s and %s"):format(pair[1].name, pair[2].name) end

-- text of the pairs of bodies that overlap, and their number; computed when something has changed
local function collisions_of(view)
  local known = view.overlaps
  local is_moving = view.session.gesture ~= nil
  if known and (known.stamp == view.stamp or is_moving and known.time > slow) then return known.text, known.count end
  local from = clench.loop.time()
  local pairs_ = replay.world(view):colliding(nil, nil, {max = max_pairs + 1})
  local none = replay.world(view):may_collide() and "no overlap" or "collisions are off"
  local texts = {}
  for i = 1, math.min(#pairs_, max_pairs) do texts[i] = names_of(pairs_[i]) end
  if #pairs_ > max_pairs then texts[#texts + 1] = "…" end
  view.overlaps = {stamp = view.stamp, time = clench.loop.time() - from, count = #pairs_, text = #pairs_ > 0 and "overlap: " .. table.concat(texts, ", ") or none}
  return view.overlaps.text, #pairs_
end

local function draw_contacts(view, ui)
  local count = view.quality and #view.quality.contacts
  if not count then return end
  ui:same_line()
  ui:text(count == 0 and "   hand and object do not touch" or ("   hand and object touch: %d contact%s"):format(count, count > 1 and "s" or ""), {color = gray})
end

--- Draws the contents of the status bar.
function status.draw(view, ui)
  ui:text(view.status, {color = view.status == view.failed and orange or nil})
  ui:same_line()
  ui:text(("   %s   %s%s"):format(view.session.path or "Untitled", view.current_tool, view.session:is_modified() and "   modified" or ""), {color = gray})
  if not view.session.world then return end
  local text, count = collisions_of(view)
  ui:same_line()
  ui:text("   " .. text, {color = count > 0 and orange or gray})
  ui:tooltip "Bodies that overlap; pairs whose collisions are switched off are not listed."
  draw_contacts(view, ui)
end

return status
