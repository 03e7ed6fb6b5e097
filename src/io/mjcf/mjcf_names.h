// Names that elements of MJCF have and refer to, by the kind of what they name.
#pragma once
#include <map>
#include <set>
#include <string>
#include <string_view>

#include "clench/io/mjcf/mjcf_document.h"

namespace clench {

/// Kind of what an attribute of tendons, actuators, equalities and contacts names, "joint" for
/// "joint1"; empty: it names nothing.
std::string_view referred_kind(std::string_view attribute);

class MjcfNames {
 public:
  /// Adds the names of elements and of all below them.
  void add(const std::vector<MjcfNode>& nodes);
  void add(const MjcfNode& node);
  bool empty() const { return names_.empty(); }
  bool has(std::string_view kind, const std::string& name) const;

  /// How many of the names that an element and those below it refer to are these, and how many
  /// are not.
  struct References {
    int inside = 0, outside = 0;
  };
  References references(const MjcfNode& node) const;
  /// Adds the names that an element and those below it refer to.
  void add_referred(const MjcfNode& node);
  bool overlaps(const MjcfNames& other) const;  ///< is a name in both?

 private:
  std::map<std::string, std::set<std::string>, std::less<>> names_;  // by kind
};

}  // namespace clench
