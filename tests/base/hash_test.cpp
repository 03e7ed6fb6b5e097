#include "clench/base/hash.h"

#include <set>

using namespace clench;

template <class... T>
static uint64_t hash_of(T... values) {
  Hasher h;
  (h.add(values), ...);
  return h.value();
}

TEST_CASE("equal contents give equal hashes, and order matters") {
  CHECK(hash_of(1.0, 2.0) == hash_of(1.0, 2.0));
  CHECK(hash_of(1.0, 2.0) != hash_of(2.0, 1.0));
  CHECK(hash_of(0.0) != hash_of(-0.0));
  CHECK(hash_of() != hash_of(0.0));
}

TEST_CASE("the boundaries of texts matter") {
  CHECK(hash_of(std::string_view("ab"), std::string_view("c")) !=
        hash_of(std::string_view("a"), std::string_view("bc")));
  CHECK(hash_of(std::string_view("")) != hash_of());
}

TEST_CASE("neighboring words do not collide") {
  std::set<uint64_t> seen;
  for (uint64_t i = 0; i < 10000; ++i) seen.insert(hash_of(i));
  CHECK(seen.size() == 10000);
}
