#include "clench/io/graspit/virtual_contacts.h"

#include "clench/base/error.h"
#include "clench/base/random.h"
#include "support/meshes.h"
#include "support/shared.h"
#include "temporary.h"

using namespace clench;
using namespace clench::test;
namespace fs = std::filesystem;

namespace {

const std::string edges8 =
    "8\n1 0 0 0 0 0\n0.7 0.7 0 0 0 0\n0 1 0 0 0 0\n-0.7 0.7 0 0 0 0\n-1 0 0 0 0 0\n-0.7 -0.7 0 0 0 "
    "0\n0 -1 0 0 0 0\n0.7 -0.7 0 0 0 0\n";

VirtualContactSet read_contacts(const std::string& text, const ReadOptions& options = {}) {
  TemporaryFolder folder;
  return read_virtual_contacts(folder.write("a.vgr", text), options);
}

FrictionEdges random_edges(Random& random) {
  FrictionEdges edges(6, static_cast<int>(random.bits() % 21));
  for (double& x : edges.reshaped()) x = random.normal();
  edges.bottomRows(3) *= 1e-3;
  return edges;
}

VirtualContactSet random_contacts(uint64_t seed) {
  Random random(3, seed);
  VirtualContactSet set{.robot = "a hand & <more>", .places = {}, .contacts = {}};
  for (int i = static_cast<int>(random.bits() % 5); i >= 0; --i) {
    const int chain = static_cast<int>(random.bits() % 4) - 1;
    set.places.push_back({chain, chain < 0 ? 0 : static_cast<int>(random.bits() % 3)});
    set.contacts.push_back({-1, random_pose(random, 0.1), random.uniform(), random_edges(random)});
  }
  return set;
}

// Millimeters cause only a rounding error in the last place.
constexpr double last_place = 4e-16;

void check_near(const VirtualContactSet& a, const VirtualContactSet& b) {
  CHECK(a.robot == b.robot);
  REQUIRE(a.contacts.size() == b.contacts.size());
  for (size_t i = 0; i < a.contacts.size(); ++i) {
    const auto &x = a.contacts[i], &y = b.contacts[i];
    CHECK(a.places[i] == b.places[i]);
    CHECK(x.mu == y.mu);
    CHECK(x.X_LC.rotation.coeffs() == y.X_LC.rotation.coeffs());
    CHECK((x.X_LC.position - y.X_LC.position).norm() <= last_place * x.X_LC.position.norm());
    REQUIRE(x.edges.cols() == y.edges.cols());
    CHECK(x.edges.topRows(3) == y.edges.topRows(3));
    CHECK((x.edges - y.edges).norm() <= last_place * x.edges.norm());
  }
}

}  // namespace

TEST_CASE("a text file gives place, frame, edges and coefficient, in meters") {
  const auto set =
      read_contacts("My Hand\n2\n-1 0\n" + edges8 +
                    "10 20 30\n1 0 0 0\n10 20 30\n0 0 1\n0.5\n2 1\n1\n0 0 0 0 0 1.64\n-5 0 0\n0.5 "
                    "0.5 0.5 0.5\n-5 0 0\n1 0 0\n0.2\n");
  CHECK(set.robot == "My Hand");
  REQUIRE(set.contacts.size() == 2);
  const auto &palm = set.contacts[0], &link = set.contacts[1];
  CHECK(set.places[0] == ChainPlace{});
  CHECK((palm.X_LC.position - Eigen::Vector3d(0.01, 0.02, 0.03)).norm() < 1e-17);
  CHECK(palm.edges.cols() == 8);
  CHECK(palm.mu == 0.5);
  CHECK(set.places[1] == ChainPlace{2, 1});
  // torque per force is a length
  CHECK(link.edges(5, 0) == doctest::Approx(0.00164));
  CHECK((link.X_LC.rotation * Eigen::Vector3d::UnitZ() - Eigen::Vector3d::UnitX()).norm() < 1e-15);
}

TEST_CASE("the link of a contact on the palm means nothing") {
  for (const char* link : {"-1", "-7", "0", "3"}) {
    INFO(link);
    const auto text =
        read_contacts(fmt::format("H\n1\n-1 {} 0\n1 2 3\n1 0 0 0\n1 2 3\n0 0 1\n0.5\n", link));
    const auto xml = read_contacts(fmt::format(
        "<virtual_contacts><virtual_contact><finger_number>-1</finger_number>"
        "<link_number>{}</link_number><num_friction_edges>0</num_friction_edges><friction_edges/>"
        "<location>1 2 3</location><rotation>1 0 0 0</rotation><translation>1 2 3</translation>"
        "<normal>0 0 1</normal><sCof>0.5</sCof></virtual_contact></virtual_contacts>",
        link));
    for (const auto* set : {&text, &xml}) {
      CHECK(set->places == std::vector{ChainPlace{}});
    }
  }
}

TEST_CASE("line ends mean nothing between the numbers of a contact") {
  const auto set =
      read_contacts("H\r\n1\r\n0 0 0 1 2 3 # no edges\r\n1 0 0 0 1 2 3 0 0\r\n1 0.25\r\n");
  REQUIRE(set.contacts.size() == 1);
  CHECK(set.contacts[0].edges.cols() == 0);
  CHECK(set.contacts[0].mu == 0.25);
}

TEST_CASE(
    "what a file says twice and differently, and what follows the last contact, are warnings") {
  Warnings warnings;
  read_contacts("H\n1\n0 0 0\n1 2 3\n1 0 0 0\n1 2 4\n1 0 0\n0.5\nmore\n", warnings.options());
  CHECK(warnings.list ==
        std::vector<std::string>{
            "a.vgr:7: contact 1: location and translation differ; the translation is used",
            "a.vgr:7: contact 1: normal and rotation differ by 1.57 rad; the rotation is used",
            "a.vgr:9: text from 'more' on is not used"});
}

