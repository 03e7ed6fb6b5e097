// Which points of a set an isometry may exchange. Includes no Eigen.
#pragma once
#include <memory>
#include <span>
#include <vector>

namespace clench {

/// Points that tell a set of size about one: the set is their hull, or has parts, each told by points.
struct TellingPoints {
  int dimension = 0, count = 0, stride = 0;
  const double* coordinates = nullptr;  ///< point i has coordinates[k * stride + i], k < dimension
  /// Of which part each point is, point after point; isometries carry parts one to one. Empty: no parts.
  std::span<const int> parts;
};

/// Numbers of points that are alike, to 1e-14, where an isometry of the set exchanges them; none when all
/// differ, or when points are too many to ask.
std::vector<double> point_marks(const TellingPoints& points);

/// Points by classes: isometries of the set leave any sum over a point's products with all points alone, so only
/// those of one class may be exchanged. Points have new numbers here, class after class.
class PointClasses {
 public:
  /// marks  of point_marks
  PointClasses(const TellingPoints& points, std::span<const double> marks);

  struct Range {
    int begin, end;
    int size() const { return end - begin; }
  };
  Range of(int point) const { return classes_[class_of_[point]]; }
  std::vector<Range> rarest_first() const;
  /// the number that a point was given with
  int given(int point) const { return given_[point]; }
  /// Leaves those of a class whose products with some points are as those of a point with others.
  void fitting(Range all, int point, std::span<const int> others, std::span<const int> with,
               std::vector<int>& out);

 private:
  static constexpr int lanes = 16;
  const float* products(int point);
  void multiply(int point, float* out) const;
  float sum_of_products(int point);

  int count_, row_;
  std::vector<float> x_, scratch_;     // most_dimensions rows of row_, one
  std::unique_ptr<float[]> products_;  // rows of row_, where have_ says so
  std::vector<char> have_;
  std::vector<int> given_, class_of_, fits_;
  std::vector<Range> classes_;
};

}  // namespace clench
