--- Force optimization and stability analysis of the current grasp; if the load cannot be held, names what yields.
local edit = require "clench.view.edit"
local gray, orange = {0.5, 0.5, 0.5}, {0.84, 0.37, 0}

local objectives = {"min_sum", "min_norm", "min_max", "max_margin"}

local function index_of(list, value)
  for i, item in ipairs(list) do
    if item == value then return i end
  end
end

local function draw_options(view, ui, state)
  ui:width(120)
  local chosen, changed = ui:combo("objective", index_of(objectives, state.objective), objectives)
  if changed then state.objective = objectives[chosen] end
  local value
  ui:width(120)
  value = edit.number(view, ui, "max. force [N]", "max force", state.max_force, {speed = 0.1, min = 0, max = 1e5, format = "%.3g"})
  if value then state.max_force = value end
  ui:tooltip "Largest normal force of each contact; 0: no limit."
  state.torque_limits = ui:checkbox("torques of the motors", state.torque_limits == true)
  ui:tooltip "The motors stay within their limits."
end

local function keep(view, state, kind, result)
  state.kind, state.result, state.hash = kind, result, view.session.world:hash()
  view.shown_forces = result and result.forces and #result.forces > 0 and {forces = result.forces, stamp = view.stamp, hash = state.hash} or nil
end

local function limit_of(state) return state.max_force > 0 and state.max_force or nil end

local function draw_buttons(view, ui, state)
  if ui:button "Optimize" then
    keep(view, state, "forces", view:run("grasp.forces", {objective = state.objective, max_force = limit_of(state), torque_limits = state.torque_limits or nil}))
  end
  ui:same_line()
  if ui:button "Stability" then keep(view, state, "stability", view:run("grasp.stability", {max_force = limit_of(state)})) end
end

-- what yields, and at which fraction of the load
local function draw_certificate(ui, certificate)
  if not certificate then return end
  local what = certificate.contact and "the contact of " .. (certificate.contact.link or certificate.contact.other).name
    or certificate.dof and ("DOF %d"):format(certificate.dof) or "no single contact"
  ui:text(("%s yields first."):format(what:gsub("^%l", string.upper)), {color = orange, wrap = true})
  if certificate.power > 0 then ui:text(("%.1f %% of the load can be held."):format(100 * math.max(0, certificate.capacity) / certificate.power), {wrap = true}) end
end

local function draw_forces(ui, result)
  ui:text("forces of the contacts [N]", {color = gray})
  ui:table("optimal forces", {"link", "normal", "margin"}, {}, function(ui)
    for i, force in ipairs(result.forces) do
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

local function draw_result(view, ui, state)
  local result = state.result
  if not result then return end
  if state.hash ~= view.session.world:hash() then return ui:text("Something has moved since.", {color = gray}) end
  local good = result.status == "optimal" or result.status == "stable"
  ui:text(result.status, {color = good and {0, 0.5, 0.35} or orange})
  if not good then draw_certificate(ui, result.certificate) end
  if result.forces and #result.forces > 0 then draw_forces(ui, result) end
  if result.joint_torques and #result.joint_torques > 0 then draw_torques(ui, result.joint_torques) end
end

local function draw(ui, view)
  local session = view.session
  if not (session.hand and session.object) then return ui:text("A hand and an object are needed.", {color = gray, wrap = true}) end
  view.forces = view.forces or {objective = "min_sum", max_force = 0}
  ui:text(("load: weight of %s, %.3g kg"):format(session.object.name, session.object.mass), {color = gray, wrap = true})
  draw_options(view, ui, view.forces)
  draw_buttons(view, ui, view.forces)
  draw_result(view, ui, view.forces)
end

return {name = "Forces", place = "right", tab = true, draw = draw}
