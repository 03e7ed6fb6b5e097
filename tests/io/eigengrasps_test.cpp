#include "clench/io/graspit/eigengrasps.h"

#include "clench/base/random.h"
#include "clench/base/text.h"
#include "support/shared.h"
#include "temporary.h"

using namespace clench;
using clench::test::TemporaryFolder;
using clench::test::Warnings;
using Eigen::VectorXd;

namespace {

VectorXd vec(std::initializer_list<double> x) {
  return Eigen::Map<const VectorXd>(x.begin(), static_cast<int>(x.size()));
}

EigengraspSet read_set(const std::string& text, const ReadOptions& options = {}) {
  TemporaryFolder folder;
  return read_eigengrasps(folder.write("a.egr", text), options);
}

VectorXd random_vector(Random& random, int size) {
  VectorXd x(size);
  for (double& v : x) v = random.normal();
  return x;
}

EigengraspSet random_eigengrasps(uint64_t seed) {
  Random random(5, seed);
  EigengraspSet set;
  set.dofs = 2 + static_cast<int>(random.bits() % 20);
  const int count = 1 + static_cast<int>(random.bits() % set.dofs);
  for (int i = 0; i < count; ++i) {
    set.grasps.push_back({random_vector(random, set.dofs), random.uniform(), std::nullopt});
    if (random.bits() % 2) set.grasps.back().limits = {-random.uniform(), random.uniform()};
  }
  if (random.bits() % 2) set.origin = random_vector(random, set.dofs);
  if (random.bits() % 2) set.norm = random_vector(random, set.dofs);
  return set;
}

// bit-exactly
void check_equal(const EigengraspSet& a, const EigengraspSet& b, bool with_limits) {
  CHECK(a.dofs == b.dofs);
  REQUIRE(a.grasps.size() == b.grasps.size());
  for (size_t i = 0; i < a.grasps.size(); ++i) {
    CHECK(a.grasps[i].vector == b.grasps[i].vector);
    CHECK(a.grasps[i].eigenvalue == b.grasps[i].eigenvalue);
    if (with_limits) CHECK(a.grasps[i].limits == b.grasps[i].limits);
  }
  CHECK(a.origin == b.origin);
  CHECK(a.norm == b.norm);
}

}  // namespace

TEST_CASE("a text file gives vectors, eigenvalues, origin and norm, in any order") {
  const auto set = read_set(
      "DIMENSIONS 3\n\nNORM\n0\n1 2 3\nEG\n0.51\n1.0\t0 +0.5\nORIGIN\n0.0\n.1 .2 .3\nEG\n.25\n0 1 "
      "0\n");
  CHECK(set.dofs == 3);
  REQUIRE(set.grasps.size() == 2);
  CHECK(set.grasps[0].vector == vec({1, 0, 0.5}));
  CHECK(set.grasps[0].eigenvalue == 0.51);
  CHECK(set.grasps[1].vector == vec({0, 1, 0}));
  CHECK(*set.origin == vec({0.1, 0.2, 0.3}));
  CHECK(*set.norm == vec({1, 2, 3}));
  CHECK_FALSE(set.grasps[0].limits);
}

TEST_CASE("blank lines, comments, CR LF and values over several lines are read") {
  const auto set =
      read_set("# a hand\r\nDIMENSIONS 3\r\n\r\nEG # the first\r\n0.5\r\n1 0\r\n0 # done\r\n");
  REQUIRE(set.grasps.size() == 1);
  CHECK(set.grasps[0].vector == vec({1, 0, 0}));
}

TEST_CASE("what belongs to no block, and words behind numbers, are warnings") {
  Warnings warnings;
  read_set("DIMENSIONS 2\nEG\n0.5\n1 0 7 8\nEG\n0.5\n0 1\n1.57 1.22\n  R MCP\nORGIN\n",
           warnings.options());
  CHECK(warnings.list == std::vector<std::string>{
                             "a.egr:4: 2 surplus words are not used",
                             "a.egr:8: the line '1.57 1.22' and 2 more belong to no block and are "
                             "not used"});
  warnings.list.clear();
  const auto set =
      read_set("DIMENSIONS 1\nEG\n0.5\n1\nORIGIN\n0\n1\nORIGIN\n0\n2\n1.57\n", warnings.options());
  CHECK(*set.origin == vec({1}));
  CHECK(warnings.list ==
        std::vector<std::string>{"a.egr:8: a second origin; the first one counts",
                                 "a.egr:11: the line '1.57' belongs to no block and is not used"});
}

