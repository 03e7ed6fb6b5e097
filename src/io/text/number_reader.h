// Reads a sequence of numbers from a text file, independent of line ends.
#pragma once
#include <Eigen/Geometry>
#include <functional>

#include "clench/base/diagnostic.h"
#include "clench/base/text.h"

namespace clench {

class NumberReader {
 public:
  /// Continues at the current position of `lines`. A word that begins with '#' starts a comment.
  explicit NumberReader(LineReader& lines) : lines_(lines) {}

  /// throws Error  "hand.vgr:7: mu: expected a number, got 'x'" ("... got the end of the file")
  double number(std::string_view what);
  int integer(std::string_view what, int low = std::numeric_limits<int>::min(),
              int high = std::numeric_limits<int>::max());
  Eigen::VectorXd numbers(int count, std::string_view what);
  Eigen::Vector3d vector(std::string_view what) { return numbers(3, what); }
  /// Four numbers in the order w x y z.
  /// throws Error if they are all near zero
  Eigen::Quaterniond quaternion(std::string_view what);

  /// True if there is another word.
  bool more();
  /// line of the last word, or of the next one if the last read found none
  const Line& line() const { return line_; }
  /// Warns of the first unused word, if there is one.
  void finish(const Diagnostics& diagnostics);

 private:
  void to_word(std::string_view what);

  LineReader& lines_;
  Line line_;
  int next_ = 0;
};

/// Warns if a line has more than the first `used` words, except for a comment that begins with '#'.
void warn_of_surplus(const Line& line, int used, const Diagnostics& diagnostics);

/// Numbers separated by blanks: "1 2.5 3".
std::string listed(const Eigen::VectorXd& numbers);

/// The normalized quaternion, kept bit-exactly if it is a unit quaternion up to rounding; empty if
/// near zero.
std::optional<Eigen::Quaterniond> made_unit(const Eigen::Vector4d& wxyz);

}  // namespace clench
