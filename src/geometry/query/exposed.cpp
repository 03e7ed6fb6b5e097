#include "clench/geometry/query/exposed.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <map>

#include "clench/base/disjoint_sets.h"
#include "clench/geometry/query/placement.h"
#include "clench/geometry/query/queries.h"
#include "clench/geometry/tree/tree.h"

namespace clench {

using Eigen::Vector2d, Eigen::Vector3d;

namespace {

using Polygon = std::vector<Vector2d>;  // convex
struct Line {
  Vector2d normal;  // unit
  double offset = 0;
  double at(const Vector2d& p) const { return normal.dot(p) - offset; }
};
struct Segment {
  Vector2d p, q;
};

// A triangle cut into pieces by other triangles, until no triangle passes through a piece.
class CutTriangle {
 public:
  explicit CutTriangle(const Corners& c) : origin_(c[0]) {
    x_ = (c[1] - c[0]).normalized();
    normal_ = (c[1] - c[0]).cross(c[2] - c[0]).normalized();
    y_ = normal_.cross(x_);
    Polygon all;
    for (const Vector3d& p : c) all.push_back(flat(p)), size_ = std::max(size_, all.back().norm());
    pieces_.push_back(std::move(all));
  }

  void cut_by(const Corners& other) {
    constexpr double in_plane = 1e-12;
    double height[3];
    bool coplanar = true;
    for (int k = 0; k < 3; ++k) {
      height[k] = normal_.dot(other[k] - origin_);
      coplanar &= std::abs(height[k]) <= in_plane * size_;
    }
    if (coplanar) {
      for (int k = 0; k < 3; ++k) cut_along({flat(other[k]), flat(other[(k + 1) % 3])});
      return;
    }
    std::vector<Vector2d> ends;
    for (int k = 0; k < 3; ++k) {
      const double h = height[k], next = height[(k + 1) % 3];
      if (h == 0) ends.push_back(flat(other[k]));
      if (h * next < 0)
        ends.push_back(flat(other[k] + h / (h - next) * (other[(k + 1) % 3] - other[k])));
    }
    if (ends.size() == 2) cut_along({ends[0], ends[1]});
  }

  const std::vector<Polygon>& pieces() const { return pieces_; }
  Vector3d at(const Vector2d& p) const { return origin_ + p.x() * x_ + p.y() * y_; }
  const Vector3d& normal() const { return normal_; }

 private:
  Vector2d flat(const Vector3d& p) const { return {x_.dot(p - origin_), y_.dot(p - origin_)}; }

  void cut_along(const Segment& segment) {
    constexpr size_t many = 4096;  // maximum number of pieces; beyond it some stay uncut
    const Vector2d along = segment.q - segment.p;
    if (!(along.norm() > 1e-12 * size_)) return;
    const Vector2d normal = Vector2d(-along.y(), along.x()).normalized();
    const Line line{normal, normal.dot(segment.p)};
    const size_t count = pieces_.size();
    for (size_t i = 0; i < count && pieces_.size() < many; ++i)
      if (passes_through(segment, pieces_[i])) halve(i, line);
  }

  // Is a part of the segment inside the polygon? Its corners run counter-clockwise.
  bool passes_through(const Segment& segment, const Polygon& polygon) const {
    double from = 0, to = 1;
    for (size_t k = 0; k < polygon.size(); ++k) {
      const Vector2d& p = polygon[k];
      const Vector2d edge = polygon[(k + 1) % polygon.size()] - p;
      const Vector2d in = Vector2d(-edge.y(), edge.x()).normalized();
      const double start = in.dot(segment.p - p), end = in.dot(segment.q - p);
      const double touch = 1e-12 * size_;
      if (start <= touch && end <= touch) return false;
      if (start < 0) from = std::max(from, start / (start - end));
      if (end < 0) to = std::min(to, start / (start - end));
    }
    return from < to;
  }

  void halve(size_t i, const Line& line) {
    Polygon sides[2];
    const Polygon& whole = pieces_[i];
    for (size_t k = 0; k < whole.size(); ++k) {
      const Vector2d &p = whole[k], &q = whole[(k + 1) % whole.size()];
      const double here = line.at(p), next = line.at(q);
      if (here >= 0) sides[0].push_back(p);
      if (here <= 0) sides[1].push_back(p);
      if (here * next < 0)
        for (Polygon& side : sides) side.push_back(p + here / (here - next) * (q - p));
    }
    if (sides[0].size() < 3 || sides[1].size() < 3) return;
    pieces_[i] = std::move(sides[0]);
    pieces_.push_back(std::move(sides[1]));
  }

