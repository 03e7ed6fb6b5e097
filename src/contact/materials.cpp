#include "clench/contact/materials.h"

#include <algorithm>

#include "clench/base/error.h"
#include "clench/base/suggest.h"
#include "clench/spec/material_names.h"
#include "clench/spec/valid.h"

namespace clench {

// static coefficients, in the order of the names; kinetic ones are 0.1 less
constexpr double static_friction[material_names.size()][material_names.size()] = {
    {0, 0, 0, 0, 0, 0, 0},              // frictionless
    {0, 0.2, 0.2, 0.2, 0.3, 1.0, 0.3},  // glass
    {0, 0.2, 0.2, 0.2, 0.3, 1.0, 0.4},  // metal
    {0, 0.2, 0.2, 0.3, 0.4, 1.0, 0.4},  // plastic
    {0, 0.3, 0.3, 0.4, 0.4, 1.0, 0.6},  // wood
    {0, 1.0, 1.0, 1.0, 1.0, 2.0, 1.5},  // rubber
    {0, 0.3, 0.4, 0.4, 0.6, 1.5, 0.7},  // stone
};

static constexpr size_t max_materials = 500;  // the table covers every pair

MaterialTable::MaterialTable() : names_(material_names.begin(), material_names.end()) {
  for (size_t i = 0; i < names_.size(); ++i)
    for (size_t j = 0; j <= i; ++j) {
      const double mu = static_friction[i][j];
      table_.push_back({mu, std::max(0.0, mu - 0.1)});
    }
  own_.resize(names_.size());
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

bool MaterialTable::knows(std::string_view name) const {
  return std::find(names_.begin(), names_.end(), name) != names_.end();
}

void MaterialTable::add(const OwnFriction& own) {
  const std::string name = material_name(own);
  if (const auto found = std::find(names_.begin(), names_.end(), name); found != names_.end()) {
    // a saved world already has the material, with the friction of its pairs
    own_[found - names_.begin()] = own;
    return;
  }
  check(friction_rule, own.mu, name);
  const int i = find_or_add(name);
  own_[i] = own;
  for (int j = 0; j <= i; ++j) {
    const Friction other = friction(j, j);
    if (own_[j]) {
      const double mu = combined(own, *own_[j]);
      table_[place(i, j)] = {mu, mu};
    } else if (other.statics > 0) {
      const double mu = own.frictionless ? 0 : own.mu;
      table_[place(i, j)] = {std::max(mu, other.statics), std::max(mu, other.kinetic)};
    }
  }
}

int MaterialTable::find_or_add(std::string_view name) {
  const auto found = std::find(names_.begin(), names_.end(), name);
  if (found != names_.end()) return static_cast<int>(found - names_.begin());

  const size_t count = names_.size();
  if (count == max_materials)
    fail(ErrorKind::limit, "material '{}': expected at most {} materials", name, count);
  names_.emplace_back(name);
  table_.resize(table_.size() + count + 1);  // without friction
  own_.resize(names_.size());
  return static_cast<int>(count);
}

}  // namespace clench
