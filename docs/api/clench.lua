---@meta clench
-- Made by `clench doc`.

---A vector of three numbers. It never changes: operators `+ - * /`, `==`, unary `-` and `#` make new values; `v[1]`, `v[2]`, `v[3]` are `v.x`, `v.y`, `v.z`.
---@class vec3
---@field x number # First coordinate.
---@field y number # Second coordinate.
---@field z number # Third coordinate.
local vec3 = {}

---Scalar product.
---@param other vec3 # other factor
---@return number
function vec3:dot(other) end

---Vector product.
---@param other vec3 # other factor
---@return vec3
function vec3:cross(other) end

---Length.
---@return number
function vec3:norm() end

---The same direction, length 1.
---@return vec3
function vec3:unit() end

---A rigid transform, which never changes. `a * b` chains two of them, `a * v` takes a point along, `==` compares bit by bit. Wherever a pose is expected, the table that `clench.pose` takes will do.
---@class pose
---@field position vec3 # Where the frame's origin is. [m]
---@field quat number[] # The rotation as a unit quaternion, w x y z.
---@field rpy vec3 # The rotation as turns about the fixed x, y and z axes, in this order. [rad]
local pose = {}

---The inverse: `p:inverse() * p` is the identity.
---@return pose
function pose:inverse() end

---Angle of the rotation, from 0 to pi.
---@return number # [rad]
function pose:angle() end

---The homogeneous matrix.
---@return number[][] # 4 rows of 4
function pose:matrix() end

---A direction turned by the rotation alone.
---@param direction vec3 # direction in the frame of the pose
---@return vec3
function pose:rotate(direction) end

---The pose between this one (t = 0) and another (t = 1): straight line, shortest turn.
---@param other pose # pose at t = 1
---@param t number # part of the path from this pose to the other
---@return pose
function pose:interpolate(other, t) end

---A stream of random numbers, made by `clench.random`.
---@class random
local random = {}

---A number from low (included, default 0) to high (excluded, default 1).
---@param low? number # lower bound
---@param high? number # upper bound
---@return number
function random:uniform(low, high) end

---A number of the normal distribution with mean 0 and deviation 1.
---@return number
function random:normal() end

---An integer from low to high, both included, each as likely.
---@param low integer # smallest result
---@param high integer # largest result
---@return integer
function random:integer(low, high) end

---A unit vector, each direction as likely.
---@return vec3
function random:direction() end

---A pose at the origin, each rotation as likely.
---@return pose
function random:rotation() end

---Bodies and robots, what may collide with what, friction. Lists are in creation order.
---@class world: world_queries
---@field bodies body[] # All bodies in creation order: objects, obstacles, robot bases, links, mounts.
---@field objects body[] # The bodies that can be grasped.
---@field obstacles body[] # The bodies that only stand in the way.
---@field robots robot[] # All robots in creation order.
---@field source string # File that the world was loaded from; empty when it was made by a script.
local world = {}

---The body of a name.
---@param name string # name of the body
---@return body
function world:body(name) end

---The robot of a name.
---@param name string # name of the robot
---@return robot
function world:robot(name) end

---Adds a body that can be grasped: from a file, or from a mesh of vertices and triangles in meters. What the options give overrides the file.
---@param body string|mesh|table # file name (.iv .wrl .xml .obj .stl .ply .off .gltf .glb .dae), or {vertices = {{x, y, z}, ...}, triangles = {{i, j, k}, ...}}
---@param options? {pose?: pose, name?: string, material?: string, mass?: number, density?: number, com?: vec3, inertia?: number[][], elastic_modulus?: number, soft_layer?: number, poisson_ratio?: number, restitution?: number, free_damping?: number, free_friction?: number, free_armature?: number, gravity_compensation?: number, color?: number[], transparency?: number, root?: string, confine?: string, strict?: boolean, unit?: string, mesh_scale?: number} # density: instead of the mass, of a watertight mesh [kg/m^3]; unit: of the file's coordinates, "mm", "cm", "m", "inch" or "foot"; mesh_scale: the same as a length [m]; without both what the file says, or else a guess, which is logged
---@return body
function world:add_object(body, options) end

---Adds a body that only stands in the way; as add_object.
---@param body string|mesh|table # file name, mesh, or vertices and triangles, as world:add_object takes them
---@param options? table # options of world:add_object, apart from those of moving bodies
---@return body
function world:add_obstacle(body, options) end

---Adds a robot from a file.
---@param path string # .cfg .xml .urdf .mjcf
---@param options? {pose?: pose, name?: string, root?: string, confine?: string, strict?: boolean, body?: string, folder?: string, package?: string|table, eigengrasps?: string, virtual_contacts?: string, close?: table, approach?: {point?: vec3, direction: vec3}|{frame: pose}} # body: of a scene of MuJoCo, the body that the robot's tree of joints begins with; folder: where names in the file are looked up, too; package: folder of the packages of a URDF, or folders by name; eigengrasps, virtual_contacts: files to read in place of those it names; close: which DOFs close it, {index_1 = 1, thumb = -1, [3] = 0}; approach: how it approaches, in its base
---@return robot
function world:add_robot(path, options) end

---Removes an object, an obstacle or a whole robot. Using it afterwards is an error that names it.
---@param entity body|robot # body or robot to remove
function world:remove(entity) end

---An independent copy that shares the meshes. Its bodies and robots are found by name, or by their places in its lists.
---@return world
function world:clone() end

---Makes the world what a clone of it is: state, bodies, robots and settings. Bodies and robots that were removed after the clone was made are back under their old handles.
---@param clone world # clone of this world whose state is taken
function world:become(clone) end

---The state of the world now, exact to the bit.
---@return snapshot
function world:snapshot() end

---Goes back to a snapshot of this world, of a clone of it, or of one that it is a clone of: what was removed since is back, what was added since is gone.
---@param snapshot snapshot # result of world:snapshot
function world:restore(snapshot) end

---Writes the world: as .xml or .mjcf a scene of MuJoCo, its meshes in a folder beside it, and its state now as the reference posture and as the key "start"; as .wld, or as .xml with the format "graspit", for GraspIt!; as a .lua script that holds everything. The old file stays until the new one has been read again; what the format cannot hold is told in a warning.
---@param path string # .xml, .mjcf, .wld or .lua
---@param options? {format?: string, root?: string, confine?: string} # format: of an .xml "mjcf" or "graspit"; default: "mjcf", unless a robot carries another one, as a scene read again has one robot in place of the two; names of files below the root are written from there on; files of bodies and robots are read again, but for those that do not lie below `confine`
function world:save(path, options) end

---Fingerprint of the state: equal bits, equal text.
---@return string # 16 hexadecimal digits
function world:hash() end

---The state of a world at a moment; `world:restore` goes back to it.
---@class snapshot
local snapshot = {}

---What bodies and robots have in common; a robot has what its base has.
---@class entity
---@field world world # The world that it is in.
---@field material string # Name of its material, which decides its friction.
---@field material_from "assumed"|"file"|"script" # Where the material comes from: its file, a script or option, or nowhere: then it is assumed.
---@field mass_from "assumed"|"file"|"script" # Where the mass comes from, likewise.
---@field mass number # Its mass. [kg]
---@field com vec3 # Center of mass in the body frame. Setting it takes an inertia that comes from its shape to the new center; one that was given stays. [m]
---@field inertia number[][] # Inertia about the center of mass, in the body's axes, as rows. It scales with the mass. No principal moment may exceed the sum of the others: no body has such an inertia. [kg m^2]
---@field fingerprint string # Identity by content: equal for bodies of the same surface, mass, inertia and material, whatever their files, names and poses. 16 hexadecimal digits
---@field mesh mesh? # Its surface; nil when it has none.
---@field visual_mesh mesh? # The mesh that pictures and pages draw: that for display where the file gives one, else its surface; nil when it has none.
---@field triangle_colors number[][]? # Colors of the triangles of `visual_mesh`, red, green and blue from 0 to 1, where the file gives several, by materials or textures; nil where the body has one color.
---@field textures table? # Images on the triangles of `visual_mesh`, as its file places them; nil where it has none. `images` is a list of `{jpeg =, width =, height =, wrap_u =, wrap_v =, tint =}`: the bytes of a JPEG file of at most 1024 pixels a side, how the image goes on beyond its edges ("repeat", "mirror" or "clamp"), and the factor of its colors. `numbers` and `places` are bytes for `string.unpack`: of each triangle the number of its image, `"<I2"`, 0 for none, and u and v of its three corners, `"<ffffff"`, v down from the top. Setting `color` removes the textures.
---@field mesh_report table? # How the triangles of its file were read and repaired: lines of text, and the same as fields `format`, `unit` [m], `unit_source` ("format", "file", "option" or "guess"), `up` (the axis of the file that became z), `triangles_read`, `vertices_read`, `welded_vertices`, `unused_vertices`, `dropped_triangles` (without area, or lying on others), `flipped` (was it inside out?). Nil when it has no mesh, or none from a file.
---@field restitution number # How it bounces: speed after a blow by that before, from 0 to 1. Of two bodies the larger counts, unless set_friction says what holds for their materials.
---@field free_damping number # Viscous resistance of an object that moves freely, or of the base of a robot that floats: a force on the origin of its frame against that point's velocity, and a torque against its turning. [N s/m and N m s/rad]
---@field free_friction number # Dry resistance of an object that moves freely, or of the base of a robot that floats: at most this force on the origin of its frame along each axis of the world, and at most this torque about each axis of its own. [N and N m]
---@field free_armature number # Inertia without weight of an object that moves freely, or of the base of a robot that floats: a mass at the origin of its frame, and a moment about every axis. [kg and kg m^2]
---@field gravity_compensation number # Part of its weight that simulations leave out: 1 for a body that floats. MuJoCo calls it `gravcomp`.
---@field elastic_modulus number? # Young's modulus; nil when it is rigid. [Pa]
---@field soft_layer number # Height of the soft layer of an elastic body. [m]
---@field poisson_ratio number # Poisson's ratio of an elastic body, below 0.5: its layer gives way by modulus / (1 - ratio^2).
---@field contacts contact[] # Contacts of other bodies with it now.
---@field color number[] # Color in pictures: red, green and blue in 0..1.
---@field transparency number # From 0, opaque, to 1, invisible.
local entity = {}

---A rigid body in a world: an object, an obstacle, or a part of a robot.
---@class body: motion
---@field name string # Unique in its world.
---@field pose pose # Where it is, in the world frame. Setting it moves it at once, whatever is in the way; see move_to. The parts of a robot move with the robot.
---@field kind string # "object", "obstacle", "base", "link" or "mount".
---@field robot robot? # The robot that it is a part of; nil for objects and obstacles.
---@field bounds_in_world {low: vec3, high: vec3}? # Least and largest coordinates of its surface in the world frame; nil when it has none. [m]
---@field source string # File that it was read from; empty when it was made by a script.
---@field tracker integer? # Number of the position sensor that is to move it; nil when its file names none.
local body = {}

---The same body in a clone of its world, or in the world of which its own is a clone.
---@param world world # a clone of its world, or the world of which its own is a clone
---@return body
function body:in_world(world) end

---Moves an object or obstacle along the straight line and shortest turn until it first touches something. The gap that remains is within the contact threshold. One that starts in contact may slide or move away, but not inwards.
---@param pose pose # target pose in the world
---@return table result # `fraction` of the way gone, `touched`, `stopped_by` (pairs), `iteration_limit` (after a million steps), `queries`
function body:move_to(pose) end

---The triangles of a body's surface. Meshes never change, and clones of a world share them.
---@class mesh
---@field triangle_count integer # How many triangles it has.
---@field vertex_count integer # How many vertices it has.
---@field bounds {low: vec3, high: vec3} # Axis-aligned bounds in the body frame. [m]
---@field volume number # Volume that the surface bounds; parts that overlap count twice. Meaningful when it is watertight. [m^3]
---@field centroid vec3 # Center of that volume: the center of mass of a uniform solid. Meaningful when it is watertight. [m]
---@field area number # Area of all its triangles. [m^2]
---@field faults string # Counts of its faults.
---@field fingerprint string # Equal for surfaces of the same triangles, whatever their order and the numbering of vertices. 16 hexadecimal digits
---@field vertices vec3[] # A list of all vertices in the body frame. [m]
---@field triangles integer[][] # A list of all triangles: vertex numbers from 1, counter-clockwise from outside.
local mesh = {}

