// A number that is asked of each contact.
#pragma once
#include <utility>
#include <vector>

namespace clench {

/// None, one for all contacts, or one per contact.
struct PerContact {
  std::vector<double> values = {};

  PerContact() = default;
  PerContact(double all) : values{all} {}
  PerContact(std::vector<double> each) : values(std::move(each)) {}
  explicit operator bool() const { return !values.empty(); }
  double of(int contact) const { return values.size() == 1 ? values[0] : values[contact]; }
  bool fits(size_t contacts) const { return values.size() <= 1 || values.size() == contacts; }
};

}  // namespace clench
