#include "clench/contact/contact_set.h"

#include "clench/contact/facet_touches.h"
#include "clench/contact/round_touches.h"

namespace clench {

std::vector<Touch> contact_set(const Shape& a, const Shape& b, const Pose& X_AB,
                               const TouchOptions& options, RoundIn where) {
  check(options);
  if (!are_round(a, b, where)) return facet_contact_set(a, b, X_AB, options);
  if (where == RoundIn::all && colliding(a, b, X_AB)) return {};
  return round_contact_set(a, b, X_AB, where, options);
}

}  // namespace clench
