--- Planners that run as background jobs of the session, and commands for these jobs. Their parameters are those of the functions of `clench.plan`.
local arguments = require "clench.session.arguments"
local conditions = require "clench.session.conditions"
local descriptions = require "clench.signature.descriptions"

local more = "Grasp/More Planners"
local planners = {
  {"primitive", "Planner…", "Grasp"}, {"anneal", "EigenGrasp Planner…", "Grasp"}, {"sample", "Sampling Planner…", more}, {"antipodal", "Antipodal Planner…", more},
  {"random", "Random Planner…", more}, {"loop", "EigenGrasp Planner, Loop…", more}, {"guided", "EigenGrasp Planner, Guided…", more},
}
local plain = {number = true, integer = true, string = true, boolean = true, table = true, vec3 = true, pose = true}
local from_session = {hand = true, object = true, world = true}

-- the words of a type such as '"fingertip"|"power"'; nil for other types
local function choices_of(kind)
  local choices = {}
  for word in kind:gmatch "[^|]+" do
    choices[#choices + 1] = word:match '^"(.*)"$'
    if not choices[#choices] then return nil end
  end
  return choices
end

local known_energies  -- listed on first use

-- the energies of which hand and object are the required options
local function energies()
  if known_energies then return known_energies end
  local names = {}
  for name in pairs(clench.energy) do
    local required = {}
    for _, field in ipairs(descriptions.of("clench.energy." .. name).parameters[1].fields) do
      if not field.optional then required[#required + 1] = field.name end
    end
    if table.concat(required, " ") == "hand object" then names[#names + 1] = name end
  end
  table.sort(names)
  known_energies = names
  return names
end

-- values that a dialog suggests for an option which may also be a table or a function; nil: unknown
local function suggested_for(name, kind)
  if kind:find "|" and ("|" .. kind .. "|"):find("|boolean|", 1, true) then return {false, true} end
  if kind:find("string|energy", 1, true) then return energies end
  if name == "schedule" then return {"default", "loop", "modified", "strict", "online"} end
end

-- the parameter of a command for an option of a planner; nil for functions and for options that the session sets
local function parameter_of(field)
  local name, kind = field.name, field.type
  if from_session[name] or name:find("%.") or kind:find "^fun" then return nil end
  local choices = kind:find '^"' and choices_of(kind)
  return {name = name, type = choices and "string" or plain[kind] and kind or kind:find "%[%]$" and "table" or "any", choices = choices, suggested = not choices and suggested_for(name, kind) or nil, unit = field.unit,
          min = field.min, max = field.max, default = type(field.default) ~= "table" and field.default or nil, optional = true, text = field.text}
end

local function parameters_of(planner)
  local list = {{name = "hand", type = "robot", optional = true, text = "address of a robot; the current hand by default"},
                {name = "object", type = "body", optional = true, text = "address of the object; the current one by default"}}
  for _, field in ipairs(descriptions.of("clench.plan." .. planner).parameters[1].fields) do list[#list + 1] = parameter_of(field) end
  return list
end

-- descriptions of functions take time to parse, so the parameters are created on first use
local function with_parameters_of(planner, command)
  return setmetatable(command, {__index = function(_, key)
    if key ~= "parameters" then return nil end
    command.parameters = parameters_of(planner)
    return command.parameters
  end})
end

local function command_of(planner, label, menu)
  return with_parameters_of(planner, {
    name = "planner." .. planner, label = label, menu = menu, section = 2, enabled = conditions.hand_and_object, reads = true,
    run = function(session, args)
      local options = {}
      for name, value in pairs(args) do options[name] = value end
      options.hand = arguments.find_robot(session, args.hand)
      options.object = args.object and arguments.find_body(session, args.object) or session.object
      return session:add_job(clench.plan.start(planner, options), "planner." .. planner)
    end,
  })
end

local function has_jobs(session) return #session.jobs > 0, "no job was started" end

local function of_job(verb, label)
  return {name = "job." .. verb, label = label, menu = "Jobs", enabled = has_jobs, reads = true,
          parameters = {{name = "job", type = "integer", min = 1, optional = true, text = "number of the job in session.jobs; the last one by default"}},
          run = function(session, args)
            local job = arguments.find_job(session, args.job)
            job[verb](job)
          end}
end

local commands = {}
for i, planner in ipairs(planners) do commands[i] = command_of(table.unpack(planner)) end
for _, verb in ipairs {{"stop", "Stop"}, {"pause", "Pause"}, {"resume", "Resume"}} do commands[#commands + 1] = of_job(verb[1], verb[2]) end
return commands
