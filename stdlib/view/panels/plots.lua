--- Quality, contact forces and motor efforts over the last changes.
local curves = require "clench.view.curves"

local function draw(ui, view)
  curves.sample(view)
  for _, curve in ipairs(curves.list) do
    local values = view.curves[curve[1]]
    local last = values[#values]
    ui:group(function(ui)
      ui:text(curve[2] .. (last and ("  %.4g"):format(last) or ""))
      ui:width(220 * view.scale)
      if #values > 1 then ui:plot("##" .. curve[1], values, {min = 0, height = 70 * view.scale}) else ui:text("Nothing has moved yet.", {color = {0.5, 0.5, 0.5}}) end
    end)
    ui:same_line(24)
  end
end

return {name = "Plots", place = "bottom", draw = draw}
