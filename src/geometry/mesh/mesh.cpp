#include "clench/geometry/mesh/mesh.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>
#include <unordered_map>

#include "clench/base/error.h"
#include "clench/base/hash.h"
#include "clench/base/watched.h"

namespace clench {

using Eigen::Vector3d;

namespace {

double doubled_area(const std::array<Vector3d, 3>& c) {
  return (c[1] - c[0]).cross(c[2] - c[0]).norm();
}

bool repeats_a_vertex(const Triangle& t) { return t[0] == t[1] || t[1] == t[2] || t[2] == t[0]; }

// Indices grouped by the vertex that each belongs to, sorted within each group, in linear time.
class ByVertex {
 public:
  explicit ByVertex(size_t vertices) : start_(vertices + 1, 0) {}

  void add(int vertex, int one, int other) {
    check_();
    items_.push_back({vertex, static_cast<uint64_t>(one) << 32 | static_cast<uint32_t>(other)});
    ++start_[static_cast<size_t>(vertex) + 1];
  }
  /// calls visit(indices at a vertex), for each vertex
  template <class Visit>
  void visit(Visit visit) {
    std::partial_sum(start_.begin(), start_.end(), start_.begin());
    std::vector<uint64_t> sorted(items_.size());
    std::vector<size_t> next(start_.begin(), start_.end() - 1);
    for (const auto& [vertex, number] : items_) sorted[next[vertex]++] = number;
    for (size_t v = 0; v + 1 < start_.size(); ++v) {
      check_();
      const std::span<uint64_t> here(sorted.data() + start_[v], start_[v + 1] - start_[v]);
      std::sort(here.begin(), here.end());
      visit(here);
    }
  }

 private:
  std::vector<size_t> start_;
  std::vector<std::pair<int, uint64_t>> items_;
  StopCheck check_{1 << 14};
};

void count_edges(const Mesh& mesh, MeshFaults& faults, const Progress& progress) {
  // at its lower vertex each edge as (higher, backwards), so that the entries of an edge are
  // consecutive
  ByVertex edges(mesh.vertices.size());
  for (const Triangle& t : mesh.triangles) {
    if (repeats_a_vertex(t)) continue;  // such a triangle has no side
    for (int i = 0; i < 3; ++i) {
      const int from = t[i], to = t[(i + 1) % 3];
      edges.add(std::min(from, to), std::max(from, to), from > to);
    }
  }
  progress.check();
  edges.visit([&](std::span<const uint64_t> at) {
    for (size_t i = 0; i < at.size();) {
      size_t end = i + 1;
      while (end < at.size() && at[end] >> 32 == at[i] >> 32) ++end;
      if (end - i == 1)
        ++faults.open_edges;
      else if (end - i > 2 || at[i] == at[i + 1])
        ++faults.tangled_edges;
      i = end;
    }
  });
}

int count_duplicates(const Mesh& mesh, const Progress& progress) {
  ByVertex triangles(mesh.vertices.size());
  for (Triangle t : mesh.triangles) {
    std::sort(t.begin(), t.end());
    triangles.add(t[0], t[1], t[2]);
  }
  progress.check();
  int count = 0;
  triangles.visit([&](std::span<const uint64_t> at) {
    for (size_t i = 1; i < at.size(); ++i) count += at[i] == at[i - 1];
  });
  return count;
}

int count_unused(const Mesh& mesh) {
  std::vector<char> used(mesh.vertices.size(), 0);
  for (const Triangle& t : mesh.triangles)
    for (const int v : t) used[v] = 1;
  return static_cast<int>(std::count(used.begin(), used.end(), 0));
}

// Kept vertices by the cell of a grid; only looked up, never iterated.
class VertexGrid {
 public:
  explicit VertexGrid(double tolerance) : tolerance_(tolerance) {}

  /// first kept vertex within the tolerance of p, or -1
  int find(const Vector3d& p, const std::vector<Vector3d>& kept) const {
    const Cell low = cell(p, -tolerance_), high = cell(p, tolerance_);
    int found = -1;
    for (int corner = 0; corner < 8; ++corner) {
      Cell c = low;
      bool repeated = false;
      for (int i = 0; i < 3; ++i) {
        if (!(corner >> i & 1)) continue;
        repeated = repeated || low[i] == high[i];
        c[i] = high[i];
      }
      const auto last = repeated ? last_.end() : last_.find(c);
      if (last == last_.end()) continue;
      for (int v = last->second; v >= 0; v = before_[v])
        if ((kept[v] - p).norm() <= tolerance_ && (found < 0 || v < found)) found = v;
    }
    return found;
  }
  /// The next of the kept vertices.
  void add(const Vector3d& p) {
    const int vertex = static_cast<int>(before_.size());
    int& last = last_.try_emplace(cell(p, 0), -1).first->second;
    before_.push_back(last);
    last = vertex;
  }

 private:
  using Cell = std::array<double, 3>;
  struct CellHash {
    size_t operator()(const Cell& cell) const {
      Hasher hasher;
      for (const double x : cell) hasher.add(x);
      return hasher.value();
    }
  };
  // without tolerance a cell is a position; adding zero maps -0 to 0
  Cell cell(const Vector3d& p, double shift) const {
    if (tolerance_ == 0) return {p.x() + 0.0, p.y() + 0.0, p.z() + 0.0};
    const double width = std::max(4 * tolerance_, 1e-200);
    return {std::floor((p.x() + shift) / width) + 0.0, std::floor((p.y() + shift) / width) + 0.0,
            std::floor((p.z() + shift) / width) + 0.0};
  }