---Does the surface bound a solid: every edge between two triangles that agree?
---@return boolean
function mesh:is_watertight() end

---The surface point nearest to a point of the body frame, with the outward normal of its triangle there.
---@param point vec3 # [m]
---@return {point: vec3, normal: vec3, triangle: integer, distance: number} # [m]
function mesh:closest_point(point) end

---Does the solid hold a point of the body frame? An open mesh holds none.
---@param point vec3 # [m]
---@return boolean
function mesh:contains(point) end

---Points of the surface at random, each piece of it as likely as its area, with the outward normals of their triangles.
---@param random random # source of the random numbers
---@param count integer # number of points
---@return {point: vec3, normal: vec3, triangle: integer}[] # [m]
function mesh:sample(random, count) end

---Writes the triangles, in meters. Numbers keep every digit, in .stl seven.
---@param path string # .obj .off .ply .stl
function mesh:save(path) end

---What every robot has for grasping: eigengrasps, virtual contacts, a glove, a position sensor.
---@class hand: robot_dynamics
---@field eigengrasps eigengrasps # Its eigengrasps, as they are at any time: those of its file, or one per DOF. Setting copies a set; nil leaves one per DOF.
---@field amplitudes number[] # Amplitudes of the posture of its eigengrasps that is nearest to its own. Setting takes that posture, as set_amplitudes.
---@field virtual_contacts virtual_contact[] # Where it would like to touch: those of its file, those it was given, or, when there are none of either, those that find_virtual_contacts finds, anew each time. Set to a list of virtual contacts, contacts, or tables as of add_virtual_contact; to {} for none, to nil for those that are found.
---@field has_own_virtual_contacts boolean # Do its virtual contacts come from a file or a script? Otherwise they are found from its geometry.
---@field glove {slopes: number[][], intercepts: number[]}? # Calibration of the data glove that its file names: `slopes` (a row per DOF, a number per sensor) and `intercepts`, so that DOF = intercept + slopes * raw. nil when there is none. [rad per count, rad]
---@field tracker {number: integer, pose: pose}? # Position sensor on it: its `number` and its mounting `pose` in the base. nil when there is none.
---@field tendons {name: string, stiffness: number, rest_length?: number, pre_tension_length?: number, points: {link: body, point: vec3, friction: number}[]}[] # Tendons of its file, as they are there; they exert no force. Points are in the frame of their link. [N/m, m]
---@field tendon_wrappers {link: body, point: vec3, axis: vec3, radius: number, friction: number, exempt: string[], sides: {tendon: string, direction: vec3}[]}[] # Posts that tendons wrap around, each an endless cylinder; `exempt` names the tendons that pass it by, `sides` say on which side of it the others lie. They have no effect.
---@field joint_tendons {name: string, dofs: integer[], arms: number[], length: number, range?: number[], stiffness: number, slack: number[], damping: number, friction: number}[] # Fixed tendons of an MJCF file that have a range, a spring or friction: `length` is the sum of `arms` times `dofs`. In simulations the length stays in `range`, a spring acts where it is outside `slack`, and each DOF feels its arm times the force of the tendon. What sets DOFs without a simulation does not look at them, nor does the engine "ode".
---@field actuators table[] # Actuators as an MJCF file describes them: `name`, `kind` ("motor", "position", "general"), `joint` or `tendon` with the joints that it `pulls`, `dof` that it moves, `gear`, `control_range`, `force_range`, and its law: force = gain * control + bias[1] + bias[2] * length + bias[3] * velocity. Where the file says so: `gain_slopes`, which times length and velocity add to the gain; `activation_range`, of what the law takes in place of the control; `law_range` of the force of a muscle, which only pulls; `tendon_force_range` of all actuators of the tendon; `enabled`, false of one that exerts nothing. `damping_ratio` is the `dampratio` of a servo, whose damping is not in its law. Of them the motors take which DOFs are driven, the largest efforts, and, as kp and kd, what bias[2] and bias[3] say of DOFs and of tendons; a script that sets forces may follow their laws.
---@field tactile_sensors {link: body, low: vec3, high: vec3}[] # Boxes in which contacts count as one sensor's, by their `low` and `high` corners in the frame of their `link`. They have no effect.
local hand = {}

---Takes the posture that amplitudes of its eigengrasps stand for, whatever is in the way. DOFs stop at their limits.
---@param amplitudes number[] # one amplitude per eigengrasp
---@param options? {keep?: boolean, fixed?: integer[]} # keep: what its posture has besides its amplitudes is kept; fixed: these amplitudes stay as they are
---@return integer[] clamped # numbers of the DOFs whose limit was in the way
function hand:set_amplitudes(amplitudes, options) end

---Drives the DOFs towards the posture of amplitudes, as move_dofs, until contact stops them.
---@param amplitudes number[] # one amplitude per eigengrasp
---@param options? {keep?: boolean, fixed?: integer[], stop_at_contact?: boolean} # keep and fixed as of set_amplitudes
---@return table result # as of autograsp, and `clamped`, numbers of the DOFs whose limit was in the way
function hand:move_amplitudes(amplitudes, options) end

---Marks a place: where it touches now (a contact), or one in the frame of a link (a body or its name).
---@param contact contact|virtual_contact|{link: body|string, point?: vec3, normal?: vec3, frame?: pose, mu?: number, torsion_radius?: number, edges?: number[][]} # normal: out of the link; mu 1 by default
---@return virtual_contact
function hand:add_virtual_contact(contact) end

---Takes one out of its list.
---@param number integer # number of the contact, from 1
function hand:remove_virtual_contact(number) end

---Places on its surface where it moves forward when the hand closes: the center of what each link sweeps, by area and speed along its normal, and one on the palm. Sets nothing.
---@param options? {count_per_link?: integer, palm?: boolean, object_material?: string} # where they are, and of what is grasped
---@return virtual_contact[]
function hand:find_virtual_contacts(options) end

---Writes its virtual contacts to a file, .vgr or .xml; clench.files.virtual_contacts reads it.
---@param path string # file to write
function hand:save_virtual_contacts(path) end

---What every robot knows of where its DOFs take its links: inverse kinematics and Jacobians.
---@class kinematics: hand
local kinematics = {}

---Inverse kinematics: values of its DOFs within their limits that bring a link to a pose; moves nothing. Where none are found, those that come nearest, a turn by 1 rad counted as a way of 0.1 m.
---@param link body|string # a link, or its name; or a body of a robot that it carries
---@param pose pose # where it is to be, in the world
---@param options? {frame?: pose, orientation?: "full"|"axis"|"none", dofs?: (integer|string)[], starts?: integer, seed?: integer, tolerance?: number, angle_tolerance?: number, collision_free?: boolean} # what is reached, and how it is searched for
---@return table result # `reached`, `dofs`, `distance` [m] and `angle` [rad] from the pose, `starts`, `iterations`, `in_collision` (starts that reached it, but collided)
function kinematics:ik(link, pose, options) end

---How its DOFs move a point: a row for each of vx, vy, vz [m per unit of the DOF], wx, wy, wz [rad per unit], in world axes, and a column for each DOF, with those of its joints that follow it.
---@param link body|string # a link, or its name; or a body of a robot that it carries
---@param point? vec3 # in its frame, its origin by default [m]
---@return number[][]
function kinematics:jacobian(link, point) end

---Values for all its DOFs, any within the limits as likely as any other; an endless DOF gets one within dof_limits, about where it is. Moves nothing.
---@param random random # source of the random numbers
---@return number[] # [rad or m]
function kinematics:random_posture(random) end

---What every robot can do with its degrees of freedom: set them, drive them, close and open.
---@class dofs: kinematics
---@field dofs number[] # Values of its degrees of freedom; a list of its own, set as by set_dofs. [rad or m]
---@field named_dofs table<string, number> # The same values by the names of dof_names; a table of its own, set as by set_dofs. [rad or m]
---@field dof_limits number[][] # Least and largest value of each DOF. Nothing stops one that is endless in dof_info: its range, a turn or a meter on either side of where it is, only says how far it closes, and what searches try. [rad or m]
---@field dof_info table[] # What its file says of each DOF: name, where it has one, kind ("rigid", "breakaway", "compliant"), default_velocity of closing [rad/s or m/s], max_effort [N m or N] (0: nothing limits it), max_velocity, where known, kp, kd, damping_ratio, where there is one, which adds 2 damping_ratio sqrt(kp inertia) to kd, breakaway_torque [N m], driven: false of a DOF that no actuator of an MJCF file can move (there is none, or its gear, gain or range is 0), and endless: true of one that no limit stops. can_close: its motor can push in the direction of default_velocity. effort_ranges says what the motors can exert.
---@field effort_ranges number[][] # Least and largest effort that the motor of each DOF can exert at rest where the DOF stands; math.huge where no limit is given, {0, 0} of a DOF that is not driven. Limits are max_effort of dof_info in both directions and, of MJCF files, gear, gain, bias, control range and force range of the actuators. Contact forces with torque_limits, verified grasps and the motors of world:run stay within them. [N m or N]
---@field max_effort number? # Largest effort, in both directions, of motors for which the file gives no limit; nil: unlimited. [N m or N]
---@field dof_names string[] # Names of its DOFs, as its file calls them; "dof1" and so on where it does not.
local dofs = {}

---Sets DOFs at once, whatever is in the way; see move_dofs. Joints that had broken away, or were held against their springs, follow again, but for those that the options name by chain, joint and the value at which they stand [rad or m].
---@param values number[]|table<string, number> # within the limits: all, or some by their names, the others as they are [rad or m]
---@param options? {joint_positions?: number[][]} # rows {chain, joint, value}
function dofs:set_dofs(values, options) end

---Sets the pose of its base and all its DOFs at once, whatever is in the way; DOFs stop at their limits. All joints follow their DOFs.
---@param pose pose # pose of the base in the world
---@param values number[]|table<string, number> # one per DOF, or some by name [rad or m]
---@return integer[]? # DOFs that stopped at a limit; nil: none
function dofs:set_posture(pose, values) end

---Drives all DOFs in proportion towards values, until contact stops them.
---@param values number[]|table<string, number> # as of set_dofs
---@param options? {stop_at_contact?: boolean} # how it moves
---@return table result # as of autograsp
function dofs:move_dofs(values, options) end

---Closes the hand: each DOF goes to its limit in the sense of its default velocity until contact stops it. Breakaway fingers go on beyond the joint that is stopped. The joints of compliant DOFs follow the balance of springs, contacts and friction: the tendon pulls on, and they yield and slide, until contacts take any further pull. Negative speed opens. With `dynamic` nothing moves yet: its motors are told to close, and do so while the world runs; then nothing is returned.
---@param options? {speed?: number, stop_at_contact?: boolean, dofs?: (integer|string)[], stages?: (integer|string)[][], dynamic?: boolean} # how it closes
---@return table result # `moved`, `stops` (one per DOF: "contact", "limit", "reached", "not_driven", "iteration_limit"), `stopped_by` (pairs), `queries`, `events`
function dofs:autograsp(options) end

---Opens the hand as far as it goes. One that overlaps something is opened regardless of contacts until it is free.
---@param options? table # no options yet
---@return table result # as of autograsp
function dofs:open(options) end

---A hand or an arm: a base, chains of links, and the degrees of freedom that move them.
---@class robot: dofs
---@field fingerprint string # Identity by content: equal for robots of the same links, joints, limits and motors, whatever their files, names, poses and postures. 16 hexadecimal digits
---@field mechanism_fingerprint string # Identity of what a posture places: shapes, links, frames, axes and DOFs of joints. Masses, materials, limits and motors do not count, nor do differences of frames below 1e-9 m. Grasps keep it, and `grasp:apply` compares it. 16 hexadecimal digits
---@field name string # Unique in its world.
---@field pose pose # Where its base is, in the world frame. Setting it moves the robot at once, with all that it carries; see move_to.
---@field links body[] # Its links, chain by chain, without the base.
---@field chains table[] # Its chains: `parent`, the base or the link that it begins on; `pose` in the parent of its first joint, or of its link where that is fixed, `links`, and `joints` as they stand (name, where its file names it, kind, dof, ratio, min, max, value, broken_away: did it leave a breakaway DOF?, spring_deflection: how far its DOF has gone on without it; spring [N m/rad or N/m] and rest, the value where it is slack, damping [N m s/rad or N s/m], friction [N m or N], effort_range of all actuators together [N m or N] and armature [kg m^2 or kg], of joints that have them).
---@field base body # Its base: palm or stand.
---@field bodies body[] # Base, links, and mount if it has one.
---@field approach {point: vec3, direction: vec3, frame: pose} # How it approaches what it grasps, in the world frame: `point` that goes there, on the palm or where it would hold a small object, `direction`, `frame` with +z along it. From its file, or a guess, which `clench check` tells.
---@field parent robot? # The robot that carries it; nil when none does.
---@field class_name string # What its file calls its kind.
---@field source string # File that it was read from.
---@field files table # Files that its file names: `eigengrasps`, `virtual_contacts`, `glove_calibration`.
local robot = {}

