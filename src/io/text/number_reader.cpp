#include "clench/io/text/number_reader.h"

#include <fmt/ranges.h>

namespace clench {

bool NumberReader::more() {
  while (next_ >= line_.size()) {
    if (!lines_.skip_to_full()) return false;
    line_ = lines_.next().before('#');
    next_ = 0;
  }
  return true;
}

void NumberReader::to_word(std::string_view what) {
  if (!more()) lines_.peek().fail("{}: expected a number, got the end of the file", what);
}

double NumberReader::number(std::string_view what) {
  to_word(what);
  return line_.number(next_++, what);
}

int NumberReader::integer(std::string_view what, int low, int high) {
  to_word(what);
  return line_.integer(next_++, what, low, high);
}

Eigen::VectorXd NumberReader::numbers(int count, std::string_view what) {
  // grows with the contents of the file, not with the count that it claims
  std::vector<double> out;
  for (int i = 0; i < count; ++i) out.push_back(number(what));
  return Eigen::Map<const Eigen::VectorXd>(out.data(), count);
}

Eigen::Quaterniond NumberReader::quaternion(std::string_view what) {
  const Eigen::Vector4d x = numbers(4, what);
  const auto q = made_unit(x);
  if (!q)
    line_.fail("{}: expected a quaternion of length 1, got ({} {} {} {})", what, x[0], x[1], x[2],
               x[3]);
  return *q;
}

void NumberReader::finish(const Diagnostics& diagnostics) {
  if (diagnostics && more())
    diagnostics.warn(line_.place(), "text from {} on is not used", in_quotes(line_.word(next_)));
}

void warn_of_surplus(const Line& line, int used, const Diagnostics& diagnostics) {
  if (!diagnostics) return;
  if (std::string text = line.surplus(used); !text.empty())
    diagnostics.warn({line.place(), std::move(text)});
}

std::string listed(const Eigen::VectorXd& numbers) {
  return fmt::format("{}", fmt::join(numbers, " "));
}

std::optional<Eigen::Quaterniond> made_unit(const Eigen::Vector4d& wxyz) {
  const Eigen::Quaterniond q(wxyz[0], wxyz[1], wxyz[2], wxyz[3]);
  const double norm = q.coeffs().stableNorm();
  if (!(norm > 1e-6) || !std::isfinite(norm)) return {};
  if (std::abs(norm - 1) <= 4 * std::numeric_limits<double>::epsilon()) return q;
  return Eigen::Quaterniond(q.coeffs() / norm);
}

}  // namespace clench
