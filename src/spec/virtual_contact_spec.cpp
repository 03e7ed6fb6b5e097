#include "spec/virtual_contact_spec.h"

#include <cmath>

#include "base/error.h"
#include "spec/body_spec.h"

namespace clench {

void check_virtual_contact(const VirtualContactSpec& contact, const std::string& subject) {
  if (!contact.X_LC.is_finite() || contact.X_LC.position.cwiseAbs().maxCoeff() > largest_number)
    fail("{}: wanted a finite pose in its link, got a point at ({}, {}, {})", subject,
         contact.X_LC.position.x(), contact.X_LC.position.y(), contact.X_LC.position.z());
  if (std::abs(contact.X_LC.rotation.norm() - 1) > 1e-6)
    fail("{}: its quaternion must be unit", subject);
  if (!(contact.mu >= 0)) fail("{}: mu must be >= 0, got {}", subject, contact.mu);
  if (contact.mu > largest_number)
    fail("{}: mu must be at most {}, got {}", subject, largest_number, contact.mu);
  if (contact.edges.cols() > most_friction_edges)
    fail("{}: wanted at most {} friction edges, got {}", subject, most_friction_edges,
         contact.edges.cols());
  for (const double x : contact.edges.reshaped())
    if (!(std::abs(x) <= largest_number))
      fail("{}: wanted friction edges of at most {}, got {}", subject, largest_number, x);
}

}  // namespace clench
