---@meta clench
-- Made by `clench doc`.

---A vector of three numbers. It never changes: operators `+ - * /`, `==`, unary `-` and `#` make new values; `v[1]`, `v[2]`, `v[3]` are `v.x`, `v.y`, `v.z`.
---@class vec3
---@field x number # First coordinate.
---@field y number # Second coordinate.
---@field z number # Third coordinate.
local vec3 = {}

---Scalar product.
---@param other vec3
---@return number
function vec3:dot(other) end

---Vector product.
---@param other vec3
---@return vec3
function vec3:cross(other) end

---Length.
---@return number
function vec3:norm() end

---The same direction, length 1.
---@return vec3
function vec3:unit() end

---A rigid transform, which never changes. `a * b` chains two of them, `a * v` takes a point along, `==` compares bit by bit. Wherever a pose is wanted, the table that `clench.pose` takes will do.
---@class pose
---@field position vec3 # Where the frame's origin is. [m]
---@field quat number[] # The rotation as a unit quaternion, w x y z.
---@field rpy vec3 # The rotation as turns about the fixed x, y and z axes, in this order. [rad]
local pose = {}

---The way back: `p:inverse() * p` is the identity.
---@return pose
function pose:inverse() end

---Angle of the rotation, from 0 to pi.
---@return number # [rad]
function pose:angle() end

---The homogeneous matrix.
---@return number[][] # 4 rows of 4
function pose:matrix() end

---A direction turned by the rotation alone.
---@param direction vec3
---@return vec3
function pose:rotate(direction) end

---The pose between this one (t = 0) and another (t = 1): straight line, shortest turn.
---@param other pose
---@param t number
---@return pose
function pose:interpolate(other, t) end

---A stream of random numbers, made by `clench.random`.
---@class random
local random = {}

---A number from low (included, default 0) to high (excluded, default 1).
---@param low? number
---@param high? number
---@return number
function random:uniform(low, high) end

---A number of the normal distribution with mean 0 and deviation 1.
---@return number
function random:normal() end

---An integer from low to high, both included, each as likely.
---@param low integer
---@param high integer
---@return integer
function random:integer(low, high) end

---A unit vector, each direction as likely.
---@return vec3
function random:direction() end

---Bodies and robots, what may collide with what, how things rub. Lists are in creation order.
---@class world
---@field bodies body[] # All bodies in creation order: objects, obstacles, robot bases, links, mounts.
---@field objects body[] # The bodies that can be grasped.
---@field obstacles body[] # The bodies that only stand in the way.
---@field robots robot[] # All robots in creation order.
---@field contact_threshold number # Surfaces closer than this touch; motion stops with a gap below it. [m]
---@field materials string[] # Names of the materials, the seven of the original first.
---@field camera {eye: vec3, target: vec3, up: vec3, field_of_view: number}? # The camera of its file, as `clench.render` takes it: `clench.render(world, world.camera)`. nil when the file has none.
---@field source string # File that the world was loaded from; empty when it was made by a script.
local world = {}

---The body of a name.
---@param name string
---@return body
function world:body(name) end

---The robot of a name.
---@param name string
---@return robot
function world:robot(name) end

---Adds a body that can be grasped: from a file, or from a mesh of vertices and triangles in metres. What the options give overrides the file.
---@param body string|table # file name (.iv .wrl .obj .stl), or {vertices = {{x, y, z}, ...}, triangles = {{i, j, k}, ...}}
---@param options? {pose?: pose, name?: string, material?: string, mass?: number, com?: vec3, inertia?: number[][], elastic_modulus?: number, color?: number[], transparency?: number, root?: string, mesh_scale?: number} # mesh_scale: length of the unit of an .obj or .stl file, 1 by default [m]
---@return body
function world:add_object(body, options) end

---Adds a body that only stands in the way; as add_object.
---@param body string|table
---@param options? table
---@return body
function world:add_obstacle(body, options) end

---Adds a robot from a file.
---@param path string # .cfg
---@param options? {pose?: pose, name?: string, root?: string}
---@return robot
function world:add_robot(path, options) end

---Removes an object, an obstacle or a whole robot. Whoever still holds it gets an error that names it.
---@param thing body|robot
function world:remove(thing) end

---An independent copy that shares the meshes. Its things are found by name or place in its lists.
---@return world
function world:clone() end

---The state of the world now, exact to the bit.
---@return snapshot
function world:snapshot() end

---Back to a snapshot of this world: what was removed since is back, what was added since is gone.
---@param snapshot snapshot
function world:restore(snapshot) end

---Fingerprint of the state: equal bits, equal text.
---@return string # 16 hexadecimal digits
function world:hash() end

---Pairs of bodies that collide, of the world, of one thing, or between two. A closed body inside another collides too.
---@param a? body|robot
---@param b? body|robot
---@return body[][] # pairs
function world:colliding(a, b) end

