--- Handles of a chain's joints: for each DOF, at the first joint that it drives, an arc between its limits, or an arrow of a prismatic joint.
local drags = require "clench.view.drags"
local handles = require "clench.view.handles"
local manipulator = require "clench.view.manipulator"
local joint_handles = {}

local radius = 70  -- radius of arcs [pixels]
local tick = 9  -- length of the marks at limits, on either side [pixels]
local angle_step, step = math.pi / 12, 0.01  -- steps of snapping [rad, m]

local function chain_of(robot, link)
  for _, chain in ipairs(robot.chains) do
    for _, other in ipairs(chain.links) do
      if other == link then return chain end
    end
  end
end

-- The axis of a DOF from the motion of the first link that it moves: direction, a point on it, scale, radians or meters per unit of the DOF.
local function axis_of(robot, link, dof)
  local J = robot:jacobian(link)
  local function column(first) return clench.vec3(J[first][dof], J[first + 1][dof], J[first + 2][dof]) end
  local v, w = column(1), column(4)
  local origin = link.pose.position
  local rate = w:norm()
  if rate > 1e-9 then
    return {kind = "revolute", axis = w / rate, center = origin + w:cross(v) / (rate * rate), scale = rate}
  end
  rate = v:norm()
  return rate > 1e-9 and {kind = "prismatic", axis = v / rate, center = link.pose * link.com, scale = rate} or nil
end

local function text_of(robot, dof, kind)
  local value = robot.dofs[dof]
  return ("%s: %s"):format(robot.dof_names[dof], kind == "revolute" and ("%.1f°"):format(math.deg(value)) or ("%.1f mm"):format(value * 1000))
end

local function revolute_handle(view, joint, link, low, high, endless)
  local pixel = manipulator.pixel(view, joint.center)
  if not pixel then return nil end
  local towards = link.pose * link.com - joint.center
  local flat = towards - joint.axis * towards:dot(joint.axis)
  local u = flat:norm() > 1e-6 and flat:unit() or handles.plane_of(joint.axis)
  local v = joint.axis:cross(u)
  local size = radius * pixel
  if endless then low, high = -math.pi, math.pi end
  local line = handles.project(view, handles.arc(joint.center, u, v, size, low, high))
  local knob = handles.project(view, {joint.center + u * size})
  if not (line and knob) then return nil end
  local ticks = {}
  for _, angle in ipairs(endless and {} or {low, high}) do
    local outward = u * math.cos(angle) + v * math.sin(angle)
    ticks[#ticks + 1] = handles.project(view, {joint.center + outward * (size - tick * pixel), joint.center + outward * (size + tick * pixel)})
  end
  return {line = line, x = knob[1], y = knob[2], ticks = ticks}
end

local function prismatic_handle(view, joint, low, high)
  local line = handles.project(view, {joint.center + joint.axis * low, joint.center + joint.axis * high})
  local knob = handles.project(view, {joint.center})
  local pixel = manipulator.pixel(view, joint.center)
  if not (line and knob and pixel) then return nil end
  local side, ticks = handles.plane_of(joint.axis) * (tick * pixel), {}
  for _, at in ipairs {low, high} do
    local end_point = joint.center + joint.axis * at
    ticks[#ticks + 1] = handles.project(view, {end_point - side, end_point + side})
  end
  return {line = line, x = knob[1], y = knob[2], ticks = ticks}
end

-- the first link of a chain that each DOF moves: the DOFs in order and their links
local function driven(robot, chain)
  local order, links = {}, {}
  for _, link in ipairs(chain.links) do
    local J = robot:jacobian(link)
    for _, joint in ipairs(chain.joints) do
      local dof = joint.dof
      local moves = false
      for row = 1, 6 do moves = moves or dof and math.abs(J[row][dof]) > 1e-9 end
      if moves and not links[dof] then
        order[#order + 1], links[dof] = dof, link
      end
    end
  end
  return order, links
end

--- Handles of the chain of the selected link, with the Translate tool; none if no link is selected.
---@return table[] handles
function joint_handles.handles(view)
  local link = view.session.selection[1]
  if view.current_tool ~= "Translate" or not link or clench.type(link) ~= "body" or not link.robot then return {} end
  local robot = link.robot
  local chain = chain_of(robot, link)
  if not chain then return {} end
  local list, values, limits, infos = {}, robot.dofs, robot.dof_limits, robot.dof_info
  local order, links = driven(robot, chain)
  for i, dof in ipairs(order) do
    local joint = axis_of(robot, links[dof], dof)
    if joint then
      local low, high = (limits[dof][1] - values[dof]) * joint.scale, (limits[dof][2] - values[dof]) * joint.scale
      local handle
      if joint.kind == "revolute" then
        handle = revolute_handle(view, joint, links[dof], low, high, infos[dof] and infos[dof].endless)
      else
        handle = prismatic_handle(view, joint, low, high)
      end
      if handle then
        handle.name, handle.text, handle.knob = robot.dof_names[dof], text_of(robot, dof, joint.kind), true
        handle.kind, handle.joint, handle.dof, handle.target = "joint", joint, dof, robot
        handle.value, handle.limits = values[dof], limits[dof]
        handle.axis, handle.center, handle.color = joint.axis, joint.center, handles.colors[(i - 1) % 3 + 1]
        list[#list + 1] = handle
      end
    end
  end
  return list
end

--- Begins a drag of a DOF.
---@return table drag
function joint_handles.begin(view, handle, x, y)
  local robot, joint, dof = handle.target, handle.joint, handle.dof
  local start, limits, endless = robot.dofs[dof], robot.dof_limits[dof], robot.dof_info[dof] and robot.dof_info[dof].endless
  local turned = joint.kind == "revolute" and drags.turning(view, joint.center, joint.axis, x, y)
  local from = not turned and drags.along(view, joint.center, joint.axis, x, y)
  local gesture = view.session:begin_gesture(("Set %s of %s"):format(handle.name, robot.name))
  local drag = {target = robot, handle = handle.name, gesture = gesture}
  function drag.move(to_x, to_y, snaps)
    local travel = turned and turned(to_x, to_y) or from and (drags.along(view, joint.center, joint.axis, to_x, to_y) or from) - from or 0
    local value, by = start + travel / joint.scale, turned and angle_step or step
    if snaps then value = math.floor(value / by + 0.5) * by end
    if not endless then value = math.max(limits[1], math.min(limits[2], value)) end
    local goal = robot.dofs
    goal[dof] = value
    local contact = drags.touched(robot:move_dofs(goal))
    view.status = text_of(robot, dof, joint.kind) .. (contact and "; " .. contact or "")
    view.session:emit("changed", {gesture = true})
  end
  return drag
end

return joint_handles
