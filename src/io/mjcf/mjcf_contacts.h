// Collision filters of an MJCF model: bits, <pair>, <exclude>, and the filter of parents.
#pragma once
#include <functional>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "clench/io/mjcf/mjcf_tree.h"

namespace clench {

/// A <pair>: two geoms that collide whatever their bits say.
struct MjcfPair {
  XmlValues values;
  std::array<std::string, 2> geoms;
};

/// Collision bits of the geoms of a body, of those that collide.
struct MjcfBits {
  struct Kind {
    unsigned type = 0, affinity = 0;
    size_t count = 0;
  };
  std::vector<Kind> kinds;          ///< geoms with the same bits, sorted by bits
  unsigned type = 0, affinity = 0;  ///< bits of any of them
  explicit MjcfBits(const std::vector<MjcfGeom>& geoms);
};

/// Pairs of bodies, by their numbers in a list, the smaller first, of which a <pair> lists geoms;
/// and how many such pairs of geoms their bits would keep apart.
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
  size_t by_bits = 0;  ///< pairs that share no bit, less those in `listed`
  size_t fixed = 0;    ///< pairs that share a bit, both fixed to the world
  /// pairs that share no bit, but collide because a <pair> lists geoms of theirs
  std::vector<std::pair<size_t, size_t>> listed;
};

/// The first names of a list that may be long, and how many there are.
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
  /// Do any of two bodies' geoms collide? Geoms of one body are one surface here: bodies of which
  /// only some pairs of geoms collide are remembered.
  /// listed  number of pairs of their geoms that a <pair> lists against their bits; null: none is
  ///         listed
  bool collide(const MjcfBits& a, const MjcfBits& b, const size_t* listed,
               const std::string& name_a, const std::string& name_b);
  /// Finds the parts that do not collide. Bodies of which only some pairs of geoms collide are
  /// remembered, as by collide().
  MjcfKeptApart kept_apart(const std::vector<MjcfPart>& parts, const MjcfListedBodies& listed);
  /// Sets tree.model.never_meet and always_meet, whose excludes are there already: as MuJoCo, a
  /// link does not collide with what carries it, unless that is fixed to the world. `fixed_base`:
  /// is the first link? Shapes of links are known.
  void filter_links(MjcfTree& tree, bool fixed_base);
  /// Warns, once each, of bodies that collide by more than the file says, of friction of pairs, and
  /// of pairs whose geoms `is_read` does not know.
  void tell(const std::function<bool(const std::string&)>& is_read);

 private:
  void name_mixed(const std::vector<MjcfPart>& parts, const std::vector<size_t>& a,
                  const std::vector<size_t>& b, const MjcfListedBodies& listed);

  MjcfDocument& document_;
  const FileCache& cache_;
  std::vector<MjcfPair> pairs_;
  std::set<std::array<std::string, 2>> listed_;  // each in order
  bool filter_parents_ = true;
  MjcfNamedPairs mixed_;
};

}  // namespace clench
