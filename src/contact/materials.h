// Materials of bodies, and the friction of each pair of materials.
#pragma once
#include <algorithm>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "clench/base/hash.h"
#include "clench/spec/own_friction.h"

namespace clench {

/// Coulomb coefficients of a pair of materials, >= 0.
struct Friction {
  double statics = 0;  ///< while sticking
  double kinetic = 0;  ///< while sliding
  /// coefficient of restitution, in [0, 1]; absent: the larger of the two bodies'
  std::optional<double> restitution = {};
};

/// Symmetric table of friction coefficients; users add materials and change pairs.
/// Starts with the seven materials of the original: frictionless glass metal plastic wood rubber
/// stone.
class MaterialTable {
 public:
  MaterialTable();

  /// throws Error that suggests a similar name if there is no such material
  int index(std::string_view name) const;
  const std::string& name(int material) const { return names_[material]; }
  const std::vector<std::string>& names() const { return names_; }
  Friction friction(int a, int b) const { return table_[place(a, b)]; }

  /// Adds the unknown names, frictionless against all others until set otherwise.
  /// throws Error if a coefficient is negative or not finite, or kinetic exceeds statics
  void set_friction(std::string_view a, std::string_view b, Friction friction);
  /// Adds a material with its own coefficient of friction, unless its name is known. Paired with
  /// another such material it has the combined friction; paired with any other material that is not
  /// frictionless, the larger of its own coefficient and that of the other material on itself.
  void add(const OwnFriction& own);
  bool knows(std::string_view name) const;

 private:
  int find_or_add(std::string_view name);
  static size_t place(int a, int b) {
    const size_t i = std::max(a, b), j = std::min(a, b);
    return i * (i + 1) / 2 + j;
  }
  std::vector<std::string> names_;
  std::vector<Friction> table_;                  // row by row, each up to the diagonal
  std::vector<std::optional<OwnFriction>> own_;  // one per name
};

}  // namespace clench
