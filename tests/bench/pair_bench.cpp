#include "bench/pair_bench.h"

#include <fmt/format.h>

#include <cmath>

#include "bench/peers.h"
#include "clench/geometry/query/penetration.h"
#include "clench/geometry/query/triangle.h"

namespace clench::bench {

namespace {

// brute-force reference: all pairs of triangles whose boxes are close enough
struct Brute {
  double distance = std::numeric_limits<double>::infinity();
  std::vector<std::pair<int, int>> within;
};

Brute brute(const Shape& a, const Shape& b, const Pose& X, double threshold) {
  Brute out;
  std::vector<Corners> moved;
  std::vector<Bounds> boxes;
  const Eigen::Matrix3d R = X.rotation.normalized().toRotationMatrix();
  for (int t = 0; b.has_triangle(t); ++t) {
    moved.push_back(b.mesh().corners(t));
    boxes.emplace_back();
    for (auto& p : moved.back()) p = R * p + X.position, boxes.back().add(p);
  }
  for (int s = 0; a.has_triangle(s); ++s) {
    const Corners corners = a.mesh().corners(s);
    Bounds box;
    for (const auto& p : corners) box.add(p);
    for (size_t t = 0; t < moved.size(); ++t) {
      const Eigen::Vector3d apart =
          (boxes[t].low - box.high).cwiseMax(box.low - boxes[t].high).cwiseMax(0);
      if (apart.norm() > 1e-9 + std::max(out.distance, threshold)) continue;
      const double d = triangle_triangle(corners, moved[t]).distance;
      out.distance = std::min(out.distance, d);
      if (d < threshold) out.within.emplace_back(s, static_cast<int>(t));
    }
  }
  return out;
}

constexpr double contact_threshold = 1e-4;
// all pairs of triangles are measured at every `compared`-th pose
constexpr int compared = 50;

// Depth of the deepest lattice point inside both bodies, with a spacing of `step` or more: a lower
// bound of the depth of the overlap.
double lattice_depth(const Shape& a, const Shape& b, const Pose& X, double step) {
  constexpr double max_points = 1e5;
  const Bounds box_b = b.bounds_at(X);
  const Eigen::Vector3d low = a.bounds().low.cwiseMax(box_b.low),
                        size = a.bounds().high.cwiseMin(box_b.high) - low;
  if (!(size.array() > 0).all()) return 0;
  step = std::max(step, std::cbrt(size.prod() / max_points));
  const Pose X_BA = X.inverse();
  double deepest = 0;
  for (double x = step / 2; x < size.x(); x += step)
    for (double y = step / 2; y < size.y(); y += step)
      for (double z = step / 2; z < size.z(); z += step) {
        const Eigen::Vector3d p = low + Eigen::Vector3d(x, y, z);
        if (contains(a, p) && contains(b, X_BA * p))
          deepest = std::max(deepest, closest_point(a, p).distance);
      }
  return deepest;
}

// steps of a fraction of a millimeter, with a rotation
Pose step_from(const Pose& X, int step) {
  const double t = step;
  Pose next = X;
  next.position += 1e-4 * Eigen::Vector3d(std::sin(t), std::cos(t), std::sin(2 * t));
  next.rotation =
      Eigen::Quaterniond(Eigen::AngleAxisd(1e-3, Eigen::Vector3d::UnitX())) * X.rotation;
  return next;
}

class PairBench {
 public:
  PairBench(const MeshPair& pair, const Situation& situation, int poses, Report& report)
      : a_(*pair.a), b_(*pair.b), name_(pair.name), situation_(situation.name), report_(report) {
    for (const Peer& peer : peers())
      if (peer.pair) others_.emplace_back(peer.name, peer.pair(a_, b_));
    poses_ = poses_of(pair, situation, poses, 1);
  }

  void run() {
    const int count = static_cast<int>(poses_.size());
    for (int begin = 0; begin < count; begin += block) {
      const int end = std::min(begin + block, count);
      collide(begin, end), measure(begin, end), follow(begin, end), touch(begin, end);
      sink(begin, end);
    }
    for (int i = 0; i < count; i += compared) compare_with_brute_force(i);
    report_.add("collide " + situation_, name_, collide_);
    report_.add("distance " + situation_, name_, distance_);
    report_.add("seeded distance " + situation_, name_, seeded_);
    report_.add("pairs within 0.1 mm " + situation_, name_, within_);
    if (!depths_.empty()) report_.add("depth " + situation_, name_, depths_);
  }

