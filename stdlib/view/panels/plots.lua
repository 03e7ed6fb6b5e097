--- Quality and contact forces over the last changes.
local longest = 300  -- maximum number of points of a curve

local function add(list, value)
  list[#list + 1] = value
  if #list > longest then table.remove(list, 1) end
end

local function sample(view)
  local quality = view.quality
  if not quality or view.replay or view.plotted == view.stamp then return end
  view.plotted = view.stamp
  local curves = view.curves
  add(curves.epsilon, quality.measures and quality.measures.epsilon or 0)
  local total = 0
  for _, contact in ipairs(quality.contacts) do total = total + (contact.force and contact.force:norm() or 0) end
  add(curves.force, total)
  add(curves.contacts, #quality.contacts)
end

local function draw(ui, view)
  view.curves = view.curves or {epsilon = {}, force = {}, contacts = {}}
  sample(view)
  for _, curve in ipairs {{"epsilon", "epsilon"}, {"sum of contact forces [N]", "force"}, {"contacts", "contacts"}} do
    local values = view.curves[curve[2]]
    local last = values[#values]
    ui:group(function(ui)
      ui:text(curve[1] .. (last and ("  %.4g"):format(last) or ""))
      ui:width(220 * view.scale)
      if #values > 1 then ui:plot("##" .. curve[2], values, {min = 0, height = 70 * view.scale}) else ui:text("Nothing has moved yet.", {color = {0.5, 0.5, 0.5}}) end
    end)
    ui:same_line(24)
  end
end

return {name = "Plots", place = "bottom", draw = draw}