  Vector3d origin_, x_, y_, normal_;
  double size_ = 0;
  std::vector<Polygon> pieces_;
};

class Exposure {
 public:
  Exposure(const Shape& shape, DisjointSets& parts, const Progress& progress)
      : shape_(shape), progress_(progress) {
    for (const Triangle& t : shape.mesh().triangles) part_.push_back(parts.find(t[0]));
    crossing_.resize(part_.size());
  }

  ExposedSurface find() {
    find_crossings();
    Mesh out;
    std::vector<int> from;
    bool all = true;
    for (int i = 0; shape_.has_triangle(i); ++i) {
      if (i % 64 == 0) progress_.check();
      const size_t before = out.triangles.size();
      const bool complete = add_exposed(i, out);
      all &= complete;
      from.resize(from.size() + out.triangles.size() - before, i);
    }
    if (all || out.triangles.empty()) return {};
    return {Shape::make(std::move(out), "exposed surface", progress_), std::move(from)};
  }

 private:
  void find_crossings() {
    const Placement self(shape_, shape_, {});
    for_meeting_pairs(self.trees(), [&](int i, int j) {
      if (part_[i] != part_[j] && triangles_meet(self.corners_a(i), self.corners_a(j)))
        crossing_[i].push_back(j);
      return false;
    });
  }

  bool is_exposed(const Vector3d& p, const Vector3d& normal) const {
    const Vector3d step = 1e-9 * shape_.radius() * normal;
    return contains(shape_, p + step) != contains(shape_, p - step);
  }

  // Adds the exposed part of a triangle.   returns  true if the triangle is exposed completely
  bool add_exposed(int triangle, Mesh& out) const {
    if (without_area(shape_.mesh(), triangle)) return true;
    const Corners c = shape_.mesh().corners(triangle);
    CutTriangle cut(c);
    std::vector<int> others = crossing_[triangle];
    std::sort(others.begin(), others.end());
    for (const int other : others) cut.cut_by(shape_.mesh().corners(other));
    bool all = true;
    for (const Polygon& piece : cut.pieces()) {
      Vector2d middle = Vector2d::Zero();
      for (const Vector2d& p : piece) middle += p / static_cast<double>(piece.size());
      if (!is_exposed(cut.at(middle), cut.normal())) {
        all = false;
        continue;
      }
      const int base = static_cast<int>(out.vertices.size());
      for (const Vector2d& p : piece) out.vertices.push_back(cut.at(p));
      for (int k = 2; k < static_cast<int>(piece.size()); ++k)
        out.triangles.push_back({base, base + k - 1, base + k});
    }
    return all;
  }

  const Shape& shape_;
  const Progress& progress_;
  std::vector<int> part_;                   // of a triangle
  std::vector<std::vector<int>> crossing_;  // triangles of other parts that intersect a triangle
};

// Do the boxes around two parts overlap?
bool parts_may_overlap(const Mesh& mesh, DisjointSets& parts) {
  std::map<int, Bounds> boxes;
  for (const Triangle& t : mesh.triangles)
    for (const int v : t) boxes[parts.find(t[0])].add(mesh.vertices[v]);
  std::vector<Bounds> by_x;
  for (const auto& [part, box] : boxes) by_x.push_back(box);
  std::sort(by_x.begin(), by_x.end(),
            [](const Bounds& p, const Bounds& q) { return p.low.x() < q.low.x(); });
  for (size_t i = 0; i < by_x.size(); ++i)
    for (size_t j = i + 1; j < by_x.size() && by_x[j].low.x() <= by_x[i].high.x(); ++j)
      if ((by_x[i].low.array() <= by_x[j].high.array()).all() &&
          (by_x[i].high.array() >= by_x[j].low.array()).all())
        return true;
  return false;
}

}  // namespace

static ExposedSurface find_exposed_surface(const Shape& shape, const Progress& progress) {
  if (!shape.closed()) return {};
  // by common vertices: adjacent parts have corners at the same positions
  DisjointSets parts(shape.mesh().vertices.size());
  for (const Triangle& t : shape.mesh().triangles) parts.join(t[0], t[1]), parts.join(t[0], t[2]);
  if (!parts_may_overlap(shape.mesh(), parts)) return {};
  return Exposure(shape, parts, progress).find();
}

std::shared_ptr<const ExposedSurface> exposed_surface(const Shape& shape,
                                                      const Progress& progress) {
  return shape.tree(progress).exposed([&]() -> Tree::ExposedPtr {
    return std::make_shared<const ExposedSurface>(find_exposed_surface(shape, progress));
  });
}

}  // namespace clench