---The same robot in a clone of its world, or in the world of which its own is a clone.
---@param world world # a clone of its world, or the world of which its own is a clone
---@return robot
function robot:in_world(world) end

---A link, or the base, by its name, whole or without the robot's.
---@param name string # name of the link
---@return body
function robot:link(name) end

---Moves the whole robot until it first touches something, as a body's move_to.
---@param pose pose # target pose of the base in the world
---@return table result # `fraction`, `touched`, `stopped_by`, `iteration_limit`, `queries`
function robot:move_to(pose) end

---Moves the hand along its approach direction until it touches something.
---@param options? {reach?: number} # how far
---@return table result # `fraction`, `touched`, `stopped_by`, `iteration_limit`, `queries`
function robot:approach_object(options) end

---Places the hand so that its approach point stands before a target and its approach direction leads there, whatever is in the way. See `approach`.
---@param target pose|vec3 # of the approach frame, +z along the direction, or its point
---@param direction? vec3 # of approach, with a point: then the hand's turn about it follows from the world's x axis
---@param standoff? number # how far before the target, 0 by default [m]
function robot:place_approach(target, direction, standoff) end

---Fixes the robot to a link of another one: that of a name, or the last of a chain. It follows from now on.
---@param parent robot # robot that carries this one
---@param options? {chain?: integer, link?: string, pose?: pose, adapter?: string, root?: string, confine?: string, strict?: boolean} # chain 1 by default; pose of the base in the link; file of an adapter
function robot:mount_on(parent, options) end

---Takes the robot off the one that carries it: it stays where it is, without its adapter.
function robot:dismount() end

---A few postures whose sums are a hand's: each posture is an origin and an amplitude for each eigengrasp.
---@class eigengrasps
---@field vectors number[][] # A unit vector for each eigengrasp, one number per DOF.
---@field eigenvalues number[] # Weight of each eigengrasp: of principal components the variance of the postures along it.
---@field origin number[] # The posture of zero amplitudes, within the DOF limits. Where no file says it, the middle of the limits. [rad or m]
---@field norm number[] # Scale of the vectors' entries, one per DOF.
---@field limits number[][] # Range of each amplitude from the hand's posture, while the others stay: what its file says, else until the first DOF that it moves is at a limit. {least, largest} each
---@field range number[][] # Range of each amplitude overall: what its file says, else the least and largest of all postures within the DOF limits. {least, largest} each
---@field hand robot? # The hand whose set it is; nil for a set by itself.
---@field is_custom boolean # Does it come from a file or a script? A hand without a set of its own has one eigengrasp per DOF.
---@field count integer # How many there are, as # says.
local eigengrasps = {}

---Amplitudes of the posture of the set that is nearest to DOF values; without them, to the hand's own.
---@param dofs? number[] # [rad or m]
---@return number[]
function eigengrasps:amplitudes(dofs) end

---DOF values of amplitudes; they may lie outside the limits. With `from`, a posture, what it has besides its own amplitudes is kept.
---@param amplitudes number[] # one amplitude per eigengrasp
---@param options? {from?: number[]}
---@return number[] # [rad or m]
function eigengrasps:dofs(amplitudes, options) end

---Writes the set to a file, .egr or .xml; clench.files.eigengrasps reads it.
---@param path string # file to write; its ending selects the format
function eigengrasps:save(path) end

---A place on a link where a hand would like to touch what it grasps; it moves with the link.
---@class virtual_contact
---@field link body # The link that it lies on, or the base.
---@field chain integer # Number of the link's chain; 0 for the base.
---@field point vec3 # Where it is, in the world frame; it moves with its link. [m]
---@field normal vec3 # Unit normal out of the link, in the world frame: into what it is to touch.
---@field frame pose # Contact frame in the world: origin at the point, +z along the normal.
---@field frame_in_link pose # Contact frame in the link's.
---@field mu number # Coulomb coefficient that it counts with.
---@field edges number[][] # What friction a unit normal force carries, over mu: a list of {fx, fy, fz, tx, ty, tz} in the contact frame. torques [m]
---@field torsion_radius number # Largest torque about the normal that a unit normal force carries, over mu; 0 for a point. [m]
---@field kind string # "point", or "soft" when it carries torque about the normal.
local virtual_contact = {}

---A point where one body touches another, as it was when it was asked for.
---@class contact
---@field body body # The body that is touched: the object, of a hand and an object.
---@field other body # The body that touches it.
---@field link body? # The part of a robot among the two; nil when there is none.
---@field point vec3 # Where, on the surface of `body`, in the world frame. [m]
---@field normal vec3 # Unit normal into `body`, in the world frame.
---@field frame pose # Contact frame: origin at the point, +z into `body`.
---@field feature {kind: "vertex"|"edge"|"triangle"|"round", vertices?: integer[], triangle?: integer, piece?: integer} # The feature of the body's mesh that the contact lies on: a vertex, an edge between two, a triangle, or a round piece, counted from 1. It stays the same while the contact moves along it, so that contacts can be matched from step to step.
---@field other_feature {kind: "vertex"|"edge"|"triangle"|"round", vertices?: integer[], triangle?: integer, piece?: integer} # The same of the mesh of `other`.
---@field gap number # Distance of the two surfaces there, at most the world's contact threshold. [m]
---@field force vec3 # What pressed on body there in the last step of the world, in world axes; 0 in a world that has not run. [N]
---@field torsion number # Of a soft contact, the torque about the normal on body in the last step of the world. [N m]
---@field mu number # Static Coulomb coefficient of the two materials.
---@field mu_kinetic number # Kinetic Coulomb coefficient of the two materials.
---@field kind string # "point" (with friction), "soft" (with friction, of bodies one of which at least is elastic) or "frictionless".
---@field patch patch? # The surfaces around a soft contact, and the torsional friction that it transmits; nil for others. Contacts of two bodies whose neighborhoods overlap have one patch. A corner or an edge is logged as a warning.
local contact = {}

---The patch of a soft contact by options of one's own; nil of others.
---@param options? {radius?: number, max_radius?: number, fit?: "quadric"|"jet"} # where and how the surface is fitted
---@return patch?
function contact:fit_patch(options) end

---Contact forces and joint torques of a grasp.
---@class forces
local forces = {}

---Forces at the contacts that hold the object against a load, inside the exact friction cones. The load is a wrench {fx, fy, fz, tx, ty, tz} on the object from outside, in the world's axes, its torque about the object's center of mass; its weight is {0, 0, -9.81 * mass, 0, 0, 0}. Objectives: "min_sum", the least sum of normal forces (Han, Trinkle and Li 2000; Boyd and Wegbreit 2007); "min_norm", the least sum of squares of the forces, the only one that always has a single answer; "min_max", the least largest normal force; "max_margin", as far from the edges of the cones and from max_force as all can be; "max_margin_sum", the largest sum of the distances from the edges. `status`: "optimal"; "infeasible", with a `certificate`; "unbounded" when more force is always better; "inaccurate" when what was found does not pass its check: balance, cones, caps and optimum to 1e-9, and what is left of a load, to 1e-7 of it. A cap that does not bind changes nothing. `margin`: the least of the forces' margins, for "max_margin" of the distances from max_force, too; 0 when some force has to lie on an edge: then "max_margin" is optimal, but these contacts cannot keep inside their cones, as without force closure. `forces`: a list of {contact, normal, tangential, torsion, mu, force, margin}: tangential along x and y of contact.frame, force in the world's axes, margin from the edge of the cone [N, N m]. `unbalanced`: the wrench that is left, `residual` its length, torque over rho. `joint_torques`: of each DOF. `certificate`: a motion of the object, `twist`, along which the load's `power` is more than the `capacity` of caps and motors; `separation_rates` and `sliding_rates` of each contact along it; `force_limit_power`, `effort_limit_power` of the capacity; `contact` or `dof`, whichever gives way. `unlimited_efforts`: with torque_limits = true, names of the motors that have no limit; nil without any.
---@param options? {load?: number[], objective?: string, max_force?: number|number[], max_total_force?: number, total_force?: number, torque_limits?: boolean|number[], total_torque?: number, unilateral?: boolean, arms?: boolean, link_weights?: boolean, balance?: string} # max_force of each contact, or a list of one per contact, limit and value of their sum [N]; torque_limits: true, what each motor can exert, as in hand.effort_ranges; or a list of one per DOF, for both directions; without it motors give what is needed; total_torque: of all motors, closing [N m or N]; unilateral: motors do not open; arms: the motors of arms that carry the hand, too; link_weights: motors hold the links up as well, under the world's gravity; balance "nearest": the least unbalanced wrench instead
---@return table result # `status`, `forces`, `objective`, `margin`, `residual`, `unbalanced`, `joint_torques`, `certificate`
function forces:contact_forces(options) end

---The largest multiple `load` of a wrench on the object that forces at the contacts balance, its axes as in contact_forces. `status` "unlimited" when no cap and no torque ends it. The `certificate` says what gives way beyond it. `unlimited_efforts` as in contact_forces.
---@param options {direction: number[], max_force?: number|number[], max_total_force?: number, total_force?: number, torque_limits?: boolean|number[], total_torque?: number, unilateral?: boolean, arms?: boolean, link_weights?: boolean} # as in contact_forces
---@return table result # `status`, `load`, `forces`, `margin`, `joint_torques`, `certificate`
function forces:max_load(options) end

---Can the hand as it stands hold the load (as in contact_forces)? Its joints must be balanced too: by motors through their couplings, within hand.effort_ranges, by springs, and by the clutches of joints that have broken away. The palm takes what it must. `status`: "stable"; "unstable", then `unbalanced` is the least wrench that is left and `certificate` says what gives way; "moving" when no contact forces balance the joints, so that a finger moves; "inaccurate".
---@param options? {load?: number[], torque_limits?: boolean|number[], torques?: number[]|string, max_force?: number|number[], arms?: boolean, link_weights?: boolean} # torque_limits: one per DOF, for both directions, or false for none where a motor exerts anything; torques: what the motors give, one per DOF [N m or N]; "springs": compliant DOFs hold by their springs alone, clutches at their full torque; max_force: of each contact, or one per contact [N]
---@return table result # `status`, `forces`, `margin`, `residual`, `unbalanced`, `joint_torques`, `certificate`
function forces:equilibrium(options) end

---From contact forces to the wrench on the object: six rows, in the object's frame about its center of mass, unscaled. Columns contact by contact: the normal force; with friction then the forces along x and y of contact.frame; of soft contacts then the torque about the normal.
---@return number[][]
function forces:grasp_map() end

---How fast each DOF moves the contacts: a row for each column of the grasp map, a column for each DOF, by the ratios of its joints. Its transpose takes contact forces to the motors' torques. Joints that have broken away do not count.
---@return number[][]
function forces:hand_jacobian() end

---Measures of a grasp: quality, resistance, wrench spaces.
---@class measures: forces
local measures = {}

---A measure of the grasp by name: "epsilon", "volume" and all that clench.measures() lists with definition, range, unit and source. Infinite where there is nothing to measure, as the clearance of a hand alone. The world must stand as it did when the grasp was measured.
---@param measure string # name of a quality measure, from clench.measures
---@return number
function measures:quality(measure) end

---All measures at once, by name; those that are infinite are left out, and those that cannot be had, such as the volume of too many contacts with too many edges.
---@return table<string, number>
function measures:quality_all() end

---The largest multiple of a wrench on the object that contact forces in round cones balance, their normal parts summing to at most one newton (norm "L1") or each at most one ("Linf"); of several wrenches the least multiple; of an ellipsoid the largest that is resisted whole, by the friction cones of the grasp. World axes, torques about the center of mass.
---@param options {wrench?: number[], wrenches?: number[][], ellipsoid?: number[], norm?: string} # one of the first three; {fx, fy, fz, tx, ty, tz} [N, N m]; ellipsoid: its half axes
---@return number
function measures:resistance(options) end

