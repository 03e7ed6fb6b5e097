#include "clench/spec/assumed.h"

#include "support/listening.h"
#include "support/meshes.h"
#include "support/shapes.h"

using namespace clench;

namespace {

BodySpec named(const std::string& name, Mesh mesh) {
  BodySpec body;
  body.name = name;
  body.shape = Shape::make(std::move(mesh));
  return body;
}

struct Told {
  std::vector<std::string> notes, suspected;

  explicit Told(const std::vector<BodySpec>& bodies, const std::vector<BodySpec>& obstacles = {}) {
    std::vector<const BodySpec*> list, standing;
    for (const BodySpec& body : bodies) list.push_back(&body);
    for (const BodySpec& body : obstacles) standing.push_back(&body);
    const Diagnostics listeners =
        test::Listening{.note = [&](const std::string& s) { notes.push_back(s); },
                        .suspect = [&](const std::string& s) { suspected.push_back(s); }};
    tell_assumed(list, Place("w.wld"), listeners, standing);
  }
};

using Sentences = std::vector<std::string>;

}  // namespace

TEST_CASE("assumed values are reported for each body that has them") {
  BodySpec full = named("full", test::box(1, 1, 1)), weightless = full, bare = full, frame;
  full.mass_from = full.material_from = Origin::file;
  weightless.name = "weightless", weightless.material_from = Origin::file;
  bare.name = "bare";
  frame.name = "frame";
  const Told told({full, weightless, bare, frame, bare});
  CHECK(told.notes ==
        Sentences{
            "w.wld: no mass and no material is given; 0.3 kg of wood is assumed: 'bare', 'bare'",
            "w.wld: no mass is given; 0.3 kg is assumed: 'weightless'",
            "w.wld: no inertia is given; that of a uniform solid is assumed: 'full', 'weightless', "
            "'bare', 'bare'"});
  CHECK(told.suspected.empty());
  CHECK(Told({bare}).notes ==
        Sentences{"w.wld: no mass and no material is given; 0.3 kg of wood is assumed",
                  "w.wld: no inertia is given; that of a uniform solid is assumed"});
  full.inertia_told = true;
  CHECK(Told({full}).notes.empty());
}

TEST_CASE("an inertia is assumed to be that of a ball only with a warning") {
  Mesh open = test::box(1, 1, 1);
  open.triangles.pop_back();
  BodySpec sheet = named("sheet", open), closed = named("closed", test::box(1, 1, 1));
  CHECK(inertia_is_of_ball(sheet));
  CHECK_FALSE(inertia_is_of_ball(closed));
  CHECK(Told({closed, sheet}).suspected ==
        Sentences{"w.wld: no inertia is given, and the surface bounds no solid; that of a ball "
                  "around it is assumed: 'sheet'"});
  sheet.inertia_per_mass = Eigen::Matrix3d::Identity();
  CHECK(Told({closed, sheet}).suspected.empty());
}

TEST_CASE("for obstacles, assumed masses and materials are reported, but no inertia") {
  Mesh open = test::box(1, 1, 1);
  open.triangles.pop_back();
  BodySpec full = named("full", test::box(1, 1, 1)), wall = named("wall", open);
  full.mass_from = full.material_from = Origin::file;
  full.inertia_told = true;
  const Told told({full}, {wall, full});
  CHECK(told.notes == Sentences{"w.wld: no mass and no material is given; 0.3 kg of wood is "
                                "assumed: 'wall'"});
  CHECK(told.suspected.empty());
  CHECK(Told({}, {wall}).notes ==
        Sentences{"w.wld: no mass and no material is given; 0.3 kg of wood is assumed"});
}
