#include "bench/pose_sets.h"

#include <cstdlib>
#include <filesystem>

#include "clench/base/error.h"
#include "clench/base/random.h"
#include "clench/io/read/read.h"
#include "clench/model/build.h"
#include "support/meshes.h"

namespace clench::bench {

namespace {

std::filesystem::path shared() {
  const char* given = std::getenv("CLENCH_SHARED");
  return given ? given : "../shared";
}

// the shape of a body of one of the shipped worlds
ShapePtr body_of(const char* world, const char* name) {
  ReadOptions options;
  options.root = ".";
  const World loaded = build_world(read_world(std::string("worlds/") + world, options));
  for (const auto id : loaded.bodies())
    if (loaded.body(id).name == name) return loaded.body(id).shape;
  fail("worlds/{}: no body '{}'", world, name);
}

// a scanned object with coincident vertices merged
ShapePtr scan_of(const char* name) {
  const auto path = shared() / "data" / "ycb" / name;
  return std::filesystem::exists(path) ? Shape::make(weld(test::read_obj(path)), name) : nullptr;
}

void add(std::vector<MeshPair>& pairs, std::string name, ShapePtr a, ShapePtr b) {
  if (a && b) pairs.push_back({std::move(name), std::move(a), std::move(b)});
}

}  // namespace

std::vector<MeshPair> mesh_pairs() {
  std::vector<MeshPair> pairs;
  const ShapePtr palm = body_of("dlr_flask.wld", "dlr_base"),
                 finger = body_of("dlr_flask.wld", "dlr_chain0_link1"),
                 flask = body_of("dlr_flask.wld", "flask"), mug = body_of("barrett_mug.wld", "mug"),
                 tip = body_of("barrett_mug.wld", "barrett_chain0_link1");
  add(pairs, "finger-flask", finger, flask);
  add(pairs, "palm-mug", palm, mug);
  add(pairs, "tip-mug", tip, mug);
  add(pairs, "mug-finger", mug, finger);
  add(pairs, "cup-screwdriver", scan_of("065-c_cups.obj"), scan_of("043_phillips_screwdriver.obj"));
  add(pairs, "apple-finger", scan_of("013_apple.obj"), finger);
  add(pairs, "hammer-banana", scan_of("048_hammer.obj"), scan_of("011_banana.obj"));
  return pairs;
}

std::vector<Pose> poses_of(const MeshPair& pair, const Situation& situation, int count,
                           uint64_t seed) {
  std::vector<Pose> poses;
  const Shape &a = *pair.a, &b = *pair.b;
  for (uint64_t item = 0; static_cast<int>(poses.size()) < count; ++item) {
    Random random(seed, item);
    Pose X{test::random_turn(random), Eigen::Vector3d::Zero()};
    const Eigen::Vector3d way = test::random_direction(random);
    const double gap = random.uniform(situation.low, situation.high);
    X.position = a.center() + (a.radius() + b.radius() + 0.01) * way - X.rotation * b.center();
    const Distance d = distance(a, b, X);
    X.position += (d.distance - gap) * (d.p_a - d.p_b).normalized();
    // moving along one line may miss the surface elsewhere: keep only poses in the intended
    // situation
    if ((gap > 0) != colliding(a, b, X)) poses.push_back(X);
  }
  return poses;
}

}  // namespace clench::bench