---The surfaces of two bodies around a soft contact, and the torsional friction that it transmits.
---@class patch
---@field relative_radii number[] # Radii of the gap between the surfaces along `directions`, the more curved first: 1 over the sum of both curvatures. Where the surfaces separate more slowly than a ball of 2 m from a plane, or not at all, the `max_radius` of 20 mm stands for them, or the first radius when that is larger; between 1 m and 2 m the two are blended. [m]
---@field flat boolean[] # Is a relative radius the one that stands for a flat direction?
---@field curvatures {body: number[], other: number[]} # Principal curvatures of the surfaces of both bodies, descending: positive where a surface falls away from the other body, as a ball's, negative where it rises, as a socket's. [1/m]
---@field radii {body: number[], other: number[]} # The principal radii of both, 1 over the curvatures: negative where a surface is hollow; as large as you like where it is flat. [m]
---@field directions vec3[] # Of the relative radii: unit, orthogonal to each other and to the contact's normal, in the world frame.
---@field point vec3 # The middle of the patch, in the world frame: the contact's point, or the mean of those whose neighborhoods overlap. [m]
---@field points {body: vec3[], other: vec3[]} # What was fitted: points of both surfaces, in the world frame. [m]
---@field radius number # How far around the contact the surfaces were looked at. [m]
---@field residual number # How far the points lie from the fit, root of the mean square; of the worse surface. [m]
---@field at_edge boolean # Is there a corner or an edge, where curvature means little? Then only the part of the ellipse counts that certainly touches.
local patch = {}

---Where the bodies press on each other, after the bed-of-springs model (Winkler foundation): its semi-axes along `directions`, the indentation and the pressure in the middle, and the torsion radius, 8/15 of the semi-axes' geometric mean. It is nowhere wider than the bodies. At a corner, an edge or a rim the semi-axes are those of what certainly touches, where the gap is no wider than the indentation of flat surfaces; the indentation is the depth at which the springs under the actual gap add up to the force, within the neighborhood. `exceeds_layer` says that it exceeds the thickness of the soft layers, where the model no longer holds.
---@param options? {force?: number, modulus?: string} # normal force, 5 [N]; "series": both layers give way; "larger": only that of the larger modulus, as in GraspIt!
---@return {semi_axes: number[], indentation: number, pressure: number, torsion_radius: number, exceeds_layer: boolean} # [m], [m], [Pa], [m]
function patch:ellipse(options) end

---The largest torque about the normal that the contact resists, at rest: mu F times the torsion radius.
---@param options? {force?: number, modulus?: string} # as of `ellipse`
---@return number # [N m]
function patch:torsion_limit(options) end

---A hand, an object and the contacts between them, as they were when the grasp was measured.
---@class grasp: measures
---@field hand robot # The robot that grasps.
---@field object body # The body that is grasped.
---@field hand_name string # Name of the robot that grasps; a grasp that stands in no world has it, too.
---@field object_name string # Name of the body that is grasped.
---@field hand_file string? # File that the hand was read from, as it was named; nil: not known.
---@field object_file string? # File that the object was read from, as it was named; nil: not known.
---@field hand_fingerprint string # Fingerprint of the hand's shapes and joints when the grasp was measured: its `mechanism_fingerprint`; "" in a list from a file without it.
---@field object_fingerprint string # Fingerprint of the object's surface when the grasp was measured: that of its mesh; "" in a list from a file without it.
---@field settings_fingerprint string # Fingerprint of the options of its measures: edges, rho, soft, normal_force and modulus. Measures of grasps with equal ones can be compared.
---@field engine_version string # Version of Clench that measured the grasp; "" in a list from a file without it.
---@field pose pose # Where the hand's base stood in the object's frame when the grasp was measured.
---@field dofs number[] # Values of the hand's DOFs when the grasp was measured. [rad or m]
---@field dof_names string[] # Names of these DOFs; empty in a list from a file that does not name them.
---@field joint_positions number[] # Positions of the hand's joints when the grasp was measured. [rad or m]
---@field joint_names string[] # Names of these joints, followers included: those of the hand's file; else that of the DOF, of the joint that has its value; else "chain0_joint1". Empty in a list from a file that does not name them.
---@field joint_values number[] # The same positions as the hand's own file counts them, which other programs expect: they differ where the file's joint has another zero. [rad or m]
---@field measures table<string, number> # Measures that were asked for so far, by name; in a file they are kept with the grasp.
---@field info table<string, number> # Numbers that a script notes, by name: a seed, an energy, the number of a run. They are kept in files.
---@field labels table<string, string> # Words that a script notes, by name: its planner, its script. They are kept in files.
---@field pregrasp {pose: pose, dofs: number[]}? # How the hand stands before it comes to the object and closes: the `pose` of its base in the object, and its `dofs`. nil: not known. Planners set it; files keep it.
---@field squeeze number[]? # Targets of the motors that press on the object, one per DOF, perhaps beyond its limits; nil: not known. Planners that verify set it; files keep it. [rad or m]
---@field collision_free boolean? # Did nothing collide as the hand grasped? nil: nobody looked. Planners set it; files keep it.
---@field epsilon number? # The measure "epsilon", as it was measured or, else, from its points; nil of a grasp from a file that has neither.
---@field contacts contact[] # The contacts on the object when the grasp was measured.
---@field points {point: vec3, normal: vec3, mu: number, torsion_radius: number}[] # The same contacts in the object's frame, as clench.wrench_space takes them; torsion_radius is 0 of hard fingers. [m]
---@field links string[] # Names of what touches at each of the points.
---@field rho number # Length that torques are divided by. [m]
---@field com vec3 # The object's center of mass when the grasp was measured, in the object: torques are about it. [m]
---@field edges integer|string # Edges of each friction pyramid, or "exact".
---@field options {edges: integer|string, rho: number, soft: boolean, normal_force: number|number[], modulus: string} # The options with which clench.grasp measures another grasp in the same way. rho [m], normal_force [N]
local grasp = {}

---Puts the hand back into its pose relative to the object, wherever that is now, joints included, and measures the grasp there. Hand and object are found by their names unless they are given, DOFs by theirs where the grasp has them; DOFs that it does not have stay. Joints that a DOF moves may be listed, too: one that differs from what its DOF makes of it is warned of. A value up to 0.02 rad or 1 mm beyond a limit is set to the limit, with a warning if it is more than the rounding of 32 bits. DOFs without names are taken in the hand's order, with a warning if Isaac Sim numbers them otherwise, unless `dof_order` gives the order: "hand", "isaac", breadth first, or a list of names. Where an arm carries the hand, the arm moves, to the posture that `ik` finds first from where it is, with all that it carries. Nothing else moves, and collisions are not checked: see `world:collides`. A warning names a hand whose shapes or joints, or an object whose surface differs from the one that the grasp was measured with; masses, materials, limits and motors may differ.
---@param world? world # default: its own
---@param options? {hand?: robot, object?: body, dof_order?: string|string[]}
---@return grasp
function grasp:apply(world, options) end

---Values of all DOFs of a hand as `apply` would set them, and of its pregrasp, where it has one.
---@param hand robot # hand whose DOFs are wanted
---@param options? {dof_order?: string|string[]} # as `apply` takes it
---@return number[] dofs, number[]? pregrasp # [rad or m]
function grasp:dofs_for(hand, options) end

---Writes the grasp in its world as a scene of MuJoCo, as world:save does. The base of the hand stands on slides, named carriage_x, carriage_y and carriage_z, along the axes of the world. The keys "pregrasp", "grasp" and "lift" hold postures, and controls of the motors: in "grasp" and "lift" they press to the targets of `squeeze`, or, without it or with `force`, with contact forces in equilibrium; between "grasp" and "lift" the hand rises.
---@param path string # .xml or .mjcf
---@param options? {force?: number, height?: number, confine?: string} # force: sum of the normal forces, 10 times the object's weight by default, less where the motors cannot [N]; height: of the lift, 0.1 [m]
function grasp:save(path, options) end

---Can it resist every wrench?
---@return boolean
function grasp:is_force_closure() end

---Its wrench space about the object's center of mass: in the norm "L1" or "Linf"; with edges and rho of the grasp, or others; in some of the coordinates "fx" to "tz". All contacts together have at most 100,000 edges; more is an error of the kind "limit". The same options give the same space, which keeps what it has found.
---@param options? {norm?: string, edges?: integer|string, rho?: number|string, coordinates?: string[]}
---@return wrench_space
function grasp:wrench_space(options) end

---Which wrenches the contacts resist, and with how much effort.
---@class wrench_space
---@field rank integer # Dimension that the wrenches span, 0 to that of the space.
---@field norm string # "L1" or "Linf".
---@field coordinates string[] # The coordinates that count.
local wrench_space = {}

---Radius of the largest ball of wrenches that is resisted; 0 unless force closure. Good to 1e-12, with round cones to 1e-9 or, where that takes too many facets (rings of alike contacts, huge friction), a certified lower bound: epsilon_bounds says how near.
---@return number
function wrench_space:epsilon() end

---A certified bracket around epsilon, no tighter than need be: it ends when upper - lower is within the tolerance (1e-6), or when it is known whether epsilon reaches at_least.
---@param options? {tolerance?: number, at_least?: number}
---@return {lower: number, upper: number, converged: boolean, reached?: boolean} # converged: within the tolerance; reached: lower >= at_least
function wrench_space:epsilon_bounds(options) end

---Volume in the coordinates that count; 0 when the space is flat. With round cones the middle of volume_bounds. In "Linf" five hard contacts of eight edges or three soft ones are about the most: beyond 60,000 cells it is an error that says so.
---@return number
function wrench_space:volume() end

---A certified bracket around the volume: with round cones, that of pyramids within them and of the same ones grown until they are around. Both are the volume without round cones.
---@param options? {edges?: integer} # of the pyramids, 4 to 1000 (32)
---@return {lower: number, upper: number}
function wrench_space:volume_bounds(options) end

---Is every wrench resisted?
---@return boolean
function wrench_space:is_force_closure() end

---The wrench on the object that is resisted worst, and the contacts that give way first when it grows.
---@return {direction: number[], resistance: number, contacts: integer[]} # unit wrench, torque over rho; its largest multiple resisted, below 0 when all contacts push along it; numbers of the contacts that push against it at their limit
function wrench_space:weakest() end

---The unit wrenches, contact by contact.
---@return number[][][]
function wrench_space:wrenches() end

---The space in three coordinates. Of the others, `fixed` ones have a value, which gives its section, and `projected` ones may be anything, which gives its projection.
---@param options? {fixed?: table<string, number>, projected?: string[], tolerance?: number} # tolerance: of round cones, as a part of the space's size, 1e-3
---@return projection
function wrench_space:project(options) end

---A wrench space in three coordinates.
---@class projection
---@field volume number # Volume in the three coordinates; 0 when it is flat.
---@field mesh mesh # Its surface, x y z the free coordinates; nil when it is flat.
---@field free string[] # The coordinates that are left, which are x, y and z of the mesh.
---@field fixed table<string, number> # The values of the coordinates that were fixed.
---@field projected string[] # The coordinates that may be anything.
local projection = {}

---Draws it, transparent, with its axes and their numbers [N], the ball of epsilon as far as it lies in it, and the weakest direction; size, samples and camera as in clench.render.
---@param options? {ball?: boolean, weakest?: boolean, size?: integer[], samples?: integer, eye?: vec3, target?: vec3, up?: vec3, field_of_view?: number}
---@return picture
function projection:render(options) end

---A picture: red, green and blue, 8 bits each, and how much each pixel covers. `==` compares every pixel.
---@class picture
---@field camera table? # The camera of the picture, given or chosen, as options of clench.render; nil for figures. The same world drawn with it gives the same bytes. {eye: vec3, target: vec3, up: vec3, field_of_view: number, orthographic?: number}  [m], [rad]; orthographic: height that is shown [m]
---@field width integer # Its width. pixels
---@field height integer # Its height. pixels
local picture = {}

---Writes a PNG file, with alpha where the background is transparent.
---@param path string # file to write, .png
function picture:save(path) end

---Red, green and blue of a pixel, 0 to 255; (1, 1) is the upper left.
---@param x integer # column, from the left
---@param y integer # row, from the top
---@return integer red
---@return integer green
---@return integer blue
function picture:pixel(x, y) end

---How much a pixel covers, 0 to 255: less than 255 where a transparent background shows through; (1, 1) is the upper left.
---@param x integer # column, from the left
---@param y integer # row, from the top
---@return integer alpha
function picture:alpha(x, y) end

