// One variable of a search: its range, its jump size, and its target.
#pragma once
#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

namespace clench {

struct Variable {
  std::string name;
  double min = 0, max = 1;  ///< [m, rad, or 1 for amplitudes]
  double value = 0;         ///< initial value, and the value of a fixed variable
  double jump = 1;          ///< largest change in one step, > 0
  bool circular = false;    ///< max and min are equivalent
  bool fixed = false;
  std::optional<double> target = {};  ///< an estimate of its value, and the confidence in it
  /// in [0, 1): higher values concentrate neighbors around the target
  double confidence = 0;
};

using Values = Eigen::VectorXd;  ///< one per variable

/// The value within the range: circular ones wrap around, others are clamped.
double inside(const Variable& variable, double value);

/// throws Error "search variable 'Tx': min 0.2 exceeds max 0.1" if its numbers are inconsistent
void check_variable(const Variable& variable);

/// Index of the variable.
/// throws  Error with the nearest name, and all names if they are few
int find_variable(const std::vector<Variable>& variables, const std::string& name);

}  // namespace clench