TEST_CASE("XML says the same, with limits, and what it leaves out has the format's defaults") {
  const std::string xml = R"(<?xml version="1.0" ?>
<EigenGrasps dimensions="3">
  <EG><EigenValue value="0.51"/><Limits min="-4.0" max="4"/><DimVals d0="1.0" d2="0.5 "/></EG>
  <EG><DimVals d1="1"/></EG>
  <ORIGIN><EigenValue value="0.0"/><DimVals d1="0.2"/></ORIGIN>
  <NORM><DimVals d2="3"/></NORM>
</EigenGrasps>)";
  const auto set = read_set(xml);
  REQUIRE(set.grasps.size() == 2);
  CHECK(set.grasps[0].vector == vec({1, 0, 0.5}));
  REQUIRE(set.grasps[0].limits);
  CHECK((*set.grasps[0].limits)[0] == -4);
  CHECK(set.grasps[1].eigenvalue == 0.5);
  CHECK(*set.origin == vec({0, 0.2, 0}));
  // a scale of 0 would fix a DOF; an omitted scale is 1
  CHECK(*set.norm == vec({1, 1, 3}));
  CHECK_FALSE(
      read_set("<EigenGrasps dimensions='1'><EG><DimVals d0='1'/></EG></EigenGrasps>").origin);
}

TEST_CASE("of a second origin or norm the first counts, in XML as in text") {
  Warnings warnings;
  const auto block = [](const char* name, int value) {
    return fmt::format("<{}><DimVals d0='{}'/></{}>", name, value, name);
  };
  const auto xml =
      read_set("<EigenGrasps dimensions='1'>" + block("EG", 1) + block("ORIGIN", 2) +
                   block("ORIGIN", 3) + block("NORM", 4) + block("NORM", 5) + "</EigenGrasps>",
               warnings.options());
  CHECK(warnings.list ==
        std::vector<std::string>{
            "a.egr:1: <ORIGIN> stands in <EigenGrasps> again; the first one counts",
            "a.egr:1: <NORM> stands in <EigenGrasps> again; the first one counts"});
  const auto text =
      read_set("DIMENSIONS 1\nEG\n1\n1\nORIGIN\n0\n2\nNORM\n0\n4\nORIGIN\n0\n3\nNORM\n0\n5\n");
  for (const auto* set : {&xml, &text}) {
    CHECK(*set->origin == vec({2}));
    CHECK(*set->norm == vec({4}));
  }
}

TEST_CASE("unknown elements of an XML set are warnings") {
  Warnings warnings;
  read_set("<EigenGrasps dimensions='1'><EG><DimVals d0='1'/><Limit/></EG></EigenGrasps>",
           warnings.options());
  CHECK(warnings.list == std::vector<std::string>{"a.egr:1: unknown element <Limit> in <EG> is not "
                                                  "used; did you mean 'Limits'?"});
}

TEST_CASE("a set written and read again is the same to the bit") {
  TemporaryFolder folder;
  for (uint64_t seed = 0; seed < 40; ++seed) {
    const auto set = random_eigengrasps(seed);
    for (const auto* name : {"a.egr", "a.xml"}) {
      INFO(name << " " << seed);
      write_eigengrasps(set, folder.path() / name);
      check_equal(read_eigengrasps(folder.path() / name), set, std::string(name) == "a.xml");
    }
  }
}

TEST_CASE("writing says what the text format has no place for, and refuses other endings") {
  TemporaryFolder folder;
  EigengraspSet set = identity_eigengrasps(2);
  set.grasps[1].limits = {0, 1};
  std::vector<std::string> warnings;
  const Diagnostics warn([&](const Diagnostic& d) { warnings.push_back(d.sentence()); });
  write_eigengrasps(set, folder.path() / "a.xml", warn);
  CHECK(warnings.empty());
  write_eigengrasps(set, folder.path() / "a.egr", warn);
  CHECK(warnings == std::vector<std::string>{
                        "a.egr: the text format cannot store limits of amplitudes; .xml can"});
  CHECK_THROWS_WITH_AS(write_eigengrasps(set, folder.path() / "a.doc"),
                       "a.doc: expected a file of eigengrasps, .egr or .xml, got '.doc'", Error);
  CHECK_THROWS_WITH_AS(write_eigengrasps({}, folder.path() / "a.egr"),
                       "a.egr: expected at least one eigengrasp, got none", Error);
  CHECK_THROWS_AS(write_eigengrasps(set, folder.path() / "no" / "a.egr"), Error);
}

TEST_CASE("every set of the original loads, text and XML say the same") {
  REQUIRE_SHARED();
  const auto text = test::shared() / "data/graspit/models/robots",
             xml = test::shared() / "data/graspit-xml/models/robots";
  check_equal(read_eigengrasps(text / "Barrett/eigen/barrett_eigen.egr"),
              read_eigengrasps(xml / "Barrett/eigen/barrett_eigen.xml"), true);
  check_equal(read_eigengrasps(text / "HumanHand/eigen/human_eigen_nodip.egr"),
              read_eigengrasps(xml / "HumanHand/eigen/human_eigen_nodip.xml"), true);
  int read_set = 0;
  for (const auto& folder : {text, xml})
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
      if (!entry.is_regular_file() || entry.path().parent_path().filename() != "eigen") continue;
      INFO(entry.path().string());
      CHECK_NOTHROW(read_eigengrasps(entry.path()));
      ++read_set;
    }
  CHECK(read_set == 22);
}
