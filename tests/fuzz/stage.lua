-- Globals of the examples of the API's pages: those of a script, and the objects of a stage that the examples use by name.

-- worlds/dlr_flask.wld with the hand closed on the flask; made once, cloned for each example that uses it
local closed
local parts = {
  world = function()
    if not closed then
      closed = clench.load "worlds/dlr_flask.wld"
      closed.robots[1]:autograsp()
    end
    return closed:clone()
  end,
  hand = function(env) return env.world.robots[1] end,
  flask = function(env) return env.world.objects[1] end,
  grasp = function(env) return clench.grasp(env.hand, env.flask) end,
  patch = function(env)
    env.flask.elastic_modulus = 1.5e6
    return env.world:contacts(env.hand, env.flask)[4].patch
  end,
  ui = function() return clench.ui {size = {320, 240}} end,
}

--- A fresh environment of examples; other names are those of `globals`.
---@param globals table
---@return table
return function(globals)
  return setmetatable({}, {__index = function(env, name)
    if not parts[name] then return globals[name] end
    rawset(env, name, parts[name](env))
    return rawget(env, name)
  end})
end
