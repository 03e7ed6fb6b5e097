--- Results of the panel Forces: status, what yields first, forces, torques, and the section of resistible wrenches.
local gray, orange, green = {0.5, 0.5, 0.5}, {0.84, 0.37, 0}, {0, 0.5, 0.35}

local results = {}

local function name_of(yielding)
  local what = yielding.contact and "the contact of " .. (yielding.contact.link or yielding.contact.other).name
    or yielding.dof and ("DOF %d"):format(yielding.dof) or "no single contact"
  return (what:gsub("^%l", string.upper))
end

local function draw_certificate(ui, certificate)
  if not certificate then return end
  ui:text(name_of(certificate) .. " yields first.", {color = orange, wrap = true})
  if certificate.power > 0 then ui:text(("%.1f %% of the load can be held."):format(100 * math.max(0, certificate.capacity) / certificate.power), {wrap = true}) end
end

local function draw_forces(ui, forces)
  ui:text("forces of the contacts [N]", {color = gray})
  ui:table("optimal forces", {"link", "normal", "margin"}, {}, function(ui)
    for i, force in ipairs(forces) do
      ui:next_column() ui:text(("%d %s"):format(i, (force.contact.link or force.contact.other).name:gsub("^.*_(chain)", "%1")))
      ui:next_column() ui:text(("%.3f"):format(force.normal))
      ui:next_column() ui:text(("%.3f"):format(math.max(0, force.margin)))
    end
  end)
end

local function draw_torques(ui, torques)
  local parts = {}
  for i, torque in ipairs(torques) do parts[i] = ("%.3g"):format(torque) end
  ui:text("torques [N m]: " .. table.concat(parts, ", "), {wrap = true})
end

-- contact forces of any of the questions
local function draw_balance(ui, result)
  if result.load then
    ui:text(("%.4g times the load"):format(result.load), {color = green})
    draw_certificate(ui, {contact = result.certificate.contact, dof = result.certificate.dof, power = 0})
  elseif result.status ~= "optimal" and result.status ~= "stable" then
    draw_certificate(ui, result.certificate)
  end
  if result.residual and result.residual > 1e-6 then
    ui:text(("unbalanced: %.3g, %.3g, %.3g N; %.3g, %.3g, %.3g N m"):format(table.unpack(result.unbalanced)), {color = orange, wrap = true})
  end
  if result.forces and #result.forces > 0 then draw_forces(ui, result.forces) end
  if result.joint_torques and #result.joint_torques > 0 then draw_torques(ui, result.joint_torques) end
end

local function draw_preload(ui, result)
  if not result.torques then return ui:text("No torques within the limits hold the object with and without the load.", {color = orange, wrap = true}) end
  ui:text(("%.3g %% of the limit of the motor that is loaded most"):format(100 * result.fraction), {wrap = true})
  draw_torques(ui, result.torques)
end

local function plot_of(result)
  local x, y = {}, {}
  for i = 1, #result.rays + 1 do
    local point = result.rays[(i - 1) % #result.rays + 1].point
    x[i], y[i] = point and point[1] or false, point and point[2] or false
  end
  local function label(name) return name .. (name:find "^t" and " [N m]" or " [N]") end
  return clench.plot {series = {{x = x, y = y}, {x = {0}, y = {0}, kind = "points"}}, x_label = label(result.axes[1]), y_label = label(result.axes[2]), width = 248, height = 220}
end

local function draw_section(view, ui, state)
  local result = state.result
  local counts, weakest = {}, nil
  for _, ray in ipairs(result.rays) do
    counts[ray.status] = (counts[ray.status] or 0) + 1
    if ray.load and (not weakest or ray.load < weakest.load) then weakest = ray end
  end
  for _, status in ipairs {"unlimited", "infeasible", "inaccurate"} do
    if counts[status] then ui:text(("%s along %d of %d directions"):format(status, counts[status], #result.rays), {color = orange, wrap = true}) end
  end
  if weakest and weakest.load < math.huge then
    ui:text(("%s yields first, at %.3g N."):format(name_of(weakest), weakest.load), {wrap = true})
  end
  if state.plotted ~= result then state.plotted, state.picture = result, plot_of(result).picture end
  ui:image("resistible wrenches", state.picture, {width = 248 * view.scale, height = 220 * view.scale})
end

local good = {optimal = true, stable = true, unlimited = true}

--- Draws the last result of the panel, until something moves.
---@param state {kind: string, result: table, hash: integer}  kind: name of the command
function results.draw(view, ui, state)
  local result = state.result
  if not result then return end
  if state.hash ~= view.session.world:hash() then return ui:text("Something has moved since.", {color = gray}) end
  if result.status then ui:text(result.status, {color = good[result.status] and green or orange}) end
  if state.kind == "preload" then return draw_preload(ui, result) end
  if state.kind == "resistible_wrenches" then return draw_section(view, ui, state) end
  draw_balance(ui, result)
end

return results
