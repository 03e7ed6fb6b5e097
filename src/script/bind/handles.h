// Handles of worlds, bodies and robots for scripts: a world lives while any handle of it or of its
// parts exists.
#pragma once
#include <memory>
#include <span>
#include <vector>

#include "clench/model/find.h"
#include "clench/script/lua/check.h"
#include "clench/script/lua/object.h"
#include "clench/script/lua/push.h"

namespace clench {

using WorldPtr = std::shared_ptr<World>;

struct WorldHandle {
  WorldPtr world;

  bool operator==(const WorldHandle&) const = default;
};

struct BodyHandle {
  WorldPtr world;
  Id<Body> id;

  const Body& operator*() const { return world->body(id); }
  const Body* operator->() const { return &world->body(id); }
  bool operator==(const BodyHandle&) const = default;
};

struct RobotHandle {
  WorldPtr world;
  Id<Robot> id;

  const Robot& operator*() const { return world->robot(id); }
  const Robot* operator->() const { return &world->robot(id); }
  bool operator==(const RobotHandle&) const = default;
};

/// Pushes a new world without other owners; handles of its parts own nothing.
int push_world(lua_State* L, const WorldPtr& world);
/// Registers bodies read from files with the world whose handle is at the index.
void add_owned_bodies(lua_State* L, int index, std::span<const Id<Body>> bodies);

/// A saved state of a world.
struct SnapshotHandle {
  std::shared_ptr<const Snapshot> moment;
};

extern const Class world_settings_class, world_queries_class;
extern const Class world_class, body_class, robot_class, snapshot_class;
extern const Library world_library;

template <>
inline constexpr const Class* script_class<WorldHandle> = &world_class;
template <>
inline constexpr const Class* script_class<BodyHandle> = &body_class;
template <>
inline constexpr const Class* script_class<RobotHandle> = &robot_class;
template <>
inline constexpr const Class* script_class<SnapshotHandle> = &snapshot_class;

inline size_t owned_bytes(const SnapshotHandle& moment) { return moment.moment->bytes(); }

/// The world whose method is called.
inline World& world_of(lua_State* L) { return *self<WorldHandle>(L).world; }

/// {low, high}
int push(lua_State* L, const Bounds& bounds);

/// A link of the robot, or its base, by its name, with or without the robot's.
/// throws  Error "subject: robot 'dlr' has no link 'thum'; did you mean 'thumb'?"
Id<Body> find_link(const RobotHandle& robot, const std::string& name, const std::string& subject);

/// A list of bodies.
int push_bodies(lua_State* L, const WorldPtr& world, const std::vector<Id<Body>>& ids);
/// A list of {a, b} of bodies.
int push_pairs(lua_State* L, const WorldPtr& world, const std::vector<BodyPair>& pairs);

/// The bodies of an argument: a body, or a robot with base, links and mount.
/// throws Error if it is neither, belongs to another world or was removed
std::vector<Id<Body>> check_bodies(lua_State* L, int i, const char* name, const WorldPtr& world);

/// The body of a body or robot (its base) at argument 1, for fields that both have.
BodyHandle self_body(lua_State* L);

/// The same body, for getters and setters (getter.h).
struct Entity : BodyHandle {
  static Entity from_self(lua_State* L) { return {self_body(L)}; }
};

}  // namespace clench