 private:
  std::string where(int i, const std::string& library, const char* query) const {
    return fmt::format("{} {} {} pose {}: {}", name_, situation_, query, i, library);
  }
  void collide(int begin, int end) {
    for (int i = begin; i < end; ++i)
      hits_.push_back(timed(collide_["ours"], [&] { return colliding(a_, b_, poses_[i]); }));
    for (auto& [name, other] : others_)
      for (int i = begin; i < end; ++i) {
        std::vector<double> time;
        const auto answer = timed(time, [&] { return other->collide(poses_[i]); });
        if (!answer) break;
        collide_[name].push_back(time[0]);
        // FCL is the only oracle; other libraries are counted
        if (name == "FCL")
          report_.check(*answer == hits_[i], where(i, name, "collide"));
        else
          report_.count(name + " on collide", *answer == static_cast<bool>(hits_[i]));
      }
  }
  void measure(int begin, int end) {
    for (int i = begin; i < end; ++i) {
      distances_.push_back(timed(distance_["ours"], [&] { return distance(a_, b_, poses_[i]); }));
      report_.check((distances_[i].distance == 0) == hits_[i],
                    where(i, "ours", "distance, collide"));
    }
    for (auto& [name, other] : others_)
      for (int i = begin; i < end; ++i) {
        std::vector<double> time;
        const auto answer = timed(time, [&] { return other->distance(poses_[i]); });
        if (!answer) break;
        distance_[name].push_back(time[0]);
        const double size = a_.radius() + b_.radius();
        if (!hits_[i])
          report_.check(std::abs(*answer - distances_[i].distance) <= 1e-9 * size,
                        where(i, name, "distance"));
      }
  }
  // a few small steps from each pose, with a cache: the answers must equal those without a cache
  void follow(int begin, int end) {
    constexpr int steps = 6;
    for (int i = begin; i < end; ++i) {
      PairCache cache;
      Pose X = poses_[i];
      std::vector<Distance> warm;
      std::vector<double> times;
      for (int step = 0; step <= steps; ++step, X = step_from(X, step))
        warm.push_back(timed(times, [&] { return distance(a_, b_, X, infinity, &cache); }));
      seeded_["ours"].insert(seeded_["ours"].end(), times.begin() + 1, times.end());
      X = poses_[i];
      for (int step = 0; step <= steps; ++step, X = step_from(X, step))
        report_.check(warm[step].distance == distance(a_, b_, X).distance,
                      where(i, "ours", "seeded distance"));
    }
  }
  void touch(int begin, int end) {
    for (int i = begin; i < end; ++i) {
      auto near = timed(within_["ours"],
                        [&] { return pairs_within(a_, b_, poses_[i], contact_threshold); });
      if (i % compared == 0) near_[i] = std::move(near);
    }
  }
  // The first pose of a block: Clench computes the depth to 0.1 %, the lattice to a tenth.
  void sink(int begin, int end) {
    if (!a_.closed() || !b_.closed() || begin == end || !hits_[begin]) return;
    const auto found = timed(depths_["ours"], [&] { return penetration(a_, b_, poses_[begin]); });
    if (found.depth == 0) return;
    const double sampled = timed(
        depths_["lattice"], [&] { return lattice_depth(a_, b_, poses_[begin], found.depth / 10); });
    report_.check(sampled <= found.bound + 1e-12, where(begin, "lattice", "depth"));
  }
  void compare_with_brute_force(int i) {
    const Brute slow = brute(a_, b_, poses_[i], contact_threshold);
    const Distance& d = distances_[i];
    const bool held = d.distance == 0 && (d.triangle_a < 0 || d.triangle_b < 0);
    report_.check(slow.distance == d.distance || held, where(i, "brute force", "distance"));
    bool same = slow.within.size() == near_.at(i).size();
    for (size_t k = 0; same && k < near_.at(i).size(); ++k)
      same = slow.within[k] == std::pair(near_.at(i)[k].triangle_a, near_.at(i)[k].triangle_b);
    report_.check(same, where(i, "brute force", "pairs within"));
  }

  static constexpr double infinity = std::numeric_limits<double>::infinity();
  const Shape &a_, &b_;
  const std::string name_, situation_;
  Report& report_;
  std::vector<std::pair<std::string, std::unique_ptr<PairPeer>>> others_;
  std::vector<Pose> poses_;
  std::vector<char> hits_;
  std::vector<Distance> distances_;
  std::map<int, std::vector<TrianglePair>> near_;
  Times collide_, distance_, seeded_, within_, depths_;
};

}  // namespace

void measure_pair(const MeshPair& pair, int poses, Report& report) {
  for (const Situation& situation : situations) PairBench(pair, situation, poses, report).run();
}

}  // namespace clench::bench
