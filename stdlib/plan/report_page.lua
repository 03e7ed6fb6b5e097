--- A self-contained page of HTML that shows grasps: a table that can be sorted, pictures, and a 3-D view of each grasp.
local base64 = require "clench.base64"
local of_grasps = require "clench.plan.report_page_data"
local find_three = require "clench.page.three"
local text = require "clench.page.text"

local largest = 100  -- maximum number of grasps per page
local escaped, json, code = text.escaped, text.json, text.code

local function picture_of(world)
  local picture = clench.render(world, {size = {192, 144}, quality = "draft", background = "white"})
  local path = os.tmpname()
  local png = path .. ".png"
  local ok, message = pcall(picture.save, picture, png)
  local file = ok and io.open(png, "rb")
  local bytes = file and file:read "a"
  if file then file:close() end
  os.remove(path)
  os.remove(png)
  if not ok then error(message, 0) end
  return "data:image/png;base64," .. base64(bytes)
end

-- heading, unit, key of the row, digits, meaning
local columns = {
  {"#", "", "number", "%d", "in order of decreasing epsilon"},
  {"epsilon", "", "epsilon", "%.4f", "magnitude of the smallest wrench that breaks the grasp, with contact forces that sum to 1 and torques divided by the length rho"},
  {"load margin", "weights", "load", "%.1f", "load that the hand can hold within its motors' limits, in the worst of six directions"},
  {"perturbed", "epsilon", "perturbed", "%.4f", "minimum epsilon when the hand closes again on the slightly displaced object, in the worst of six directions"},
  {"shaken", "held in", "held", "%d of 6", "number of directions, of 6, in which the object was held when its weight pulled it in simulation"},
  {"contacts", "", "contacts", "%d", "points of the hand that touch the object"},
  {"azimuth", "degrees", "azimuth", "%d", "direction from which the hand comes: angle about the world's z axis, from +x towards +y"},
  {"elevation", "degrees", "elevation", "%d", "direction from which the hand comes: 90 is from above"},
}

local function head_of(title, subtitle)
  return ([==[<!DOCTYPE html>
<html lang="en"><head><meta charset="utf-8">
<meta http-equiv="Content-Security-Policy" content="default-src 'none'; script-src 'unsafe-inline'; style-src 'unsafe-inline'; img-src data:">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>%s</title>
<style>%s</style></head>
<body><header><h1>%s</h1><p>%s</p></header>
]==]):format(escaped(title), require "clench.page.style", escaped(title), escaped(subtitle))
end

local view = [==[
<main><div id="side"><div id="view"><div class="shown"></div><div class="note">drag: turn &middot; wheel: zoom &middot; right button: move &middot; arrow keys: next grasp</div></div>
<div class="controls"><label><input type="checkbox" id="before"> before the hand closes</label>
<label><input type="checkbox" id="contacts" checked> contacts</label>
<label><input type="checkbox" id="through" checked> see through the object</label>
<button id="reset" type="button">reset view</button></div>
<div class="controls"><span><span class="key" style="background:#a9b4c2"></span>hand</span><span><span class="key" style="background:#79b5c4"></span>object</span>
<span><span class="key" style="background:#f4511e"></span>friction cones</span></div></div>
]==]

local function table_of(rows, pictures, columns)
  local out = {'<div class="card"><table><thead><tr>'}
  local function add(text) out[#out + 1] = text end
  if pictures[1] then add '<th class="picture"></th>' end
  for i, c in ipairs(columns) do
    add(('<th data-column="%d" title="%s"%s><button type="button">%s</button><small>%s</small></th>'):format(
      i - 1, escaped(c[5]), i == 1 and ' aria-sort="ascending"' or "", c[1], c[2] ~= "" and c[2] or "&nbsp;"))
  end
  add "</tr></thead>\n<tbody>\n"
  for i, row in ipairs(rows) do
    add(('<tr data-grasp="%d">'):format(i))
    if pictures[1] then add(('<td class="picture"><img alt="grasp %d" src="%s"></td>'):format(i, pictures[i])) end
    for _, c in ipairs(columns) do
      local value = row[c[3]]
      local is_number = value and value == value and math.abs(value) < math.huge
      add(('<td data-value="%s">%s</td>'):format(is_number and ("%.9g"):format(value) or value and "1e999" or "",
        is_number and c[4]:format(c[4]:find "%d" and math.tointeger(value) or value) or value and "unlimited" or "&ndash;"))
    end
    add "</tr>\n"
  end
  add "</tbody></table></div></main>\n"
  return table.concat(out)
end

local function assumptions_of(lines)
  if not lines or #lines == 0 then return "" end
  local out = {"<h2>Assumptions</h2><ul>"}
  for _, line in ipairs(lines) do out[#out + 1] = ("<li>%s</li>"):format(escaped(line)) end
  return table.concat(out) .. "</ul>"
end

local function words_of(words, notes, columns)
  local out = {'<section class="words"><h2>Columns</h2><dl>'}
  for i = 2, #columns do out[#out + 1] = ("<dt>%s</dt><dd>%s</dd>"):format(columns[i][1], escaped(columns[i][5])) end
  out[#out + 1] = "</dl>" .. assumptions_of(words.assumptions)
  out[#out + 1] = "<h2>Search</h2><pre>" .. escaped(words.report) .. "</pre>"
  for _, note in ipairs(notes) do out[#out + 1] = "<p>" .. escaped(note) .. "</p>" end
  return table.concat(out) .. "</section>\n"
end

---@param hand robot
---@param object body
---@param grasps grasp[]  the first 100 are shown
---@param words {title: string, subtitle: string, report: string, assumptions?: string[], three?: string[]}  three: possible paths of three.js
---@return string html, string[] notes  sentences about omitted grasps and pictures, and about large meshes
return function(hand, object, grasps, words)
  local three, missing = find_three(words.three)
  if not three then error(missing, 0) end
  local shown, pictures, no_pictures = {}, {}, nil
  for i = 1, math.min(#grasps, largest) do shown[i] = grasps[i] end
  local data, rows, notes = of_grasps(hand, object, shown, function()
    if no_pictures then return end
    local ok, picture = pcall(picture_of, hand.world)
    if ok then pictures[#pictures + 1] = picture else no_pictures = tostring(picture) end
  end)
  if no_pictures then
    pictures = {}
    notes[#notes + 1] = "no pictures in the table: " .. no_pictures
  end
  if #grasps > largest then notes[#notes + 1] = ("the page shows the first %d of %d grasps"):format(largest, #grasps) end
  local shown_columns, shaken = {}, false
  for _, row in ipairs(rows) do shaken = shaken or row.held ~= nil end
  for _, column in ipairs(columns) do
    if column[3] ~= "held" or shaken then shown_columns[#shown_columns + 1] = column end
  end
  local parts = {head_of(words.title, words.subtitle), view, table_of(rows, pictures, shown_columns), words_of(words, notes, shown_columns),
                 '<script type="application/json" id="data">', json(data), "</script>\n<script>", code(three),
                 "</script>\n<script>", code(require "clench.page.scene"), code(require "clench.plan.report_page_view"),
                 code(require "clench.plan.report_page_table"), "</script>\n</body></html>\n"}
  return table.concat(parts), notes
end
