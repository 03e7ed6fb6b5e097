// One variable of a search: what it may be, how far it jumps, and where it is drawn to.
#pragma once
#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

namespace clench {

struct Variable {
  std::string name;
  double min = 0, max = 1;  ///< [m, rad, or 1 for amplitudes]
  double value = 0;         ///< where a search begins, and where it stays when it is fixed
  double jump = 1;          ///< the longest change of one step, > 0
  bool circular = false;    ///< max and min are the same place
  bool fixed = false;
  std::optional<double> target = {};  ///< where a guess of it lies, and how far to trust it
  /// in [0, 1): neighbours are drawn around the target the closer the higher it is
  double confidence = 0;
};

using Values = Eigen::VectorXd;  ///< one per variable

/// The value within the range: circular ones come round, others stop at its ends.
double inside(const Variable& variable, double value);

/// throws Error "search variable 'Tx': min 0.2 exceeds max 0.1" when its numbers do not fit
/// together
void check_variable(const Variable& variable);

/// Number of the variable.   throws  Error with the nearest name, and all when they are few
int find_variable(const std::vector<Variable>& variables, const std::string& name);

}  // namespace clench
