#include "clench/io/text/repairs.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "clench/base/convert.h"
#include "clench/base/text.h"

namespace clench {

void Repairs::order(double& low, double& high, const Place& subject,
                    std::pair<const char*, const char*> names) {
  if (!(low > high)) return;
  add("order", subject, "{} {} exceeds {} {}; they are exchanged", names.first, low + 0.0,
      names.second, high + 0.0);
  std::swap(low, high);
}

double Repairs::magnitude(double value, const Place& subject) {
  if (value < 0) add("magnitude", subject, "{} is negative; {} is used", value, -value);
  return std::abs(value);
}

double Repairs::not_zero(double value, double absent, const Place& subject) {
  if (value != 0) return value;
  add("zero", subject, "0 is not allowed; {} is used, as for a missing value", absent);
  return absent;
}

double Repairs::within(double value, double low, double high, const Place& subject) {
  const double nearest = std::clamp(value, low, high);
  if (nearest != value)
    add("range", subject, "{} is not in {}..{}; {} is used", value, low, high, nearest);
  return nearest;
}

int Repairs::count(std::string_view word, const Place& subject) {
  constexpr double max_count = 1e6;
  const auto value = parse_number(word);
  if (value && *value >= 0 && *value <= max_count && *value == std::floor(*value))
    return floor_int(*value);
  add("count", subject, "expected a whole number from 0 on, got {}; 0 is used", in_quotes(word));
  return 0;
}

void Repairs::add(const std::string& way, Diagnostic diagnostic) {
  const auto known = std::ranges::find(kinds_, way, &Kind::way);
  if (known != kinds_.end())
    ++known->first.count;
  else
    kinds_.push_back({way, std::move(diagnostic)});
}

void Repairs::tell() {
  for (Kind& kind : std::exchange(kinds_, {})) diagnostics_.report(about_, std::move(kind.first));
}

}  // namespace clench
