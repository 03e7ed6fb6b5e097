// Names of MJCF elements and references to them, by kind of element.
#pragma once
#include <map>
#include <set>
#include <string>
#include <string_view>

#include "clench/io/mjcf/document/mjcf_document.h"

namespace clench {

/// Kind of element to which an attribute of tendons, actuators, equalities and contacts refers,
/// "joint" for "joint1"; empty: it is not a reference.
std::string_view referred_kind(std::string_view attribute);

class MjcfNames {
 public:
  /// Adds the names of elements and of all below them.
  void add(const std::vector<MjcfNode>& nodes);
  void add(const MjcfNode& node);
  bool empty() const { return names_.empty(); }
  bool has(std::string_view kind, const std::string& name) const;

  /// Number of references of an element and its descendants that are among these names, and of
  /// those that are not.
  struct References {
    int inside = 0, outside = 0;
  };
  References references(const MjcfNode& node) const;
  /// Adds the names to which an element and its descendants refer.
  void add_referred(const MjcfNode& node);
  bool overlaps(const MjcfNames& other) const;  ///< true if a name is in both

 private:
  std::map<std::string, std::set<std::string>, std::less<>> names_;  // by kind
};

}  // namespace clench
