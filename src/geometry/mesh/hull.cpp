#include "clench/geometry/mesh/hull.h"

#include <libqhull_r/qhull_ra.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <new>
#include <string>
#include <string_view>

#include "clench/base/error.h"
#include "clench/base/watched.h"
#include "clench/math/decompositions.h"

namespace clench {

namespace {

// Points relative to their mean and divided by their spread, so that no digits are lost to a
// distant origin and tolerances mean the same at every size.
struct Normalized {
  Eigen::MatrixXd points;
  Eigen::VectorXd center;
  double scale = 1;
  double noise = 0;  // rounding of the given coordinates, in units of scale

  explicit Normalized(const Eigen::MatrixXd& given) {
    const double largest = given.size() > 0 ? given.cwiseAbs().maxCoeff() : 0;
    center = Eigen::VectorXd::Zero(given.rows());
    points = given;
    if (largest == 0) return;
    center = (given / largest).rowwise().mean() * largest;
    points.colwise() -= center;
    const double spread = points.cwiseAbs().maxCoeff();
    if (spread == 0) return;
    scale = spread;
    points /= scale;
    noise = 8 * std::numeric_limits<double>::epsilon() * largest / scale;
  }
};

void check_points(const Eigen::MatrixXd& points, const char* subject) {
  for (int column = 0; column < points.cols(); ++column)
    for (int row = 0; row < points.rows(); ++row)
      if (!(std::abs(points(row, column)) <= 1e50))  // the sixth power is a volume
        fail("{}: point {}: coordinates must be finite and within 1e50, got {}", subject, column,
             points(row, column));
}

int rank_of(const Normalized& n, double tolerance) {
  if (n.points.cols() < 2 || n.points.rows() < 1) return 0;
  const Eigen::VectorXd values = singular_value_decomposition(n.points).values;
  return static_cast<int>((values.array() > std::max(tolerance, n.noise) * values[0]).count());
}

// Owns qhull's state and messages. qhull reports its progress among the messages, which is where a
// stop request is noticed; it then adds no more points, and Stopped is thrown after its C code has
// returned.
class Qhull {
 public:
  Qhull() : said_(fopencookie(this, "w", {nullptr, &Qhull::take_message, nullptr, nullptr})) {
    if (!said_) fail(ErrorKind::limit, "convex_hull: out of memory for qhull's messages");
    std::setvbuf(said_, nullptr, _IONBF, 0);
    qh_zero(&state, said_);
  }
  ~Qhull() {
    qh_freeqhull(&state, !qh_ALL);
    int pieces = 0, bytes = 0;
    qh_memfreeshort(&state, &pieces, &bytes);
    std::fclose(said_);
  }
  Qhull(const Qhull&) = delete;
  Qhull& operator=(const Qhull&) = delete;

  /// returns  false if qhull rejects the points
  /// throws   Stopped
  bool run(Eigen::MatrixXd& points, const char* options) {
    std::string command = options;
    const int error =
        qh_new_qhull(&state, static_cast<int>(points.rows()), static_cast<int>(points.cols()),
                     points.data(), False, command.data(), nullptr, said_);
    if (stopped_) throw Stopped();
    return error == qh_ERRnone;
  }
  /// The first line of its errors, "QH6154 ...".
  std::string error() const {
    const size_t begin = text_.find("QH");
    return begin == std::string::npos ? "" : text_.substr(begin, text_.find('\n', begin) - begin);
  }

  qhT state{};

 private:
  // called by C code: nothing may be thrown out of it
  static ssize_t take_message(void* qhull, const char* text, size_t size) {
    static_cast<Qhull*>(qhull)->take({text, size});
    return static_cast<ssize_t>(size);
  }
  void take(std::string_view text) noexcept {
    constexpr size_t longest = 100000;
    if (stopped_) return;
    try {
      check_stop();
    } catch (const Stopped&) {
      stopped_ = true;
      state.STOPadd = 1;  // as if option TA0 were given: add no vertex beyond the first simplex
    }
    try {
      if (text_.size() < longest) text_ += text;
    } catch (const std::bad_alloc&) {
      text_.clear();
    }
  }

  std::string text_;
  FILE* said_;
  bool stopped_ = false;
};

void read_facets(qhT* qh, const Normalized& n, Hull& hull) {
  facetT* facet;
  vertexT *vertex, **vertexp;
  int count = 0;
  FORALLfacets++ count;
  hull.normals.resize(hull.dimension, count);
  hull.offsets.resize(count);
  int column = 0;
  FORALLfacets {
    const Eigen::Map<const Eigen::VectorXd> normal(facet->normal, hull.dimension);
    hull.normals.col(column) = normal;
    hull.offsets[column] = -facet->offset * n.scale + normal.dot(n.center);
    std::vector<int>& corners = hull.facets.emplace_back();
    FOREACHvertex_(facet->vertices) corners.push_back(qh_pointid(qh, vertex->point));
    ++column;
  }
  hull.volume = qh->totvol * std::pow(n.scale, hull.dimension);
  hull.area = qh->totarea * std::pow(n.scale, hull.dimension - 1);
}

}  // namespace

Hull convex_hull(const Eigen::MatrixXd& points) {
  Hull hull;
  hull.dimension = static_cast<int>(points.rows());
  if (hull.dimension < 2 || hull.dimension > 6)
    fail("convex_hull: dimension must be in 2..6, got {}", hull.dimension);
  check_points(points, "convex_hull");
  Normalized n(points);
  hull.rank = rank_of(n, 1e-10);
  if (!hull.full()) return hull;

  // Qt: simplices; FA: area and volume; Pp: no warning about precision;
  // Qs: the widest first simplex; TF: a report every so many facets
  std::string refusal;
  for (const char* options : {"qhull Qt FA Pp TF500", "qhull Qt FA Pp TF500 Qs"}) {
    Qhull qhull;
    if (qhull.run(n.points, options)) {
      read_facets(&qhull.state, n, hull);
      return hull;
    }
    refusal = qhull.error();
  }
  fail(ErrorKind::internal, "convex_hull: qhull rejects {} points in {} dimensions: {}",
       points.cols(), hull.dimension, refusal);
}

std::vector<Triangle> hull_triangles(const Hull& hull, const Eigen::MatrixXd& points) {
  std::vector<Triangle> out;
  for (size_t f = 0; f < hull.facets.size(); ++f) {
    Triangle t = {hull.facets[f][0], hull.facets[f][1], hull.facets[f][2]};
    const auto edge = [&](int k) -> Eigen::Vector3d { return points.col(t[k]) - points.col(t[0]); };
    if (edge(1).cross(edge(2)).dot(hull.normals.col(static_cast<int>(f))) < 0)
      std::swap(t[1], t[2]);
    out.push_back(t);
  }
  return out;
}

int affine_rank(const Eigen::MatrixXd& points, double tolerance) {
  check_points(points, "affine_rank");
  return rank_of(Normalized(points), tolerance);
}

}  // namespace clench
