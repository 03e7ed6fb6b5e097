--- Variables of an eigengrasp planner: which of them are searched, and targets near which they stay, each with a confidence.
local variables = {}

local searches = {["planner.anneal"] = true, ["planner.loop"] = true, ["planner.guided"] = true}
local shown_here = {targets = true, fixed = true}

--- Does the planner of a command search variables by name?
function variables.has(command) return searches[command.name] == true end

--- Is a parameter shown by the table of variables?
function variables.shows(command, parameter) return variables.has(command) and shown_here[parameter.name] == true end

-- names of the variables, in order, for the hand, object and kind of search of the dialog
local function names_of(view, state)
  local session = view.session
  if not (session.hand and session.object) then return {} end
  local key = ("%s %s %s %s"):format(session.hand.name, session.object.name, state.position, state.posture)
  if state.variable_key ~= key then
    state.variable_key, state.variable_names = key, {}
    local ok, values = pcall(function()
      local copy = session.world:clone()  -- because a search moves its hand
      return clench.annealing {hand = session.hand:in_world(copy), object = session.object:in_world(copy), energy = function() return 0 end,
                               position = state.position, posture = state.posture}.values
    end)
    for name in pairs(ok and values or {}) do state.variable_names[#state.variable_names + 1] = name end
    state.variable_values = ok and values or {}
    table.sort(state.variable_names)
  end
  return state.variable_names
end

-- the options that the rows represent
local function apply(state)
  local targets, fixed = {}, {}
  for name, row in pairs(state.variable_rows) do
    if row.input then targets[name] = {row.target, row.confidence} end
    if row.off then fixed[#fixed + 1] = name end
  end
  table.sort(fixed)
  state.targets, state.fixed = next(targets) and targets or nil, #fixed > 0 and fixed or nil
end

local function draw_row(ui, state, name)
  local row = state.variable_rows[name] or {target = state.variable_values[name], confidence = 0.5}
  state.variable_rows[name] = row
  local changed, any
  ui:next_column()
  local on
  on, changed = ui:checkbox(name .. "##on", not row.off)
  if changed then row.off, any = not on, true end
  ui:next_column()
  row.input, changed = ui:checkbox("##input" .. name, row.input == true)
  any = any or changed
  ui:disabled(not row.input, function(ui)
    ui:next_column()
    ui:width(-1)
    row.target, changed = ui:drag("##target" .. name, row.target, {speed = 0.005, format = "%.3f"})
    any = any or changed
    ui:next_column()
    ui:width(-1)
    row.confidence, changed = ui:slider("##confidence" .. name, row.confidence, {min = 0, max = 1, format = "%.2f"})
    any = any or changed
  end)
  return any
end

--- Draws the table of variables.
function variables.draw(view, ui, state)
  state.variable_rows = state.variable_rows or {}
  local names = names_of(view, state)
  ui:collapsing("Variables", false, function(ui)
    local changed = false
    ui:table("variables", {"searched", "input", "target", "confidence"}, {}, function(ui)
      for _, name in ipairs(names) do changed = draw_row(ui, state, name) or changed end
    end)
    if changed then apply(state) end
  end)
end

return variables
