--- Pictures of grasps on one sheet, each with its measures.
local held_text = require "clench.held_text"

local function caption_of(row)
  local load = row.load and (", load %.1f"):format(row.load) or ""
  local held = row.held and "\n" .. held_text(row.held, 6) or ""
  return ("%d: epsilon %.3f"):format(row.number, row.epsilon) .. load .. held
end

---@param rows table[]  of report_rows
---@param pictures picture[]  one per row
---@param notes string[]  lines under the pictures
---@return picture
return function(rows, pictures, notes)
  local captions = {}
  for i, row in ipairs(rows) do captions[i] = caption_of(row) end
  return clench.sheet {pictures = pictures, captions = captions, notes = #notes > 0 and notes or nil}
end