---The nearest surface under a pixel of a picture of a world, as the world was when it was drawn; bodies that one sees through count. nil where there is none. `body` and `other` are nil if they were removed since.
---@param x integer # column, from the left
---@param y integer # row, from the top
---@return table? picked # {kind: string, body?: body, other?: body, point: vec3, normal: vec3, distance: number}  kind: "body"; "contact" (a cone) or "patch", where body is touched by other; "approach", where body is the base of the robot; "force"; "floor"; or "other"; point: [m]; normal: unit, to the side of the camera; distance: from the camera [m]
function picture:pick(x, y) end

---Numbers as a figure, made by `clench.plot` or `clench.chart`. Two with the same contents are equal.
---@class plot
---@field picture picture # It as pixels, on white.
---@field width integer # Its width [pixels].
---@field height integer # Its height [pixels].
local plot = {}

---Writes a file: .svg, whose lines and letters a program for papers can change, or .png.
---@param path string # file to write, .svg or .png
function plot:save(path) end

---How far a script's loop is, as `clench.progress` shows it.
---@class progress
---@field done number # Steps that are done.
---@field total number # Steps in all; 0 when that is not known.
local progress = {}

---Counts so many more steps as done.
---@param count? number # default 1
---@param text? string # shown beside the bar from now on
function progress:step(count, text) end

---Removes the bar; a variable declared <close> does so by itself.
function progress:close() end

---A list of grasps, made by `clench.grasps`: `list[1]`, `#list`, `ipairs(list)`.
---@class grasps
local grasps = {}

---Adds a grasp at the end: its value as it is now, measures included.
---@param grasp grasp # grasp to append
---@return integer count
function grasps:add(grasp) end