TEST_CASE("contacts written and read again are the same but for the last place of lengths") {
  TemporaryFolder folder;
  for (uint64_t seed = 0; seed < 30; ++seed) {
    const auto set = random_contacts(seed);
    for (const auto* name : {"a.vgr", "a.xml"}) {
      INFO(name << " " << seed);
      write_virtual_contacts(set, folder.path() / name);
      Warnings warnings;
      check_near(set, read_virtual_contacts(folder.path() / name, warnings.options()));
      CHECK(warnings.list.empty());
    }
  }
}

TEST_CASE("writing refuses other endings, and names that would not be read as one are bent") {
  TemporaryFolder folder;
  CHECK_THROWS_WITH_AS(write_virtual_contacts({}, folder.path() / "a.doc"),
                       "a.doc: expected a file of virtual contacts, .vgr or .xml, got '.doc'",
                       Error);
  VirtualContactSet set{.robot = "", .places = {{}}, .contacts = {VirtualContactSpec{}}};
  set.contacts[0].mu = -1;
  CHECK_THROWS_WITH_AS(write_virtual_contacts(set, folder.path() / "a.vgr"),
                       "a.vgr: contact 1: mu: expected a number from 0 to 1e+06, got -1", Error);
  for (const auto& [name, read_back] : {std::pair("", "_"), {"#1", "_#1"}, {"a\nb", "a_b"}}) {
    write_virtual_contacts({.robot = name, .places = {}, .contacts = {}}, folder.path() / "a.vgr");
    CHECK(read_virtual_contacts(folder.path() / "a.vgr").robot == read_back);
  }
}

TEST_CASE("every set of the original loads, text and XML say the same") {
  REQUIRE_SHARED();
  const auto text = shared() / "data/graspit/models/robots",
             xml = shared() / "data/graspit-xml/models/robots";
  int read_contacts = 0, compared = 0;
  for (const auto& folder : {text, xml})
    for (const auto& entry : fs::recursive_directory_iterator(folder)) {
      const fs::path& path = entry.path();
      if (!entry.is_regular_file() || path.parent_path().filename() != "virtual") continue;
      INFO(path.string());
      Warnings warnings;
      const auto set = read_virtual_contacts(path, warnings.options());
      ++read_contacts;
      for (const auto& contact : set.contacts)
        CHECK((contact.edges.cols() == 8 || contact.edges.cols() == 20));
      fs::path other = xml / fs::relative(path, text);
      if (path.extension() == ".vgr" && fs::exists(other.replace_extension(".xml"))) {
        check_near(set, read_virtual_contacts(other));
        ++compared;
      }
    }
  CHECK(read_contacts == 42);
  CHECK(compared == 12);
}

// --- contacts on objects ---

static std::vector<ObjectContact> read_objects(const std::string& text,
                                               const ReadOptions& options = {}) {
  TemporaryFolder folder;
  return read_object_contacts(folder.write("a.con", text), options);
}

TEST_CASE("contacts on an object are read with their points and without") {
  Warnings warnings;
  const auto with = read_objects(
      "2\n" + edges8 + "1 0 0 0\n1 2 3\n0 0 2\n0.5\n" + edges8 + "1 0 0 0\n4 5 6\n0 1 0\n1\n",
      warnings.options());
  CHECK(warnings.list.empty());
  REQUIRE(with.size() == 2);
  CHECK(with[0].placed);
  CHECK((with[1].X_OC.position - Eigen::Vector3d(0.004, 0.005, 0.006)).norm() < 1e-17);
  CHECK(with[0].n_O == Eigen::Vector3d::UnitZ());

  const auto without =
      read_objects("2\n" + edges8 + "1 0 0 0\n0 0 2\n0.5\n" + edges8 + "1 0 0 0\n0 1 0\n1\n",
                   warnings.options());
  CHECK(warnings.list ==
        std::vector<std::string>{
            "a.con: the points of the contacts are left out; they are not placed"});
  REQUIRE(without.size() == 2);
  CHECK_FALSE(without[0].placed);
  CHECK(without[1].mu == 1);
  CHECK(read_objects("0\n").empty());
}

TEST_CASE("of contacts on an object that are neither, the usual layout's error is told") {
  CHECK_THROWS_WITH_AS(
      read_objects("1\n0\n1 0 0 0\n1 2\n"),
      "a.con:4: contact 1: translation: expected a number, got the end of the file", Error);
}

TEST_CASE("contacts on an object written and read again are the same") {
  TemporaryFolder folder;
  Random random(4, 0);
  std::vector<ObjectContact> contacts;
  for (int i = 0; i < 6; ++i)
    contacts.push_back({.X_OC = random_pose(random, 0.1),
                        .placed = true,
                        .n_O = random_direction(random),
                        .mu = random.uniform(),
                        .edges = random_edges(random)});
  write_object_contacts(contacts, folder.path() / "a.con");
  const auto back = read_object_contacts(folder.path() / "a.con");
  REQUIRE(back.size() == contacts.size());
  for (size_t i = 0; i < back.size(); ++i) {
    CHECK((back[i].X_OC.position - contacts[i].X_OC.position).norm() < 1e-16);
    CHECK(back[i].X_OC.rotation.coeffs() == contacts[i].X_OC.rotation.coeffs());
    CHECK((back[i].n_O - contacts[i].n_O).norm() < last_place);  // normalized
    CHECK(back[i].mu == contacts[i].mu);
  }
  contacts[0].placed = false;
  CHECK_THROWS_WITH_AS(write_object_contacts(contacts, folder.path() / "a.con"),
                       "a.con: contact 1: expected a contact with a point", Error);
}