---Least distance of two things, 0 when they collide, with the closest points in the world frame.
---@param a body|robot
---@param b body|robot
---@return number distance # [m]
---@return vec3 on_a
---@return vec3 on_b
function world:distance(a, b) end

---Where surfaces touch: everywhere, on one thing, or of `a` on `b`.
---@param a? body|robot
---@param b? body|robot
---@return contact[] # on b; without arguments on the object of each pair
function world:contacts(a, b) end

---Switches collision on or off: for the whole world, for one thing against everything, or for a pair.
---@param on boolean
---@param a? body|robot
---@param b? body|robot
function world:set_collision(on, a, b) end

---Sets the Coulomb coefficients of a pair of materials; new names become materials.
---@param a string
---@param b string
---@param friction {static: number, kinetic?: number} # kinetic: static - 0.1 unless given
function world:set_friction(a, b, friction) end

---The coefficients of a pair of materials.
---@param a string
---@param b string
---@return number static
---@return number kinetic
function world:friction(a, b) end

---The state of a world at a moment; `world:restore` goes back to it.
---@class snapshot
local snapshot = {}

---What bodies and robots have in common; of a robot these are its base's.
---@class thing
---@field material string # Name of its material, which decides how it rubs.
---@field mass number # Its mass. [kg]
---@field com vec3 # Centre of mass in the body frame. [m]
---@field inertia number[][] # Inertia about the centre of mass, in the body's axes, as rows. It scales with the mass. [kg m^2]
---@field mesh mesh? # Its surface; nil when it has none.
---@field elastic_modulus number? # Young's modulus; nil when it is rigid. [Pa]
---@field contacts contact[] # Where others touch it now.
---@field color number[] # Colour in pictures: red, green and blue in 0..1.
---@field transparency number # From 0, opaque, to 1, invisible.
local thing = {}

---A rigid thing in a world: an object, an obstacle, or a part of a robot.
---@class body: thing
---@field name string # Unique in its world.
---@field pose pose # Where it is, in the world frame. Setting it moves it at once, whatever is in the way; see move_to. The parts of a robot move with the robot.
---@field kind string # "object", "obstacle", "base", "link" or "mount".
---@field robot robot? # The robot that it is a part of; nil for objects and obstacles.
---@field source string # File that it was read from; empty when it was made by a script.
local body = {}

---Moves an object or obstacle along the straight line and shortest turn until it first touches something. The gap that remains is within the contact threshold. One that starts in contact may slide and leave, but is not pushed in.
---@param pose pose
---@return table result # `fraction` of the way gone, `touched`, `stopped_by` (pairs), `gave_up` (after a million steps), `queries`
function body:move_to(pose) end

---The triangles of a body's surface. Meshes never change, and clones of a world share them.
---@class mesh
---@field triangle_count integer # How many triangles it has.
---@field vertex_count integer # How many vertices it has.
---@field bounds {low: vec3, high: vec3} # Axis-aligned bounds in the body frame. [m]
---@field volume number # Volume that the surface bounds; parts that overlap count twice. Meaningful when it is watertight. [m^3]
---@field area number # Area of all its triangles. [m^2]
---@field faults string # What is wrong with it, counted.
---@field vertices vec3[] # A list of all vertices in the body frame. [m]
---@field triangles integer[][] # A list of all triangles: vertex numbers from 1, counter-clockwise from outside.
local mesh = {}

---Does the surface bound a solid: every edge between two triangles that agree?
---@return boolean
function mesh:is_watertight() end

---A hand or an arm: a base, chains of links, and the degrees of freedom that move them.
---@class robot: thing
---@field name string # Unique in its world.
---@field pose pose # Where its base is, in the world frame. Setting it moves the robot at once, with all that it carries; see move_to.
---@field dofs number[] # Values of its degrees of freedom; a list of its own, set as by set_dofs. [rad or m]
---@field dof_limits number[][] # Least and largest value of each DOF. [rad or m]
---@field dof_info table[] # What its file says of each DOF: kind ("rigid", "breakaway", "compliant"), default_velocity [rad/s or m/s], max_effort [N m or N], kp, kd, breakaway_torque [N m].
---@field links body[] # Its links, chain by chain, without the base.
---@field chains table[] # Its chains: `pose` in the base, `links`, and `joints` as they stand (kind, dof, ratio, min, max, value, broken_away).
---@field base body # Its base: palm or stand.
---@field bodies body[] # Base, links, and mount if it has one.
---@field approach {point: vec3, direction: vec3, frame: pose} # How it approaches what it grasps, in the world frame: `point` on the palm, `direction`, `frame` with +z along it.
---@field carrier robot? # The robot that carries it; nil when none does.
---@field class_name string # What its file calls its kind.
---@field source string # File that it was read from.
---@field files table # Files that its file names: `eigengrasps`, `virtual_contacts`, `glove_calibration`.
local robot = {}

