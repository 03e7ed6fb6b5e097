// A Lua value outside any state, to be transferred to another one.
#pragma once
#include <functional>
#include <lua.hpp>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "clench/script/bind/handles.h"

namespace clench {

/// Plain data, objects of the standard library's classes that hold only plain data, and copies of
/// handles: worlds as clones with their bodies and robots, snapshots, meshes, poses, vectors,
/// random numbers, and grasps, which then belong to no world, like those of files.
class Parcel {
 public:
  Parcel() = default;
  /// Copies the value at the index.
  /// throws  Error "clench.parallel.map: items[3].close: a function cannot be copied to another state"
  Parcel(lua_State* L, int index, const std::string& what);

  /// Pushes the value, with the worlds that were cloned for it; nil for an empty parcel.
  void unpack(lua_State* L) const { unpack(L, root_); }
  const std::vector<WorldPtr>& worlds() const { return worlds_; }

 private:
  struct Node;
  using Fields = std::vector<std::pair<Node, Node>>;
  using Object = std::function<void(lua_State*)>;
  struct Node {
    std::variant<std::monostate, bool, lua_Integer, double, std::string, Fields, Object> value;
    std::string class_name = {};  // class of a table that is an object of the standard library
  };
  struct Packing {
    lua_State* L;
    std::map<const World*, WorldPtr> clones;
  };

  Node pack(Packing& packing, int index, const std::string& what, int depth);
  Node pack_table(Packing& packing, int index, const std::string& what, int depth);
  Node pack_object(Packing& packing, int index, const std::string& what);
  WorldPtr clone_of(Packing& packing, const WorldPtr& world);
  static void unpack(lua_State* L, const Node& node);

  Node root_;
  std::vector<WorldPtr> worlds_;
};

}  // namespace clench
