-- A figure for a paper: a grasp with its forces as cones, next to a plot of its epsilon over friction.
--   clench run examples/12_paper_figure.lua [PICTURE]
local clench = require "clench"
local path = arg and arg[1] or "build/figure.png"

local world = clench.load("worlds/dlr_flask.wld", {root = "."})
local hand, flask = world.robots[1], world.objects[1]
hand:autograsp()
local grasp = clench.grasp(hand, flask)
local firm = grasp:contact_forces {
  load = {0, 0, -9.81 * flask.mass, 0, 0, 0}, objective = "max_margin", max_force = 5,
}
assert(firm.status == "optimal")

-- white background, outlines, parallel projection; the height of a cone is proportional to the normal force
local picture = clench.render(world, {
  size = {720, 600}, background = "white", outline = 2, orthographic = true,
  forces = firm.forces, arrows = false, cones = "force", cone_height = 0.035,
})

-- the same contacts with different friction
local friction, epsilon = {}, {}
for i = 1, 16 do
  local points = grasp.points
  friction[i] = 0.1 * 10 ^ ((i - 1) / 15)
  for _, point in ipairs(points) do point.mu = friction[i] end
  epsilon[i] = clench.wrench_space {contacts = points, com = flask.com, rho = grasp.rho}:epsilon()
end
local curve = clench.plot {
  x_label = "friction coefficient", y_label = "epsilon", x_scale = "log", width = 720, height = 600,
  series = {{x = friction, y = epsilon}, {kind = "points", x = friction, y = epsilon}},
}
curve:save((path:gsub("%.png$", "") .. "_curve.svg"))

clench.sheet {
  pictures = {picture, curve.picture}, columns = 2,
  captions = {"(a) forces that hold the flask", "(b) epsilon over friction"},
}:save(path)
print("figure " .. path)

local red, green, blue = picture:pixel(1, 1)
assert(red == 255 and green == 255 and blue == 255 and epsilon[16] >= epsilon[1])
