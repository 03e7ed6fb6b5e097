// Collision filters of an MJCF model: bits, <pair>, <exclude>, and the filter of parents.
#pragma once
#include <functional>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "clench/io/mjcf/bodies/mjcf_tree.h"

namespace clench {

/// A <pair>: two geoms that collide regardless of their bits.
struct MjcfPair {
  XmlValues values;
  std::array<std::string, 2> geoms;
};

/// Collision bits of the colliding geoms of a body.
struct MjcfBits {
  struct Kind {
    unsigned type = 0, affinity = 0;
    size_t count = 0;
  };
  std::vector<Kind> kinds;          ///< geoms with the same bits, sorted by bits
  unsigned type = 0, affinity = 0;  ///< bits of any of them
  explicit MjcfBits(const std::vector<MjcfGeom>& geoms);
};

/// Pairs of bodies (indices in a list, smaller first) for which a <pair> lists geoms, with the
/// number of listed pairs of geoms whose bits would exclude their collision.
using MjcfListedBodies = std::map<std::pair<size_t, size_t>, size_t>;

/// A body of a scene, or a part of a robot.
struct MjcfPart {
  MjcfBits bits;
  bool fixed = false;              ///< to the world
  std::pair<int, int> owner = {};  ///< equal for parts of one robot
  std::string name;
};

/// Pairs of parts with different owners that do not collide by their bits.
struct MjcfKeptApart {
  size_t by_bits = 0;  ///< pairs that share no bit, without those in `listed`
  size_t fixed = 0;    ///< pairs that share a bit, both fixed to the world
  /// pairs that share no bit, but collide because a <pair> lists geoms of theirs
  std::vector<std::pair<size_t, size_t>> listed;
};

/// The first names of a list that may be long, and their total number.
class MjcfNamedPairs {
 public:
  void add(const std::string& a, const std::string& b);
  size_t size() const { return count_; }
  auto begin() const { return first_.begin(); }
  auto end() const { return first_.end(); }

 private:
  std::vector<std::string> first_;
  size_t count_ = 0;
};

class MjcfContacts {
 public:
  MjcfContacts(MjcfDocument& document, const FileCache& cache);

  const std::vector<MjcfPair>& pairs() const { return pairs_; }
  /// bodies  the geoms of each
  MjcfListedBodies listed(const std::vector<const std::vector<MjcfGeom>*>& bodies) const;
  /// True if any geoms of the two bodies collide. The geoms of a body form one surface here, so
  /// bodies of which only some pairs of geoms collide are recorded for tell().
  /// listed  number of pairs of their geoms that a <pair> lists although their bits exclude them;
  ///         null: none is listed
  bool collide(const MjcfBits& a, const MjcfBits& b, const size_t* listed,
               const std::string& name_a, const std::string& name_b);
  /// Finds the parts that do not collide. Bodies of which only some pairs of geoms collide are
  /// recorded, as in collide().
  MjcfKeptApart kept_apart(const std::vector<MjcfPart>& parts, const MjcfListedBodies& listed);
  /// Sets tree.model.never_meet, which must contain the excludes, and always_meet. As in MuJoCo, a
  /// link does not collide with its parent body unless the parent is fixed to the world. Shapes of
  /// links must be set.
  /// fixed_base  true if the first link is fixed to the world
  void filter_links(MjcfTree& tree, bool fixed_base);
  /// Warns once of bodies that collide more than the file specifies, of friction of pairs, and of
  /// pairs whose geoms `is_read` does not accept.
  void tell(const std::function<bool(const std::string&)>& is_read);

 private:
  void name_mixed(const std::vector<MjcfPart>& parts, const std::vector<size_t>& a,
                  const std::vector<size_t>& b, const MjcfListedBodies& listed);

  MjcfDocument& document_;
  const FileCache& cache_;
  std::vector<MjcfPair> pairs_;
  std::set<std::array<std::string, 2>> listed_;  // names of each pair in ascending order
  bool filter_parents_ = true;
  MjcfNamedPairs mixed_;
};

}  // namespace clench
