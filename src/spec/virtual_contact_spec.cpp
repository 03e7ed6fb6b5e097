#include "clench/spec/virtual_contact_spec.h"

#include "clench/base/error.h"
#include "clench/spec/valid.h"

namespace clench {

void check_virtual_contact(const VirtualContactSpec& contact, const std::string& subject) {
  check_place(contact.X_LC, subject);
  check(friction_rule.called("mu"), contact.mu, subject);
  if (contact.edges.cols() > max_friction_edges)
    fail("{}: expected at most {} friction edges, got {}", subject, max_friction_edges,
         contact.edges.cols());
  for (const double x : contact.edges.reshaped())
    check(number_rule.called("friction edge"), x, subject);
}

}  // namespace clench
