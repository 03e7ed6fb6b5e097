#include "spec/virtual_contact_spec.h"

#include "base/error.h"

using namespace clench;

static void check_contact_refused(const VirtualContactSpec& contact, const char* sentence) {
  CHECK_THROWS_WITH_AS(check_virtual_contact(contact, "s"), sentence, Error);
}

TEST_CASE("a virtual contact is in order as it is made, and refused by a sentence when it is not") {
  VirtualContactSpec contact;
  CHECK_NOTHROW(check_virtual_contact(contact, "s"));
  contact.X_LC.rotation = Eigen::Quaterniond(1, 1, 0, 0);
  check_contact_refused(contact, "s: its quaternion must be unit");
  contact.X_LC = Pose::translation({NAN, 0, 0});
  check_contact_refused(contact, "s: wanted a finite pose in its link, got a point at (nan, 0, 0)");
  contact.X_LC = {};
  contact.mu = NAN;
  check_contact_refused(contact, "s: mu must be >= 0, got nan");
  contact.mu = 0;
  contact.edges.setZero(6, 101);
  check_contact_refused(contact, "s: wanted at most 100 friction edges, got 101");
  contact.edges.setConstant(6, 1, INFINITY);
  check_contact_refused(contact, "s: wanted friction edges of at most 1e+30, got inf");
}
