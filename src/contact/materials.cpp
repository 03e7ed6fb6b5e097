#include "clench/contact/materials.h"

#include <algorithm>

#include "clench/base/error.h"
#include "clench/base/suggest.h"
#include "clench/spec/material_names.h"
#include "clench/spec/valid.h"

namespace clench {

// coefficients of sticking, in the order of the names; sliding is 0.1 less
constexpr double static_friction[material_names.size()][material_names.size()] = {
    {0, 0, 0, 0, 0, 0, 0},              // frictionless
    {0, 0.2, 0.2, 0.2, 0.3, 1.0, 0.3},  // glass
    {0, 0.2, 0.2, 0.2, 0.3, 1.0, 0.4},  // metal
    {0, 0.2, 0.2, 0.3, 0.4, 1.0, 0.4},  // plastic
    {0, 0.3, 0.3, 0.4, 0.4, 1.0, 0.6},  // wood
    {0, 1.0, 1.0, 1.0, 1.0, 2.0, 1.5},  // rubber
    {0, 0.3, 0.4, 0.4, 0.6, 1.5, 0.7},  // stone
};

static constexpr size_t max_materials = 500;  // the table holds every pair

MaterialTable::MaterialTable() : names_(material_names.begin(), material_names.end()) {
  for (size_t i = 0; i < names_.size(); ++i)
    for (size_t j = 0; j <= i; ++j) {
      const double mu = static_friction[i][j];
      table_.push_back({mu, std::max(0.0, mu - 0.1)});
    }
}

int MaterialTable::index(std::string_view name) const {
  const auto found = std::find(names_.begin(), names_.end(), name);
  if (found == names_.end()) fail("no material '{}'{}", name, instead_of(name, names_));
  return static_cast<int>(found - names_.begin());
}

void MaterialTable::set_friction(std::string_view a, std::string_view b, Friction friction) {
  if (a.empty() || b.empty()) fail("friction of '{}' and '{}': a material needs a name", a, b);
  for (const std::string_view name : {a, b}) check_name(name, "material");
  const std::string subject = fmt::format("friction of {} and {}", a, b);
  check(friction_rule.called("static"), friction.statics, subject);
  check(friction_rule.called("kinetic"), friction.kinetic, subject);
  if (friction.kinetic > friction.statics)
    fail("friction of {} and {}: kinetic {} exceeds static {}", a, b, friction.kinetic,
         friction.statics);

  const int i = find_or_add(a), j = find_or_add(b);
  table_[place(i, j)] = friction;
}

int MaterialTable::find_or_add(std::string_view name) {
  const auto found = std::find(names_.begin(), names_.end(), name);
  if (found != names_.end()) return static_cast<int>(found - names_.begin());

  const size_t count = names_.size();
  if (count == max_materials)
    fail(ErrorKind::limit, "material '{}': expected at most {} materials", name, count);
  names_.emplace_back(name);
  table_.resize(table_.size() + count + 1);  // without friction
  return static_cast<int>(count);
}

}  // namespace clench