---A link by its name, whole or without the robot's.
---@param name string
---@return body
function robot:link(name) end

---Sets all DOFs at once, whatever is in the way; see move_dofs. Joints that had broken away follow again.
---@param values number[] # within the limits [rad or m]
function robot:set_dofs(values) end

---Drives all DOFs in proportion towards values, until contact stops them.
---@param values number[] # within the limits [rad or m]
---@param options? {stop_at_contact?: boolean} # true: end at the first new contact of any link
---@return table result # as of autograsp
function robot:move_dofs(values, options) end

---Closes the hand: each DOF goes to its limit in the sense of its default velocity until contact stops it. Breakaway fingers go on beyond the joint that is stopped. Negative speed opens.
---@param options? {speed?: number, stop_at_contact?: boolean}
---@return table result # `moved`, `stops` (a DOF each: "contact", "limit", "reached", "still", "gave up"), `stopped_by` (pairs), `queries`, `events`
function robot:autograsp(options) end

---Opens the hand as far as it goes. One that overlaps something is opened without regard to contacts until it is free.
---@param options? table # no options yet
---@return table result # as of autograsp
function robot:open(options) end

---Moves the whole robot until it first touches something, as a body's move_to.
---@param pose pose
---@return table result # `fraction`, `touched`, `stopped_by`, `gave_up`, `queries`
function robot:move_to(pose) end

---Moves the hand along its approach direction until it touches something.
---@param options? {reach?: number} # at most this far, 1 by default [m]
---@return table result # `fraction`, `touched`, `stopped_by`, `gave_up`, `queries`
function robot:approach_object(options) end

---Fixes the robot to the last link of another one's chain. It follows from now on.
---@param carrier robot
---@param options? {chain?: integer, pose?: pose, piece?: string, root?: string} # chain 1 by default; pose of the base in the link; file of an adapter
function robot:mount_on(carrier, options) end

---A point where one body touches another, as it was when it was asked for.
---@class contact
---@field body body # The body that is touched: the object, of a hand and an object.
---@field other body # The body that touches it.
---@field link body? # The part of a robot among the two; nil when there is none.
---@field point vec3 # Where, on the surface of `body`, in the world frame. [m]
---@field normal vec3 # Unit normal into `body`, in the world frame.
---@field frame pose # Contact frame: origin at the point, +z into `body`.
---@field gap number # Distance of the two surfaces there, at most the world's contact threshold. [m]
---@field mu number # Static Coulomb coefficient of the two materials.
---@field mu_kinetic number # Kinetic Coulomb coefficient of the two materials.
---@field kind string # "point" (with friction) or "frictionless".
local contact = {}

---A hand, an object and the contacts between them, as they were when the grasp was measured.
---@class grasp
---@field hand robot # The robot that grasps.
---@field object body # The body that is grasped.
---@field contacts contact[] # The contacts on the object when the grasp was measured.
---@field rho number # Length that torques are divided by. [m]
---@field edges integer # Edges of each friction pyramid.
local grasp = {}

---A measure of the grasp: "epsilon", the radius of the largest ball of wrenches that it resists (0 unless force closure; Ferrari and Canny 1992), or "volume" of its wrench space.
---@param measure string
---@return number
function grasp:quality(measure) end

---Can it resist every wrench?
---@return boolean
function grasp:is_force_closure() end

---Its L1 wrench space about the object's centre of mass.
---@return wrench_space
function grasp:wrench_space() end

---Which wrenches contacts resist, with how much effort.
---@class wrench_space
---@field rank integer # Dimension that the wrenches span, 0 to 6.
local wrench_space = {}

---Radius of the largest ball of wrenches that is resisted; 0 unless force closure.
---@return number
function wrench_space:epsilon() end

---Volume in the six dimensions of wrenches; 0 below rank 6.
---@return number
function wrench_space:volume() end

---Is every wrench resisted?
---@return boolean
function wrench_space:is_force_closure() end

---The wrench on the object that is resisted worst.
---@return {direction: number[], resistance: number} # unit wrench, torque over rho; its largest multiple resisted
function wrench_space:weakest() end

---The unit wrenches, contact by contact.
---@return number[][][]
function wrench_space:wrenches() end

---A picture: red, green and blue, 8 bits each. `==` compares every pixel.
---@class picture
---@field width integer # Its width. pixels
---@field height integer # Its height. pixels
local picture = {}

---Writes a PNG file.
---@param path string
function picture:save(path) end

---Red, green and blue of a pixel, 0 to 255; (1, 1) is the upper left.
---@param x integer
---@param y integer
---@return integer red
---@return integer green
---@return integer blue
function picture:pixel(x, y) end