---Writes the list. JSON lines (`.jsonl`, or no ending) hold all there is: a head with the version, then a grasp on each line, numbers to the bit. `.csv`, `.npz` and `.yaml` (NVIDIA's isaac_grasp) are known by their endings, too, GraspGen's and MultiGripperGrasp's `.json` by `format`; a warning names what a format does not hold. The same list gives the same bytes.
---@param path string # file to write; its ending selects the format
---@param options? {format?: string, notes?: table, compress?: boolean} # format: as clench.grasps takes it; compress: the arrays of an .npz; notes: plain data about the list as such, for the head of JSON lines
function grasps:save(path, options) end

---Checks that `save` can write there, before a long search for instance: the format is known, the folder exists, and file and folder may be written. Changes no file.
---@param path string # file that is to be written; its ending selects the format
---@param options? {format?: string} # as of `save`
---@return string format
function grasps:check_save(path, options) end

---A number for how a hand stands to an object, made by `clench.energy`.
---@class energy
---@field any_thread boolean # Is it made of the engine's terms alone? One with a function of a script runs on the script's thread, and in its world.
local energy = {}

---The same, but never below `low` nor above `high`; nil: no such bound.
---@param low? number # lower bound
---@param high? number # upper bound
---@return energy
function energy:within(low, high) end

---A function that runs beside the script, as `clench.job` starts it.
---@class job
---@field state "queued"|"running"|"paused"|"done"|"failed"|"stopped" # What it does at present.
---@field name string # Its name in messages.
---@field progress {fraction?: number, text: string} # How far its longest call is, or the loop that it shows by `clench.progress`. fraction: of the work, in [0, 1]; nil: not known
---@field snapshot any # The latest value that it has shown by `clench.this_job:show`; nil before the first.
local job = {}

---Waits for its end. Coroutines of `clench.loop` do not run meanwhile: in them, `clench.loop.wait(job)` waits.
---@param seconds? number # at most so long; 0: not at all [s]
---@return boolean over # is it done, failed or stopped?
function job:wait(seconds) end

---What its function returned. Raises the function's error, and an error if the job was stopped or is not over yet.
---@return any ...
function job:result() end

---Stops it within some 100 ms, in Lua and in calls of the engine; other programs that it has started and not waited for to the end are ended, too. In a call of string.find with a hostile pattern it ends after that call. What is over stays as it is.
function job:stop() end

---Holds it at its next instruction in Lua; a call of the engine ends first.
function job:pause() end

---Lets it run on after `pause`.
function job:resume() end

---All values that it has sent by `clench.this_job:event` since the last call, in order.
---@return any[] events
function job:events() end

---What a job's function, in its own state, reports by.
---@class this_job
---@field shared any # A copy of the option `shared` of clench.job; worlds in it are those of the arguments.
local this_job = {}

---Sends a value to the script that has started the job. Events arrive in order, and none is lost.
---@param value any # of the kinds that clench.parallel.map hands over
function this_job:event(value) end

---Shows a value in place of the one shown before: what `job.snapshot` is.
---@param value any # of the kinds that clench.parallel.map hands over
function this_job:show(value) end

---A chain of simulated annealing, made by `clench.annealing`.
---@class annealing
---@field best {energy: number, step: integer, pose: pose, dofs: number[], values: table}[] # The best states met, no two alike: `energy`, `step`, `pose` of the hand in the object, `dofs`, and `values` of the variables by name.
---@field state table # Where the chain is, as `best` has it; its energy is infinite where it begins in collision.
---@field values table # Values of its variables by name.
---@field energy number # Of the state that the chain is at; infinite where it begins in collision.
---@field first_energy number # Of the state that it began with.
---@field counts table # What became of its steps: `steps`, `accepted`, `improved`; and of neighbors that were none: `in_collision`, `avoided`, `outside` their ranges; `stuck`: how often all tries of a step failed.
local annealing = {}

---Takes steps, each to a legal neighbor that is accepted or not.
---@param steps integer # steps to take at most
---@return integer taken # fewer where 10,000 tries in a row found no legal neighbor
function annealing:run(steps) end

---Goes around a state from now on: its like are illegal.
---@param state {pose: pose, dofs: number[]} # as `best` lists them
function annealing:avoid(state) end

---Goes to a state, or as near as its variables can.
---@param state {pose: pose, dofs: number[]}
---@return table values
function annealing:go_to(state) end

---Begins the schedule of temperatures anew.
function annealing:reset() end

---Empties the list of the best states; what is avoided stays so.
function annealing:clear() end

---What holds for all of a world: friction of materials, what may collide, gravity, its camera, its named states.
---@class world_settings
---@field contact_threshold number # Surfaces closer than this touch; motion stops with a gap below it. [m]
---@field materials string[] # Names of the materials, the seven of the original first.
---@field camera {eye: vec3, target: vec3, up: vec3, field_of_view: number}? # The camera of its file, as `clench.render` takes it: `clench.render(world, world.camera)`. nil when the file has none. It is set by such a table, or by `pose` (it looks along -z, y up) and `focal_distance` [m].
---@field gravity vec3 # Acceleration of everything that is free to fall, in the world frame: what weighs on joints and objects. [m/s^2]
---@field keyframes string[] # Names of its named states, those of its file first; `set_keyframe` goes there.
local world_settings = {}

---Switches collision on or off: for the whole world, for one entity against everything, or for a pair.
---@param on boolean # true: collisions count; false: they are ignored
---@param a? body|robot # one of two; without both, the setting is for all
---@param b? body|robot # the other of two; without it, all pairs of the first
function world_settings:set_collision(on, a, b) end

---Does collision count for a pair, for one entity with anything, or for anything in the world? False for pairs that `set_collision` or `set_collision_bits` has switched off, and for neighbors of a robot.
---@param a? body|robot # one of two; without both, any pair counts
---@param b? body|robot # the other of two; without it, any body
---@return boolean
function world_settings:may_collide(a, b) end

---Sets the collision bits of bodies, like `contype` and `conaffinity` of MuJoCo: two bodies with bits, not of one robot, collide if the type of one and the affinity of the other share a bit. Fixed bodies do not collide with each other. A later `world:set_collision(true, a, b)` makes a pair collide whatever its bits are.
---@param entity body|robot # body or robot to set
---@param bits? {type?: integer, affinity?: integer, fixed?: boolean} # type and affinity: 1 by default; fixed: is it fixed to the world? false by default
function world_settings:set_collision_bits(entity, bits) end

---Sets the Coulomb coefficients of a pair of materials; new names become materials.
---@param a string # name of a material
---@param b string # name of the other material, or of the same
---@param friction number|{static: number, kinetic?: number, restitution?: number} # a number is both coefficients; kinetic: static - 0.1 unless given; restitution: speed after a blow by that before, 0 to 1, in place of what the bodies say
function world_settings:set_friction(a, b, friction) end

---The coefficients of a pair of materials.
---@param a string # name of a material
---@param b string # name of the other material, or of the same
---@return number static
---@return number kinetic
---@return number? restitution # where the pair has one of its own
function world_settings:friction(a, b) end

---Gives a name to a state: to that of now, or to one that a list tells. A keyframe of the same name gives way.
---@param name string # name of the keyframe
---@param states? table[] # {body = body, pose = pose} and {robot = robot, pose = pose?, dofs = number[], or some by name}; what is not listed stays where it is; DOFs that are not named get the values that they have now
function world_settings:add_keyframe(name, states) end

---Moves everything that a keyframe names to where it says, whatever is in the way. What was removed since stays out, and a robot that is carried stays on its carrier.
---@param name string # name of the keyframe
function world_settings:set_keyframe(name) end

---What every world answers: what collides, how far things are apart, where they touch, what a ray meets.
---@class world_queries: world_dynamics
local world_queries = {}

---What a ray meets first: `body`, `point`, `normal` out of its surface, `distance` [m] and `triangle`; nil when it meets nothing.
---@param origin vec3 # first point of the ray in the world
---@param direction vec3 # of any length
---@param reach? number # how far it goes [m]; as far as there is something by default
---@return table?
function world_queries:raycast(origin, direction, reach) end

---Does anything collide that may, or one entity with anything? The fastest test: it ends at the first pair that is found.
---@param entity? body|robot # body or robot to test against all others
---@return boolean
function world_queries:collides(entity) end

---Pairs of bodies that collide, of the world, of one entity, or between two. A closed body inside another collides too.
---@param a? body|robot # one of two
---@param b? body|robot # the other
---@param options? {max?: integer} # max: largest number of pairs, the first ones in creation order; all by default
---@return body[][] # pairs
function world_queries:colliding(a, b, options) end

---Least distance of two things, 0 when they collide, with the closest points in the world frame.
---@param a body|robot # one of two
---@param b body|robot # the other
---@return number distance # [m]; infinite where one has no surface, and from a body to itself
---@return vec3 on_a
---@return vec3 on_b
function world_queries:distance(a, b) end

---Depth of the overlap: the largest distance, from the surface of `b`, of a point of `a` inside it, with that point in the world frame. It is at most 1 um + 0.1 % below the true one, and 0 only where the two do not overlap or just touch. Nothing is inside an open mesh: if that of `b` is open, points of `b` inside `a` count; if both are, the depth is infinite where they cross.
---@param a body|robot # one of two
---@param b body|robot # the other
---@return number depth # [m]
---@return vec3? point # the deepest one; none where nothing overlaps
function world_queries:penetration(a, b) end

---Where surfaces touch: everywhere, on one entity, or of `a` on `b`. After a step all that pressed in it are among them; a ball touches as a sphere, outside its facets.
---@param a? body|robot # only contacts of this one
---@param b? body|robot # only contacts between both
---@return contact[] # on b; without arguments on the object of each pair
function world_queries:contacts(a, b) end

---How a world moves: time, steps, momentum, and what presses on what.
---@class world_dynamics: world_control
---@field time number # How long it has run. [s]
---@field time_step number # Length of the steps of `run`; from 1e-7 to 1. [s]
---@field dynamics {time_step: number, engine: string, cone: string, edges: integer} # How steps are solved; a table of its own, and a table that is set changes what it names. `engine`: "clench", or "ode", which solves the same contacts by another library, at most 1,000 points in a step; `cone`: friction cones are "round", or a "pyramid" of `edges` edges, of which bodies that touch each other have at most 6,000; more is an error of the kind "limit".
---@field report {steps: integer, impacts: integer, iterations: integer, fallbacks: integer, failures: integer, overlaps: integer, contacts: integer, residual: number, max_residual: number} # What steps came to: how many there were, how many ended early because bodies met (`impacts`), what the solver took (`iterations`; of groups of bodies that touch each other, `fallbacks`, that needed its slow methods, and `failures`, that it did not solve to 1e-9 m/s, or 1e-8 m/s of what rests), pairs that stood in each other (`overlaps`), points that touched in the last step, and what faults the solutions have as velocities [m/s].
local world_dynamics = {}

---Simulates: everything that is free moves by gravity, contacts and the motors of robots. Each step first moves bodies with the velocities that they have, then finds contacts, then solves for new velocities. Afterwards exactly so much time has passed.
---@param seconds number # [s]
function world_dynamics:run(seconds) end

---The first half of a step: moves everything with the velocity that it has, until the time has passed or two bodies that approach each other touch.
---@param dt number # [s]
---@return number passed # in (0, dt] [s]
function world_dynamics:move_bodies(dt) end

---The second half of a step: the velocities that contacts, forces, motors and limits leave after the time in which they act.
---@param h number # what move_bodies gave [s]
function world_dynamics:solve_velocities(h) end

---Takes back what `apply_force` and `apply_torque` gave for the next step.
function world_dynamics:clear_forces() end

---Of all objects and robots; the angular one about the origin of the world.
---@return {linear: vec3, angular: vec3} # [kg m/s], [kg m^2/s]
function world_dynamics:momentum() end

---Of all objects and robots: of motion, and of height above the origin of the world and springs.
---@return {kinetic: number, potential: number} # [J]
function world_dynamics:energy() end

---What presses on each of some bodies, after the last step: the sum of the forces and their center. Bodies on which nothing presses are left out.
---@param links body|body[] # link or links whose contacts are averaged
---@return {link: body, force: vec3, point: vec3, count: integer}[] # [N], [m]
function world_dynamics:average_contacts(links) end

---Scripts that take part while a world runs.
---@class world_control: world_settings
local world_control = {}

---Has a function called while the world runs, before each step, or so often: fn(world, dt), with the length of the step that comes (an impact may cut it short), or of the time until it is called again [s]. Functions are called in the order in which they were given; an error in one ends the run, and tells where it was. They belong to the world, not to its clones or snapshots.
---@param fn function # called after each step
---@param options? {rate?: number} # how often
---@return table handle # `remove()` ends it
function world_control:on_step(fn, options) end

---Has a function run beside the world, as a coroutine: fn(task). It goes on when `task.wait(seconds)` is over, when `task.wait_until(condition, timeout)` finds the function `condition` true, which gives true, or the time over, which gives false, and before the next step after `task.wait_step()`. Tasks go on before steps, after the functions of on_step, in the order in which they were spawned; an error in one ends the run. A yield of nothing waits for the next step; a yield of anything else is an error.
---@param fn function # function that runs as a coroutine in the time of the world
---@return table handle # `remove()` ends it; `status`: "waiting", "done", "failed" or "removed"
function world_control:spawn(fn) end

---Has a function called after each step in which something happens: "contact", two bodies touch that did not before, fn {kind, time, a, b, point, force}, with the middle of the contact [m] and the force on b [N]; "contact_lost", {kind, time, a, b}; "limit", a DOF reaches an end of its range, {kind, time, robot, dof, side, value}, with its number and "low" or "high".
---@param event "contact"|"contact_lost"|"limit" # name of the event
---@param fn function # called at each such event
---@return table handle # `remove()` ends it
function world_control:on(event, fn) end

---Notes quantities while the world runs, from its first step on, at a rate of its time. In `quantities` stand, in order: bodies, of which place and velocity are noted; robots, their DOFs, velocities and efforts; "energy", "momentum", "contacts", "failures"; and by their names functions(world) that give a number, true or false, a vector, or a list of numbers that stays as long. Time is noted first.
---@param options {rate?: number, quantities: table} # what is noted, and how often
---@return log log # `rows`, a list of {time, ...}; `columns`, their names; `save(path)`, as .csv or .npz; `remove()` ends it
function world_control:log(options) end

---Records how the world runs, for films: its state at a rate of its time.
---@param options? {rate?: number} # how often
---@return recording recording # `times`; `save(path, options)`, see the guide; `remove()` ends it
function world_control:record(options) end

---Puts the state of the world on a stack of its own.
---@return integer depth # how many lie there now
function world_control:push() end

---Goes back to the state that was pushed last, and takes it from the stack.
---@return integer depth # how many are left
function world_control:pop() end

---How bodies and robots move: velocity, and what pushes them.
---@class motion: entity
---@field velocity {linear: vec3, angular: vec3} # Of its center of mass, and of its turning, in world axes. An obstacle, and the base of a robot, move by theirs as they are told, whatever they push. A table of its own; one that is set changes what it names. Setting a pose brings a body to rest. [m/s], [rad/s]
---@field surface_velocity vec3 # Of a conveyor belt: what touches it is carried along at this velocity, in its own frame, while it stands. Only the part along the surface counts. [m/s]
---@field welded_to body? # The body that it is welded to, or nil.
local motion = {}

---Pushes it in the next step, and in that one alone; pushes add up. Neither an obstacle nor the base of a robot that does not float can be pushed.
---@param force vec3 # in world axes [N]
---@param point? vec3 # where, in the world; its center of mass by default [m]
function motion:apply_force(force, point) end

---Turns it in the next step, and in that one alone.
---@param torque vec3 # in world axes [N m]
function motion:apply_torque(torque) end

---Makes it one piece with another body, as the two stand: in runs it moves as a part of that, with its mass, until it is unwelded. Contacts between the two end. Their momentum stays, as in a blow after which they go on together. Placed by hand, they stay welded as they then stand. Collision tests go on as before.
---@param to body|robot # a body that does not hang on it by welds; of a robot its base
function motion:weld(to) end

---It goes on by itself, with the velocity that it has.
function motion:unweld() end

---Masses and forces as a robot's DOFs feel them.
---@class joint_dynamics: motion
---@field gains {kp: number, kd: number}[] # How stiff its motors hold it, one per DOF: those that were set; else those of its file; else such that a DOF swings back at 60 rad/s with critical damping, as it stands. Set a list of them, or some by the names of their DOFs, with false for those of the file; nil: all of the file. [N m/rad or N/m], [N m s/rad or N s/m]
local joint_dynamics = {}

---Inertia of its DOFs where it stands: half of v M v is the energy with which velocities v of the DOFs move it and all that it carries, its base held. Armature of the joints is in it.
---@return number[][] rows # one row and one column per DOF [kg m^2, kg m or kg]
function joint_dynamics:mass_matrix() end

---Forces on its DOFs that velocities cause (Coriolis, centrifugal), and weight, unless its motors compensate that: what motors have to give so that no DOF accelerates, joints without springs and friction.
---@return number[] forces # one per DOF [N m or N]
function joint_dynamics:bias_forces() end

---Forces that its motors have to give for these accelerations of the DOFs, where nothing touches it: mass matrix, bias forces, springs and viscous friction of the joints; not their dry friction.
---@param accelerations number[] # one per DOF [rad/s^2 or m/s^2]
---@return number[] forces # one per DOF, as set_forces takes them [N m or N]
function joint_dynamics:inverse_dynamics(accelerations) end

---How a robot's motors move it.
---@class robot_dynamics: joint_dynamics
---@field dof_velocities number[] # Of its degrees of freedom; a list of its own. [rad/s or m/s]
---@field dof_efforts number[] # What its motors gave in the last step. [N m or N]
---@field controller "position"|"velocity"|"effort"|"none"|"mixed" # What its motors do: "position", they hold it at its targets by the gains of its file; "velocity", they keep the velocities that are asked for; "effort", they give the forces that set_forces says, and nothing else, as DOFs that no actuator of a MuJoCo file drives do at first ("none" is another word for it); "mixed": not all the same. `set_targets`, `set_target_velocities` and `autograsp {dynamic = true}` switch the DOFs that they move.
---@field gravity_compensation boolean # Do its motors carry the weight of its own links, without what is welded to them? As controllers of real arms do. A floating robot has all its weight.
---@field breakaway boolean # Do joints leave its breakaway DOFs while the world runs, when what stops them asks for more than the breakaway torque? They are then locked until the DOF, opening, comes back to them. Else, as in GraspIt!'s dynamics, the DOF drives all its joints rigidly.
---@field floating boolean # Is its base free to move? Else it stands, or moves as its velocity says.
local robot_dynamics = {}

---What each motor gives from now on: beside what its controller does, or alone with the controller "none". DOFs that a table by names leaves out keep what they had.
---@param forces number[]|table<string, number> # [N m or N]
function robot_dynamics:set_forces(forces) end

---Where its motors are to bring it: at once, or on a smooth way (a polynomial of the fifth degree in time). DOFs that a table by names leaves out go on as they did.
---@param dofs number[]|table<string, number> # [rad or m]
---@param options? {velocity?: number} # how fast
function robot_dynamics:set_targets(dofs, options) end

---The velocities that its motors are to keep. DOFs that a table by names leaves out go on as they did.
---@param velocities number[]|table<string, number> # [rad/s or m/s]
function robot_dynamics:set_target_velocities(velocities) end

---Has every finger closed: does its last link touch something, is it at its limit, or has it come to rest after the time in which it was to close?
---@return boolean
function robot_dynamics:has_closed() end

---Closes robot hands on objects and judges the grasps. Lengths are meters, angles radians, masses kilograms, forces newtons; poses and vectors are in the world frame unless a text says otherwise.
---@class clench
---@field version string # Version of the engine, major.minor.patch.
---@field this_job this_job? # The job whose function this is; nil outside of jobs.
local clench = {}

---The type of a value: that of Lua, or the name of its class.
---@param value any # any value
---@return string
function clench.type(value) end

---Degrees to radians.
---@param degrees number # angle
---@return number # [rad]
function clench.rad(degrees) end

---Radians to degrees.
---@param radians number # angle
---@return number # [deg]
function clench.deg(radians) end

---Millimeters to meters.
---@param millimeters number # length
---@return number # [m]
function clench.mm(millimeters) end

---Seconds of a clock that runs evenly from some moment: how long something took.
---@return number # [s]
function clench.clock() end

---A vector of three finite numbers, from a list or one by one. Wherever a vec3 is expected, {x, y, z} will do.
---@param x? number[]|number # first component, or a list of all three; without it all are 0
---@param y? number # second component, when they are given one by one
---@param z? number # third component
---@return vec3
function clench.vec3(x, y, z) end

---A rigid transform: the pose of one frame in another, within 1e9 m of it. The rotation is given one way at most.
---@param options? {xyz?: vec3, rpy?: number[], quat?: number[], matrix?: number[][], axis?: vec3, angle?: number, x_axis?: vec3, y_axis?: vec3, z_axis?: vec3} # xyz [m]; rpy: turns about the fixed x, y, z axes, in this order [rad]; quat: unit, w x y z; matrix: 3 rows of 3 or 4, or 4 rows of 4; axis, angle: a turn about an axis of any length [rad]; x_axis, y_axis, z_axis: where one or two of the frame's axes point; of two, z_axis, else x_axis, exactly, the other as nearly as a right angle allows; one: by the smallest rotation (by half a turn about the next axis if it points backward)
---@return pose
function clench.pose(options) end

---The pose of a camera at `eye` that sees `target`: it looks along its -z, with y up, as `world.camera.pose`.
---@param eye vec3 # position of the camera
---@param target vec3 # point that it looks at
---@param up? vec3 # {0, 0, 1} by default
---@return pose
function clench.look_at(eye, target, up) end

---A stream of random numbers, fixed by a seed and the stream's number, the same on every machine.
---@param seed integer # seed of the numbers: the same seed gives the same numbers
---@param item? integer # which of many streams, default 0
---@return random
function clench.random(seed, item) end

---What a file describes, by its ending, or by its outermost element in XML; where the ending says nothing, by how its numbers stand.
---@param path string # file to inspect
---@param options? {confine?: string}
---@return "body"|"robot"|"world"|"eigengrasps"|"virtual contacts"|"object contacts"|"pre-grasps"|"planned grasps"|"glove calibration"|"glove poses"
function clench.file_kind(path, options) end

---Paths of the models and worlds that come with Clench, sorted.
---@return {hands: string[], arms: string[], objects: string[], obstacles: string[], worlds: string[]}
function clench.catalog() end

---Writes what a file holds as another format, by the ending of `to`: bodies as .xml .iv .obj .off .ply .stl, robots as .urdf, robots and worlds as scenes of MuJoCo, .xml .mjcf, or as .wld .lua, eigengrasps as .egr .xml, virtual contacts as .vgr .xml, lists of grasps as .jsonl .csv .npz .yaml, or as `format` says. Warnings name what the format cannot hold.
---@param from string # file to read
---@param to string # file to write; its ending selects the format
---@param options? {root?: string, confine?: string, strict?: boolean, unit?: "mm"|"cm"|"m"|"inch"|"foot", mesh_scale?: number} # of reading; of robots those of add_robot, too; of worlds `format`, as world:save takes it; of grasps `format`, as list:save takes it, and `dof_order`, names of DOFs that the file does not name
---@return "body"|"robot"|"world"|"eigengrasps"|"virtual contacts"|"grasps"|"planned grasps" # what was read
function clench.convert(from, to, options) end

---The module about itself: each library and class with its functions, fields and methods, each with name, doc and `id`, the first upvalue of its function; and the files of the standard library. Documentation, completion and help are made from it.
---@return {libraries: table[], classes: table[], files: table[]}
function clench.entries() end

---An empty world.
---@param options? {contact_threshold?: number, gravity?: vec3, dynamics?: {time_step?: number, engine?: string, cone?: string, edges?: integer}} # contact_threshold: surfaces closer than this touch, 1e-4 by default [m]; gravity: {0, 0, -9.81} by default [m/s^2]; dynamics: as of world.dynamics
---@return world
function clench.world(options) end

---A world from a file. Names in it are looked up beside the file, then below the root. A .lua file is run, with a table that holds the root and with the folder of the file as its arguments, and returns a world. With `confine`, here and wherever files are read, nothing is read that does not lie below that folder, links followed, and no .lua file is run. A scene of MuJoCo becomes one, too: every tree of joints a robot, free bodies objects, what is fixed obstacles. From the file of a robot or a body comes a world with that one thing in it.
---@param path string # .wld, .xml, .lua or .mjcf; or any file of a robot or a body
---@param options? {root?: string, confine?: string, strict?: boolean, keyframe?: string, folder?: string, package?: string|table, unit?: string, eigengrasps?: string, virtual_contacts?: string, close?: table, approach?: table} # strict: what would be warned of is an error; keyframe: the named state to begin with; the rest as add_robot and add_object have it, for a file of one robot or body
---@return world
function clench.load(path, options) end

---The grasp of a hand on an object as it is now. A grasp without contacts is no error: it resists nothing.
---@param hand robot # hand that holds the object
---@param object body # object that is held
---@param options? {edges?: integer|string, rho?: number|string, soft?: boolean, normal_force?: number|number[], modulus?: string} # edges of the friction pyramids, 8, or "exact" for round cones; rho: torque length [m], by default the object's largest radius about its center of mass, or "gyration" for its radius of gyration; soft: false treats soft contacts as points, without torsional friction; normal_force: at which they are judged, 5 [N], or a list of one per contact; modulus: as of `patch:ellipse`
---@return grasp
function clench.grasp(hand, object, options) end

---The measures that grasp:quality knows, in the order of the guide.
---@return {name: string, what: string, range: string, unit: string, higher_is_better: boolean, source: string}[]
function clench.measures() end

---All wrenches that contacts resist when their normal forces sum to one (norm "L1") or are each at most one ("Linf"). A contact is a list of unit wrenches {fx, fy, fz, tx, ty, tz}, torque over rho, or {point, normal, mu, torsion_radius} in the object frame; torsion_radius, 0 for a hard finger, is that of torsional friction of a soft one [m]. Nothing is calculated before it is asked for.
---@param options {contacts: table[], norm?: string, edges?: integer|string, rho?: number, com?: vec3, coordinates?: string[]} # edges: of the friction pyramids, 8, or "exact" for round cones; rho: length that torques are divided by, 1 m unless given; com: the point of torques, the frame's origin unless given [m]; coordinates: those that count, of "fx" to "tz"
---@return wrench_space
function clench.wrench_space(options) end

---A set of eigengrasps: the principal components of `postures`, the strongest first, with their mean as the origin; or `vectors`, which are made unit. Of each principal component the largest entry is positive, and its eigenvalue is the variance along it. `count` keeps the first ones. Give it to a hand: hand.eigengrasps = set.
---@param options {postures?: number[][], count?: integer, vectors?: number[][], eigenvalues?: number[], origin?: number[], norm?: number[], limits?: number[][]}
---@return eigengrasps
function clench.eigengrasps(options) end

---Draws a world: robots, objects, obstacles, friction cones where robots touch objects, and with `patches` the patches of all soft contacts, without the cones, which would cover them. The camera looks at the objects that robots touch and the links of those robots, or at everything, unless it is given, in whole or in part. The same world gives the same bytes. It needs EGL and OpenGL, but no display. What a picture needs is kept for the next one, which is drawn faster.
---@param world world # world to draw
---@param options? {size?: integer[], quality?: string, background?: string, outline?: number, letters?: number, eye?: vec3, target?: vec3, up?: vec3, field_of_view?: number, orthographic?: boolean|number, camera?: table, frame?: string, contacts?: boolean, cones?: string, cone_height?: number, patches?: boolean, approach?: boolean, ground?: boolean, transparent_objects?: boolean, file_colors?: boolean, samples?: integer, forces?: table[], force_scale?: number, arrows?: boolean} # size: width and height in pixels; quality: "paper", or "draft", a fraction of the time; background: "studio", "white" or "transparent", both with the shadow on the floor; outline: width of lines around bodies [pixels]; letters: height of capital letters [pixels]; field_of_view: vertical [rad]; orthographic: true, or the height that is shown [m]; camera: these five in a table, such as the camera of a picture; frame: what a camera that is not given looks at, "contacts" or "all"; cones: their sizes, "apart" (lowered where they are close together), "equal", or in proportion to "friction" or to the normal "force"; cone_height: of the highest cone [m]; approach: an arrow from the approach point of each robot that closes, along its direction; forces: those of grasp:contact_forces, as arrows with their tips at the contacts, labelled in newtons, through transparent links; its caption tells the largest; force_scale: their length, by default so that the longest has 0.6 of the object's largest radius [m/N]; arrows: false leaves the arrows out, so that forces only size the cones
---@return picture
function clench.render(world, options) end

---The camera that clench.render chooses with the same options; of several states of a world, one for all of them, as for a film: it holds the objects that robots touch in some state, and those robots from the palm outward, where nothing is touched, everything.
---@param worlds world|world[] # a list: states of one world, such as clones of it
---@param options? table # those of clench.render
---@return table camera # {eye: vec3, target: vec3, up: vec3, field_of_view: number, orthographic?: number}, options of clench.render
function clench.camera(worlds, options) end

---Draws numbers as columns, one panel per series, each to its own scale, all over the same items, with its value where there is room; the best of a panel, the largest unless higher_is_better is false, is the darkest. `false` is a value that is missing, and marked. Texts are UTF-8; characters that the font lacks are boxes, and a warning names them. Texts that are too long lose their middle. It needs no graphics hardware.
---@param options {series: {name: string, values: (number|false)[], higher_is_better?: boolean}[], labels?: string[], title?: string, width?: integer, height?: integer} # labels: one per item, their numbers by default; size in pixels: 960 wide, and as high as the panels need
---@return plot # to be saved as PNG or SVG
function clench.chart(options) end

---Draws numbers over numbers: lines, points, and bars between edges, as clench.stats.histogram gives them; with `categories`, numbers over names, as bars beside one another. `false` and what is not finite are left out, and a line has a gap there. Colors can be told apart by color-blind people. It needs no graphics hardware.
---@param options {series: {name?: string, kind?: string, x?: (number|false)[], y?: (number|false)[], edges?: number[], counts?: number[]}[], categories?: string[], title?: string, x_label?: string, y_label?: string, x_range?: number[], y_range?: number[], x_scale?: string, y_scale?: string, width?: integer, height?: integer} # kind: "line", "points" or "bars", by default a line, of categories bars; categories: of each, every series has one y and no x; x: 1, 2, 3 ... by default, of bars their edges, one more than y; edges and counts: bars; names stand in a legend; labels with their units; ranges: {low, high}, what lies outside is cut off; scales: "linear" (default) or "log", which leaves out what is not > 0; 720 x 480 pixels by default
---@return plot
function clench.plot(options) end

---Several pictures in one, in rows, each with its caption under it, and notes under all.
---@param options {pictures: (picture|plot)[], captions?: string[], notes?: string[], columns?: integer, gap?: integer} # captions: of one or more lines; notes: lines of text, broken where they are too wide; columns: so many that the sheet is about square, by default; gap between pictures: 12 by default [pixels]
---@return picture
function clench.sheet(options) end

---Shows how far a loop is: a bar on a terminal, with the time that is left; nothing in a pipe or a file. Over a number or a list it is the loop itself, `for i, item in clench.progress(list)`; elsewhere call `step`. It disappears at the loop's end, or by `close`.
---@param total? integer|any[] # how many steps, or what to go through; without, only the text is shown
---@param text? string # what is in progress, shown before the bar
---@return progress
function clench.progress(total, text) end

---A list of grasps: an empty one, or one from a file, in any format that `save` writes; the ending or `format` says which, and of `.json` and `.txt` files their content does. Its grasps belong to no world: they have what the file holds of contacts, posture and measures, and `apply` puts them into a world.
---@param path? string # file of grasps to read; without it the list is empty
---@param options? {root?: string, confine?: string, format?: string, dof_order?: string|string[], hand?: robot, strict?: boolean} # format: "jsonl", "csv", "npz", "isaac_grasp", "graspgen", "multigripper" or "graspit" (results of its planner); dof_order: names of DOFs that the file does not name, as a list, or as "isaac", breadth first, or "hand", in the order of the DOFs of `hand`
---@return grasps list, string? format # of the file
function clench.grasps(path, options) end

---A chain of simulated annealing, to be run by hand: what `clench.plan` is made of. It moves the world's hand.
---@param options {hand: robot, object: body, energy: energy|function, world?: world, position?: "axis_angle"|"complete"|"ellipsoid"|"approach"|"fixed", posture?: "eigengrasps"|"dofs"|"fixed", semi_axes?: vec3, limits?: table, jumps?: table, values?: table, targets?: table, fixed?: string[], start?: "default"|"hand", variables?: table, schedule?: string|table, seed?: integer, collisions?: boolean, max_tries?: integer, best?: table} # the hand, the object, and the variables of the search
---@return annealing
function clench.annealing(options) end

---Runs several chains at once, each in a world of its own; what they find does not depend on the number of threads.
---@param searches annealing[] # searches to advance
---@param steps integer[] # one per chain
---@param threads? integer # 1 by default
---@return integer[] taken # fewer than asked where no legal neighbor was found
function clench.run_annealings(searches, steps, threads) end

---Runs a function beside the script: in a thread, in a state of Lua of its own, on copies of what it is given. As many jobs run at once as there are cores, at least two; others are queued. A job whose handle is not kept runs on; the end of the program stops it.
---@param task function|string # which uses nothing of the lines around it; or the name of a module that returns such a function
---@param options? {args?: any[], shared?: any, name?: string} # args: the function's arguments, of the kinds that clench.parallel.map hands over; shared: the same, as `clench.this_job.shared`; name: for messages
---@return job
function clench.job(task, options) end

---Values as JSON text, and back.
---@class clench.json
---@field null userdata # The value that stands for null in a list.
clench.json = {}

---A value as JSON. Keys are sorted and numbers come back to the bit, so equal values give equal text; integers stay integers. Poses and vectors are written too; functions, NaN and tables that contain themselves are refused.
---@param value any # plain data: nil, booleans, numbers, strings, lists and tables with names as keys
---@param options? {indent?: integer} # spaces per level; default: all on one line
---@return string
function clench.json.encode(value, options) end

---The value of a JSON text. A null in a list is `clench.json.null`; in an object it is absent.
---@param text string # JSON text
---@return any
function clench.json.decode(text) end

---Messages of scripts and of the engine, to stderr, so that they never mix with a script's output.
---@class clench.log
clench.log = {}

---Calls a function, and returns what was logged meanwhile as values. Notes, warnings and errors are collected whatever the level is; nothing is printed, and no sink is called.
---@param f function # function to call
---@param ... any # its arguments
---@return {severity: "note"|"warning"|"error", text: string, file?: string, line?: integer, about?: string, count: integer}[] diagnostics # file and line: the place in a file that is read; about: "inferred", "ignored", "repaired" or "suspicious"; equal messages are one, with their count
---@return any ... # what the function returns
function clench.log.collect(f, ...) end

---Logs what only a developer wants to read.
---@param ... any # values of the message, as print takes them
function clench.log.debug(...) end

---Logs what a user may want to know.
---@param ... any # values of the message, as print takes them
function clench.log.info(...) end

---Logs what a user should know: what a file contains and the engine does not use, say.
---@param ... any # values of the message, as print takes them
function clench.log.warning(...) end

---Logs what went wrong, and goes on.
---@param ... any # values of the message, as print takes them
function clench.log.error(...) end

---Says from which level on messages are shown, and sets it if one is given.
---@param name? "debug"|"info"|"warning"|"error"|"quiet" # least severe level that is printed; without it the level stays
---@return string before
function clench.log.level(name) end

---Sends messages to a function(level, text, about) instead of stderr; without one, to stderr again. `about` says of what the reader of a file tells: what is "inferred", "ignored", "repaired" or "suspicious"; nil otherwise.
---@param fn? fun(level: string, text: string, about: string?) # called with each message in place of printing it; without it messages are printed again
function clench.log.sink(fn) end

---The small files around hands and planners, read as tables and written from them.
---@class clench.files
clench.files = {}

---Eigengrasps from .egr or .xml. Give them to a hand: hand.eigengrasps = set.
---@param path string # file to read
---@param options? {root?: string, confine?: string, strict?: boolean}
---@return eigengrasps
function clench.files.eigengrasps(path, options) end

---Virtual contacts from .vgr or .xml. Give them to a hand: hand.virtual_contacts = list. `chain` and `link` count from 1, chain 0 is the base; `frame` is in the link's, +z out of it; `robot` of the list is the hand they were made for.
---@param path string # file to read
---@param options? {root?: string, confine?: string, strict?: boolean}
---@return {chain: integer, link: integer, frame: pose, mu: number, edges: number[][]}[]
function clench.files.virtual_contacts(path, options) end

---Contacts on an object, as GraspIt! stores them. `placed` is false, and the frame at the origin, where the file leaves the points out.
---@param path string # file to read
---@param options? {root?: string, confine?: string, strict?: boolean}
---@return {frame: pose, placed: boolean, normal: vec3, mu: number, edges: number[][]}[]
function clench.files.object_contacts(path, options) end

---Writes contacts on an object; without `edges` those of a point.
---@param path string # file to write
---@param list {frame: pose, normal: vec3, mu?: number, edges?: number[][]}[] # in the object's frame
function clench.files.save_object_contacts(path, list) end

---Boxes, spheres, cylinders and cones in an Inventor or VRML file, in its frame. Of an object's file those in primitives/<its name>.iv beside it are read instead, when that exists. y is the axis of cylinder and cone.
---@param path string # file to read
---@param options? {root?: string, confine?: string, strict?: boolean}
---@return {kind: "box"|"sphere"|"cylinder"|"cone", pose: pose, size?: vec3, radius?: number, height?: number}[] # [m]
function clench.files.primitives(path, options) end

---Pre-grasps of a planner's list, in the object's frame.
---@param path string # file to read
---@param options? {root?: string, confine?: string, strict?: boolean}
---@return {point: vec3, direction: vec3, thumb: vec3, spread: number}[] # [m, rad]
function clench.files.pregrasps(path, options) end

---Writes a text as a file, whole or not at all: what stood there stays when it cannot be written.
---@param path string # file to write
---@param text string # contents of the file
function clench.files.save_text(path, text) end

---Appends a text on a line of its own, whose end is added, with one call of the system: a process that is killed leaves all of it or nothing, and of a full disk no part remains. Creates the file if there is none.
---@param path string # file to append to
---@param text string # text to append
function clench.files.append_text(path, text) end

---Checks that a file could be written there, before long work for instance: its folder exists, both may be written, and it is no folder, pipe or device. Changes no file.
---@param path string # file that is to be written
function clench.files.check_writable(path) end

---The bytes of a file, of at most 1 GB. Folders, pipes, devices and sockets are refused.
---@param path string # file to read
---@param options? {root?: string, confine?: string, strict?: boolean}
---@return string
function clench.files.read_text(path, options) end

---Cells of a text of comma-separated values, line by line, as texts; clench.csv reads files, with the types of what is in them.
---@param name string # for errors
---@param text string # contents of a CSV file
---@param separator? string # "," by default, ";" or a tab
---@return table[] records # lists of cells, each with its `line`, and `quoted`: of which cells stood in quotes
function clench.files.csv_records(name, text, separator) end

---A text as a cell of comma-separated values: in quotes where it would be read otherwise, or as a number, true or false.
---@param text string # text of the cell
---@param separator? string # "," by default, ";" or a tab
---@return string
function clench.files.csv_text(text, separator) end

---Writes pre-grasps as a planner's list.
---@param path string # file to write
---@param list {point: vec3, direction: vec3, thumb: vec3, spread?: number}[] # pregrasps in the frame of the object
function clench.files.save_pregrasps(path, list) end

---How the raw numbers of a data glove become DOF values: DOF = intercept + slopes * raw.
---@param path string # file to read
---@param options? {root?: string, confine?: string, strict?: boolean}
---@return {slopes: number[][], intercepts: number[]} # [rad per count, rad]
function clench.files.glove_calibration(path, options) end

---Postures that a glove was calibrated from: raw `sensors`, the `dof_of_sensor` (0: not used), `joints` [rad], the `distance` of fingertips that were to meet [m], and the hand's `pose`.
---@param path string # file to read
---@param options? {root?: string, confine?: string, strict?: boolean}
---@return {distance?: number, sensors?: integer[], dof_of_sensor?: integer[], joints?: number[], pose: pose}[]
function clench.files.glove_poses(path, options) end

---Writes lists of numbers, or of rows of numbers, as NumPy's arrays: `numpy.load` gives them by their names.
---@param path string # .npz
---@param arrays table<string, number[]|number[][]> # arrays by name, of one or two dimensions
---@param options? {compress?: boolean} # compress: as numpy.savez_compressed; false
function clench.files.save_arrays(path, arrays, options) end

---The arrays of such a file: lists of numbers or texts, or of rows, all indices but the first in one.
---@param path string # .npz
---@param options? {root?: string, confine?: string, strict?: boolean}
---@return table<string, number[]|number[][]|string[]>
function clench.files.arrays(path, options) end

---Writes pictures of one size as an animated GIF of up to 256 colors that plays again and again.
---@param path string # file to write
---@param pictures picture[] # frames in order, all of one size
---@param options? {rate?: number, delays?: number[]} # rate: pictures a second, 10 by default [Hz]; delays: of each picture [0.01 s]
function clench.files.save_gif(path, pictures, options) end

---What searches make small. Each function makes an energy of a hand and an object: called, `e()`, it gives its number for how they stand now. Energies are added and weighted, `a + 0.3 * b`, functions of a script among them. Distances count in millimeters, so that the numbers are those of GraspIt!.
---@class clench.energy
clench.energy = {}

---How far the hand's virtual contacts are from the object, and how they face it: the mean of distance [mm] + normal_weight (1 - cosine of the angle). Needs no closing: the quickest energy.
---@param options {hand: robot, object: body, contacts?: "preset"|"live", normal_weight?: number, facing?: "nearest"|"surface"|"away"} # the hand, the object and how they are rated
---@return energy
function clench.energy.contact(options) end

---What the virtual contacts could hold if they touched, nearer ones more: minus epsilon of their forces (with `torques`, of their wrenches). 1 where fewer than min_count are near and face the object, or they hold not in all directions.
---@param options {hand: robot, object: body, contacts?: "preset"|"live", reach?: number, min_count?: integer, torques?: boolean} # the hand, the object and how they are rated
---@return energy
function clench.energy.potential_quality(options) end

---potential_quality where that is at most 0, else contact, which leads there.
---@param options {hand: robot, object: body, contacts?: "preset"|"live", normal_weight?: number, facing?: "nearest"|"surface"|"away", reach?: number, min_count?: integer, torques?: boolean} # the hand, the object and how they are rated
---@return energy
function clench.energy.guided_potential_quality(options) end

---Closes the hand, and opens it again: minus (volume_weight * volume + epsilon_weight * epsilon) of the grasp; with `tasks`, also minus task_weight times the largest multiple of all these wrenches on the object that it resists.
---@param options {hand: robot, object: body, volume_weight?: number, epsilon_weight?: number, tasks?: number[][], task_weight?: number, edges?: integer|string} # the hand, the object and how they are rated
---@return energy
function clench.energy.autograsp_quality(options) end

---contact, and, where two virtual contacts are near the object and face it, less volume_weight times the volume of the closed grasp. GraspIt! has the sign of the angle wrong here, and its numbers are the default; `facing = "nearest"` is the right one.
---@param options {hand: robot, object: body, contacts?: "preset"|"live", facing?: "nearest"|"surface"|"away", volume_weight?: number, near?: number, min_contacts?: integer} # the hand, the object and how they are rated
---@return energy
function clench.energy.guided_autograsp_quality(options) end

---autograsp_quality after an approach of 30 mm that ends at a touch; where the base touches nothing then, the hand stays where it was. 1e8 where the grasp is worth nothing.
---@param options {hand: robot, object: body, volume_weight?: number, epsilon_weight?: number, tasks?: number[][], task_weight?: number, edges?: integer|string} # the hand, the object and how they are rated
---@return energy
function clench.energy.strict_autograsp(options) end

---For hands with springs: comes to the first touch along the approach direction, closes, and asks for the balance of contacts and joints at full effort: -200 + the unbalanced force [N]; 1 where a finger moves on, fewer than two touch, or epsilon is below min_epsilon.
---@param options {hand: robot, object: body, approach?: number, min_epsilon?: number} # the hand, the object and how they are rated
---@return energy
function clench.energy.compliant(options) end

---What the closed hand holds in simulation: minus the sum over six directions of the part of the time that the object was held in study.shake, down to -6; where the closed hand is not in force closure, or loses the object before, 1 + contact, which leads there. It runs on one thread, and takes some tenths of a second where the hand holds something.
---@param options {hand: robot, object: body, shake?: table, contacts?: "preset"|"live"} # the hand and the object
---@return energy
function clench.energy.dynamic(options) end

---How much the hand's approach direction leans from an axis beyond an angle [rad]: grasps from above, or from one side.
---@param options {hand: robot, axis: vec3, angle?: number} # the hand and the cone
---@return energy
function clench.energy.approach_cone(options) end

---How deep the hand reaches into a box of space, by the boxes around its bodies [mm].
---@param options {hand: robot, low: vec3, high: vec3, pose?: pose} # the hand and the box
---@return energy
function clench.energy.keep_out(options) end

---How much nearer than a distance the hand is to anything but its object and itself [mm].
---@param options {hand: robot, object: body, distance: number} # [m]
---@return energy
function clench.energy.clearance(options) end

---How much farther than a radius the hand's approach point is from a point [mm].
---@param options {hand: robot, point: vec3, radius: number} # [m]
---@return energy
function clench.energy.reach(options) end

---Depth of the hand in what it collides with, by points on its bodies, summed over the pairs of bodies [mm]; 0 only where nothing collides. Where no point lies inside, the depth counts that `world:penetration` gives. A search with this term and `collisions = false` may cross states that collide.
---@param options {hand: robot, points?: integer} # points: on each body, 64
---@return energy
function clench.energy.penetration(options) end

---Work in many threads.
---@class clench.parallel
---@field cores integer # Threads that this machine runs at once.
clench.parallel = {}

---Calls a function for each item of a list, in many threads, each with a state of Lua and worlds of its own. Results come in the order of the items and do not depend on the number of threads: for each item the shared worlds are as they were given, and math.random begins anew. All states together may have as much memory as the one that calls.
---@param task function|string # (item, shared, number), which uses nothing of the lines around it; or the name of a module that returns such a function
---@param items table # a list of plain data, worlds, bodies, robots, snapshots, meshes, poses, vectors, random numbers and grasps; each is handed over as a copy, grasps in no world
---@param options? {threads?: integer, shared?: any, each?: function} # threads: all cores by default; shared: what every state is given once; each(result, number): called here in the order of the items, as soon as they are done
---@return table results # an item that failed gives {error: string, kind?: string}, the kind of an error of Clench, and so does one that was not done when it was stopped
---@return integer failed
function clench.parallel.map(task, items, options) end

---Niceness of the threads that `map` and `clench.job` start from now on: where a window is open, 10 lets it come first.
---@param level? integer # from 0, as the script itself, to 19; without it the level stays
---@return integer level
function clench.parallel.nice(level) end

return clench