  double tolerance_;
  std::unordered_map<Cell, int, CellHash> last_;  // vertex of a cell
  std::vector<int> before_;                       // previous vertex in the same cell; -1: none
};

void check_indices(const Mesh& mesh, const std::string& subject) {
  const int count = static_cast<int>(mesh.vertices.size());
  for (size_t i = 0; i < mesh.triangles.size(); ++i)
    for (const int v : mesh.triangles[i])
      if (v < 0 || v >= count)
        fail("{}: triangle {}: vertex index must be in 0..{}, got {}", subject, i, count - 1, v);
}

void append(std::string& text, int count, const char* one, const char* many) {
  if (count == 0) return;
  text += fmt::format("{}{} {}", text.empty() ? "" : ", ", count, count == 1 ? one : many);
}

}  // namespace

bool without_area(const Mesh& mesh, int triangle) {
  if (repeats_a_vertex(mesh.triangles[triangle])) return true;
  const auto c = mesh.corners(triangle);
  const double longest = std::max(
      {(c[1] - c[0]).squaredNorm(), (c[2] - c[1]).squaredNorm(), (c[0] - c[2]).squaredNorm()});
  // rounding error of the area of three collinear points
  return doubled_area(c) <= 8 * std::numeric_limits<double>::epsilon() * longest;
}

Bounds Mesh::bounds() const {
  Bounds b;
  for (const Vector3d& p : vertices) b.add(p);
  return b;
}

double Mesh::area() const {
  double sum = 0;
  for (size_t i = 0; i < triangles.size(); ++i) sum += doubled_area(corners(static_cast<int>(i)));
  return 0.5 * sum;
}

std::string MeshFaults::describe() const {
  std::string text;
  append(text, open_edges, "open edge", "open edges");
  append(text, tangled_edges, "tangled edge", "tangled edges");
  append(text, degenerate_triangles, "degenerate triangle", "degenerate triangles");
  append(text, duplicate_triangles, "duplicate triangle", "duplicate triangles");
  append(text, unused_vertices, "unused vertex", "unused vertices");
  return text.empty() ? "no faults" : text;
}

bool is_convex(const Mesh& mesh) {
  constexpr size_t max_tests = 1 << 18;  // vertices to be tested against planes
  if (mesh.vertices.size() * mesh.triangles.size() > max_tests) return false;
  const double rounding = 1e-12 * mesh.bounds().size().norm();
  for (size_t i = 0; i < mesh.triangles.size(); ++i) {
    if (without_area(mesh, static_cast<int>(i))) return false;
    const auto c = mesh.corners(static_cast<int>(i));
    const Vector3d normal = (c[1] - c[0]).cross(c[2] - c[0]).stableNormalized();
    for (const Vector3d& p : mesh.vertices)
      if (normal.dot(p - c[0]) > rounding) return false;
  }
  return true;
}

MeshFaults find_faults(const Mesh& mesh, const Progress& progress) {
  check_indices(mesh, "find_faults");
  MeshFaults faults;
  for (size_t i = 0; i < mesh.triangles.size(); ++i)
    faults.degenerate_triangles += without_area(mesh, static_cast<int>(i));
  progress.check();
  count_edges(mesh, faults, progress);
  progress.check();
  faults.duplicate_triangles = count_duplicates(mesh, progress);
  faults.unused_vertices = count_unused(mesh);
  return faults;
}

Mesh weld(const Mesh& mesh, double tolerance, int* dropped, const Progress& progress) {
  if (!(tolerance >= 0)) fail("weld: tolerance must be >= 0 [m], got {}", tolerance);
  check_indices(mesh, "weld");
  Mesh out;
  VertexGrid grid(tolerance);
  std::vector<int> renamed;
  renamed.reserve(mesh.vertices.size());
  for (const Vector3d& p : mesh.vertices) {
    int v = grid.find(p, out.vertices);
    if (v < 0) {
      v = static_cast<int>(out.vertices.size());
      grid.add(p);
      out.vertices.push_back(p);
    }
    renamed.push_back(v);
    if (renamed.size() % 1024 == 0) progress.check();
  }
  for (const Triangle& t : mesh.triangles) {
    const Triangle r = {renamed[t[0]], renamed[t[1]], renamed[t[2]]};
    if (!repeats_a_vertex(r)) out.triangles.push_back(r);
  }
  if (dropped) *dropped = static_cast<int>(mesh.triangles.size() - out.triangles.size());
  return out;
}

void check_mesh(const Mesh& mesh, const std::string& subject) {
  if (mesh.triangles.empty()) fail("{}: at least one triangle expected, got none", subject);
  for (size_t i = 0; i < mesh.vertices.size(); ++i) {
    const Vector3d& p = mesh.vertices[i];
    if (!p.allFinite() || p.cwiseAbs().maxCoeff() > largest_coordinate)
      fail("{}: vertex {}: coordinates must be finite and within {} [m], got ({}, {}, {})", subject,
           i, largest_coordinate, p.x(), p.y(), p.z());
  }
  check_indices(mesh, subject);
}

}  // namespace clench
