// Numbers in a row, wherever the lines of a text file end.
#pragma once
#include <Eigen/Geometry>
#include <functional>

#include "clench/base/diagnostic.h"
#include "clench/base/text.h"

namespace clench {

class NumberReader {
 public:
  /// Goes on where `lines` is. Words from one that begins with '#' on are a comment.
  explicit NumberReader(LineReader& lines) : lines_(lines) {}

  /// throws Error  "hand.vgr:7: mu: expected a number, got 'x'" ("... got the end of the file")
  double number(std::string_view what);
  int integer(std::string_view what, int low = std::numeric_limits<int>::min(),
              int high = std::numeric_limits<int>::max());
  Eigen::VectorXd numbers(int count, std::string_view what);
  Eigen::Vector3d vector(std::string_view what) { return numbers(3, what); }
  /// Four numbers in the order w x y z.
  /// throws Error when they are all near zero
  Eigen::Quaterniond quaternion(std::string_view what);

  /// Is there another word?
  bool more();
  /// where the last word stood, or the next one when there was none
  const Line& line() const { return line_; }
  /// Warns of the first word that is left, if there is one.
  void finish(const Diagnostics& diagnostics);

 private:
  void to_word(std::string_view what);

  LineReader& lines_;
  Line line_;
  int next_ = 0;
};

/// Warns when a line has more than the first `used` words, but for a comment that begins with '#'.
void warn_of_surplus(const Line& line, int used, const Diagnostics& diagnostics);

/// Numbers as a line holds them: "1 2.5 3".
std::string listed(const Eigen::VectorXd& numbers);

/// The quaternion made unit, kept to the bit when it is but for rounding; empty when near zero.
std::optional<Eigen::Quaterniond> made_unit(const Eigen::Vector4d& wxyz);

}  // namespace clench
