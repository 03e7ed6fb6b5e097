#include "clench/io/graspit/transform_list.h"

#include "clench/base/units.h"
#include "clench/io/text/number_reader.h"

namespace clench {

bool begins_transform(const Line& line) {
  const std::string_view text = line.text();
  return !text.empty() && std::string_view("tTrR").find(text.front()) != std::string_view::npos;
}

// files store six digits
static constexpr double nearly_unit = 1e-4;

Pose read_full_transform(const Line& line, std::string_view text, const Diagnostics& diagnostics) {
  text = trim(text.substr(0, text.find('#')));
  // find the brackets in order, then the numbers between them
  std::string shape;
  for (const char c : text)
    if (c == '(' || c == ')' || c == '[' || c == ']') shape += c;
  const auto words = split_words(text, "()[],", 8);
  if (shape != "()[]" || words.size() != 7 || text.front() != '(')
    line.fail("transform: expected '(w x y z)[x y z]', got {}", in_quotes(text));
  double x[7];
  for (int i = 0; i < 7; ++i) {
    const auto value = parse_number(words[i]);
    if (!value) line.fail("transform: expected a number, got {}", in_quotes(words[i]));
    x[i] = *value;
  }
  const Eigen::Vector4d wxyz(x[0], x[1], x[2], x[3]);
  const auto q = made_unit(wxyz);
  if (!q)
    line.fail("transform: expected a quaternion of length 1, got ({} {} {} {})", x[0], x[1], x[2],
              x[3]);
  if (std::abs(wxyz.stableNorm() - 1) > nearly_unit)
    diagnostics.repaired(line.place(),
                         "the quaternion ({} {} {} {}) is not of length 1; it is normalized", x[0],
                         x[1], x[2], x[3]);
  return {*q, Eigen::Vector3d(x[4], x[5], x[6]) * units::millimeter};
}

static Eigen::Vector3d axis(const Line& line, int i) {
  const std::string_view word = line.word(i);
  if (word.size() == 1 && (word[0] | 32) >= 'x' && (word[0] | 32) <= 'z')
    return Eigen::Vector3d::Unit((word[0] | 32) - 'x');
  line.fail("rotation: expected an axis x, y or z, got {}", in_quotes(word));
}

static Pose read_matrix(const Line& head, LineReader& lines, const Diagnostics& diagnostics) {
  // nine numbers, independent of line ends
  Eigen::Matrix3d R;
  Line line = head.before('#');
  int next = 1;
  for (int i = 0; i < 9; ++i) {
    while (next >= line.size()) {
      line = lines.next_full("9 numbers of a rotation matrix").before('#');
      next = 0;
    }
    R.col(i / 3)[i % 3] = line.number(next++, "rotation matrix");
  }
  warn_of_surplus(line, next, diagnostics);
  const double error = (R.transpose() * R - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff();
  if (!(error < 1e-2))
    head.fail("rotation matrix: expected unit axes at right angles; they are off by {:.2g}", error);
  if (!(R.determinant() > 0))
    head.fail("rotation matrix: expected right-handed axes, got left-handed ones");
  return Pose::turn(Eigen::Quaterniond(R).normalized());
}

Pose read_transform(const Line& line, LineReader& lines, const Diagnostics& diagnostics) {
  const std::string_view key = line.word(0);
  if (line.text().starts_with('T') && (key == "T" || key.starts_with("T(")))
    return read_full_transform(line, trim(line.text().substr(1)), diagnostics);
  if (key == "R") return read_matrix(line, lines, diagnostics);
  warn_of_surplus(line, key == "t" ? 4 : 3, diagnostics);
  if (key == "t")
    return Pose::translation(Eigen::Vector3d(line.number(1, "translation x"),
                                             line.number(2, "translation y"),
                                             line.number(3, "translation z")) *
                             units::millimeter);
  if (key == "r") return Pose::turn(line.number(1, "rotation") * units::degree, axis(line, 2));
  if (key == "rr") return Pose::turn(line.number(1, "rotation"), axis(line, 2));
  line.fail("transform: expected t, r, rr, T or R, got {}", in_quotes(key));
}

Pose read_transform_list(LineReader& lines, const Diagnostics& diagnostics) {
  std::optional<Pose> total;  // a single transform is kept bit-exactly
  while (lines.skip_to_full() && begins_transform(lines.peek())) {
    const Line line = lines.next();
    const Pose next = read_transform(line, lines, diagnostics);
    total = total ? *total * next : next;
  }
  return total.value_or(Pose{});
}

}  // namespace clench