---Simulates, judges and plans robotic grasps. Lengths are metres, angles radians, masses kilograms, forces newtons; poses and vectors are in the world frame unless a text says otherwise.
---@class clench
---@field version string # Version of the engine, major.minor.patch.
local clench = {}

---Degrees to radians.
---@param degrees number
---@return number # [rad]
function clench.rad(degrees) end

---Radians to degrees.
---@param radians number
---@return number # [deg]
function clench.deg(radians) end

---Millimetres to metres.
---@param millimetres number
---@return number # [m]
function clench.mm(millimetres) end

---A vector of three finite numbers, from a list or one by one. Wherever a vec3 is wanted, {x, y, z} will do.
---@param x number[]|number
---@param y? number
---@param z? number
---@return vec3
function clench.vec3(x, y, z) end

---A rigid transform: the pose of one frame in another. The rotation is given one way at most.
---@param options? {xyz?: vec3, rpy?: number[], quat?: number[], matrix?: number[][]} # xyz [m]; rpy: turns about the fixed x, y, z axes, in this order [rad]; quat: unit, w x y z; matrix: 3 rows of 3 or 4, or 4 rows of 4
---@return pose
function clench.pose(options) end

---A stream of random numbers, fixed by a seed and the number of an item, the same on every machine.
---@param seed integer
---@param item? integer # which of many streams, default 0
---@return random
function clench.random(seed, item) end

---Paths of the models and worlds that come with Clench, sorted.
---@return {hands: string[], arms: string[], objects: string[], obstacles: string[], worlds: string[]}
function clench.catalog() end

---The module about itself: each library and class with its functions, fields and methods, each with name and doc; and the files of the standard library. Documentation, completion and help are made from it.
---@return {libraries: table[], classes: table[], files: table[]}
function clench.entries() end

---An empty world.
---@param options? {contact_threshold?: number} # surfaces closer than this touch, 1e-4 by default [m]
---@return world
function clench.world(options) end

---A world from a file. Names in it are looked up beside the file, then below the root.
---@param path string # .wld
---@param options? {root?: string}
---@return world
function clench.load(path, options) end

---The grasp of a hand on an object as it is now. No contact is no error: such a grasp resists nothing.
---@param hand robot
---@param object body
---@param options? {edges?: integer, rho?: number} # edges of the friction pyramids, 8; torque length, by default the object's largest radius about its centre of mass [m]
---@return grasp
function clench.grasp(hand, object, options) end

---All wrenches that contacts resist when their normal forces sum to at most one (norm "L1"). A contact is a list of unit wrenches {fx, fy, fz, tx, ty, tz}, torque over rho, or {point, normal, mu} in the object frame.
---@param options {contacts: table[], norm?: string, edges?: integer, rho?: number, com?: vec3}
---@return wrench_space
function clench.wrench_space(options) end

---Draws a world: robots, objects, obstacles, and friction cones where robots touch objects. The camera frames everything unless it is given, in whole or in part. The same world gives the same bytes. It needs EGL and OpenGL, but no display.
---@param world world
---@param options? {size?: integer[], eye?: vec3, target?: vec3, up?: vec3, field_of_view?: number, contacts?: boolean, ground?: boolean, transparent_objects?: boolean, file_colors?: boolean, samples?: integer} # size: width and height in pixels; field_of_view: vertical [rad]
---@return picture
function clench.render(world, options) end

---Values as JSON text, and back.
---@class clench.json
---@field null userdata # What stands for null in a list.
clench.json = {}

---A value as JSON. Keys are sorted and numbers come back to the bit, so equal values give equal text; integers stay integers. Poses and vectors are written too; functions, NaN and tables that contain themselves are refused.
---@param value any
---@param options? {indent?: integer} # blanks a level; default: all on one line
---@return string
function clench.json.encode(value, options) end

---The value of a JSON text. A null in a list is `clench.json.null`; in an object it is absent.
---@param text string
---@return any
function clench.json.decode(text) end

---Messages of scripts and of the engine, to stderr, so that they never mix with a script's output.
---@class clench.log
clench.log = {}

---Logs what only a developer wants to read.
---@param ... any
function clench.log.debug(...) end

---Logs what a user may want to know.
---@param ... any
function clench.log.info(...) end

---Logs what a user should know: what a file contains and the engine does not use, say.
---@param ... any
function clench.log.warning(...) end

---Logs what went wrong, and goes on.
---@param ... any
function clench.log.error(...) end

---Says from which level on messages are shown, and sets it if one is given.
---@param name? "debug"|"info"|"warning"|"error"|"quiet"
---@return string before
function clench.log.level(name) end

---Sends messages to a function(level, text) instead of stderr; without one, to stderr again.
---@param fn? fun(level: string, text: string)
function clench.log.sink(fn) end

return clench
