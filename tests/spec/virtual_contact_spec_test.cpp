#include "clench/spec/virtual_contact_spec.h"

#include "clench/base/error.h"

using namespace clench;

static void check_contact_refused(const VirtualContactSpec& contact, const char* sentence) {
  CHECK_THROWS_WITH_AS(check_virtual_contact(contact, "s"), sentence, Error);
}

TEST_CASE("a default virtual contact is valid, and invalid ones are rejected in one sentence") {
  VirtualContactSpec contact;
  CHECK_NOTHROW(check_virtual_contact(contact, "s"));
  contact.X_LC.rotation = Eigen::Quaterniond(1, 1, 0, 0);
  check_contact_refused(contact,
                        "s: expected a unit quaternion, got one of length 1.4142135623730951");
  contact.X_LC = Pose::translation({NAN, 0, 0});
  check_contact_refused(contact,
                        "s: expected a position within 1e+09 m of the origin, got (nan, 0, 0)");
  contact.X_LC = {};
  contact.mu = NAN;
  check_contact_refused(contact, "s: mu: expected a number from 0 to 1e+06, got nan");
  contact.mu = 0;
  contact.edges.setZero(6, 101);
  check_contact_refused(contact, "s: expected at most 100 friction edges, got 101");
  contact.edges.setConstant(6, 1, INFINITY);
  check_contact_refused(contact,
                        "s: friction edge: expected a number from -1e+30 to 1e+30, got inf");
}
