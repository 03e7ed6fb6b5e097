// Grasp quality measures by name, for planners and users.
#pragma once
#include <optional>
#include <span>
#include <string_view>

#include "clench/grasp/measure/contact_polygon.h"
#include "clench/grasp/measure/robustness.h"
#include "clench/grasp/wrench/grasp.h"

namespace clench {

/// A grasp under evaluation: quantities that several measures need are computed once. The world
/// must be in the state in which the grasp was measured.
class MeasuredGrasp {
 public:
  MeasuredGrasp(const MeasuredGrasp&) = delete;
  MeasuredGrasp& operator=(const MeasuredGrasp&) = delete;
  /// Uses the wrench spaces that the grasp stores.
  MeasuredGrasp(const World& world, const Grasp& grasp, const Progress& progress = {});

  /// throws  Error as check_unmoved does
  const World& world() const;
  const Progress& progress() const { return progress_; }
  const Grasp& grasp() const { return grasp_; }
  const WrenchSpace& space(const GraspSpaceOptions& options = {}) {
    return *space_of(grasp_, options);
  }
  const ContactPolygon& polygon();  ///< of the contact points, object frame; at least one contact
  /// of the grasp map, torques over rho, descending; 6, the last ones 0 if it has fewer columns
  const Vector6d& singular_values();
  /// of the map from velocities of the DOFs to the object's twist (v, rho omega), descending [m]
  const Vector6d& hand_singular_values();
  /// with all contacts sticking, the object's weight and at most 10 N per contact
  const Robustness& robustness();
  RobustnessProblem robustness_problem();

 private:
  struct Maps {
    Eigen::MatrixXd G, J;  // torques and rotations scaled by rho
    std::vector<int> starts;
  };
  const Maps& maps();

  const World& world_;
  const Grasp& grasp_;
  const Progress progress_;
  std::optional<ContactPolygon> polygon_;
  std::optional<Maps> maps_;
  std::optional<Vector6d> values_, hand_values_;
  std::optional<Robustness> robustness_;
};

struct Measure {
  std::string_view name;
  std::string_view what;
  std::string_view range;
  std::string_view unit;  ///< "1": dimensionless
  bool higher_is_better;
  std::string_view source;
  /// finite, or infinite if there is nothing to measure
  double (*of)(MeasuredGrasp&);
};

/// All measures, in the order of the pages.
std::span<const Measure> measures();

/// throws Error that suggests a similar name if there is no such measure
const Measure& find_measure(std::string_view name);

}  // namespace clench
