// Collision filters of an MJCF model: bits, <pair>, <exclude>, and the filter of parents.
#pragma once
#include <functional>
#include <set>

#include "clench/io/mjcf/mjcf_tree.h"

namespace clench {

/// A <pair>: two geoms that collide whatever their bits say.
struct MjcfPair {
  XmlValues values;
  std::array<std::string, 2> geoms;
};

class MjcfContacts {
 public:
  MjcfContacts(MjcfDocument& document, const FileCache& cache);

  const std::vector<MjcfPair>& pairs() const { return pairs_; }
  bool listed(const MjcfGeom& a, const MjcfGeom& b) const;  ///< in a <pair>?
  bool collide(const MjcfGeom& a, const MjcfGeom& b) const;
  /// Do any of two bodies' geoms collide? Geoms of one body are one surface here: bodies of which
  /// only some pairs of geoms collide are remembered.
  bool collide(const std::vector<MjcfGeom>& a, const std::vector<MjcfGeom>& b,
               const std::string& name_a, const std::string& name_b);
  /// Is a pair of their geoms listed?
  bool listed(const std::vector<MjcfGeom>& a, const std::vector<MjcfGeom>& b) const;
  /// Sets tree.model.never_meet and always_meet, whose excludes are there already: as MuJoCo, a
  /// link does not collide with what carries it, unless that is fixed to the world. `fixed_base`:
  /// is the first link? Shapes of links are known.
  void filter_links(MjcfTree& tree, bool fixed_base);
  /// Warns, once each, of bodies that collide by more than the file says, of friction of pairs, and
  /// of pairs whose geoms `is_read` does not know.
  void tell(const std::function<bool(const std::string&)>& is_read);

 private:
  MjcfDocument& document_;
  const FileCache& cache_;
  std::vector<MjcfPair> pairs_;
  std::set<std::array<std::string, 2>> listed_;  // each in order
  bool filter_parents_ = true;
  std::vector<std::string> mixed_;
};

}  // namespace clench
