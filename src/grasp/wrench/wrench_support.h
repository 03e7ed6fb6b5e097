// The set of wrenches of all contacts together, given by its support function. Includes no Eigen.
#pragma once
#include <span>
#include <vector>

#include "clench/grasp/wrench/support_set.h"

namespace clench {

/// Bound on the normal forces of all contacts: their sum is at most one, or each is at most one.
enum class WrenchNorm { l1, linf };

/// The unit wrenches of a contact: points, or the round set {axis + spread x, |x| <= 1}.
struct ContactPart {
  const double* points = nullptr;  ///< dimension x count, column after column
  int count = 0;
  const double* axis = nullptr;    ///< null: points
  const double* spread = nullptr;  ///< dimension x width, column after column
  int width = 0;                   ///< 0 to 3
};

/// L1: the convex hull of all unit wrenches. L-infinity: the sum over the contacts of the convex
/// hulls of zero and their unit wrenches.   source  Ferrari & Canny (1992), Pollard (1994)
class WrenchSupport final : public SupportSet {
 public:
  /// copies the data that the parts point to
  WrenchSupport(int dimension, WrenchNorm norm, std::span<const ContactPart> parts);

  int dimension() const override { return dimension_; }
  double support(const double* direction, double* point) const override;
  /// support of one contact alone; minus infinity if it has no wrench
  double support_of(int contact, const double* direction) const;
  bool empty() const { return blocks_.empty() && rounds_.empty(); }

 private:
  // points as structure of arrays, padded with the first one
  struct PointBlock {
    int begin, count, padded;
  };
  struct Round {
    double axis[max_dimensions], spread[3][max_dimensions];
    int width;
  };
  struct Place {
    int block, round;  // -1: none
  };
  double farthest(const PointBlock& block, const double* direction, int& column) const;
  double farthest(const Round& round, const double* direction, double* along) const;
  void add_point(const PointBlock& block, int column, double* point) const;
  void add_point(const Round& round, const double* along, double* point) const;

  int dimension_;
  WrenchNorm norm_;
  std::vector<double> coordinates_;  // block after block, coordinate after coordinate
  std::vector<PointBlock> blocks_;
  std::vector<Round> rounds_;
  std::vector<PointBlock> contact_blocks_;  // of each contact, for support_of
  std::vector<Place> contacts_;
};

}  // namespace clench
