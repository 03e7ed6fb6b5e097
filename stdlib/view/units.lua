--- Units in which panels show lengths and angles, chosen by the user. Scripts, files and the console always use SI and radians.
local units = {}

local lengths = {m = 1, mm = 1000}
local angles = {rad = 1, deg = 180 / math.pi}

--- Factor from SI to the displayed unit, its name, and a format for numbers: for "m", "rad" and other units, which are not converted.
---@param unit string  of SI
---@return number factor, string name, string format
function units.of(view, unit)
  if unit == "m" then
    local name = view.units.length or "m"
    return lengths[name], name, name == "mm" and "%.2f" or "%.4f"
  end
  if unit == "rad" then
    local name = view.units.angle or "rad"
    return angles[name], name == "deg" and "°" or name, name == "deg" and "%.1f" or "%.3f"
  end
  return 1, unit, "%.4g"
end

local function is_zero(text) return text:find "^%-?[0.]+$" ~= nil end

--- A value for a field: zero if the field would show -0.000.
---@param value number  in the displayed unit
---@param format string  of the field
function units.field(value, format) return is_zero(format:format(value)) and 0 or value end

--- A value with its unit, for display.
function units.text(view, value, unit)
  local factor, name, format = units.of(view, unit)
  local number = format:format(units.field(value * factor, format))
  return number .. (name == "1" and "" or name == "°" and name or " " .. name)
end

--- Menu entries that choose the units.
function units.menu(view, ui)
  if ui:menu_item("Millimeters", {selected = view.units.length == "mm"}) then view.units.length = view.units.length == "mm" and "m" or "mm" end
  if ui:menu_item("Degrees", {selected = view.units.angle == "deg"}) then view.units.angle = view.units.angle == "deg" and "rad" or "deg" end
end

return units
