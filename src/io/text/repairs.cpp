#include "clench/io/text/repairs.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "clench/base/convert.h"
#include "clench/base/text.h"

namespace clench {

void Repairs::order(double& low, double& high, const std::string& subject,
                    std::pair<const char*, const char*> names) {
  if (!(low > high)) return;
  add("order", fmt::format("{}: {} {} exceeds {} {}; they are exchanged", subject, names.first,
                           low + 0.0, names.second, high + 0.0));
  std::swap(low, high);
}

double Repairs::magnitude(double value, const std::string& subject) {
  if (value < 0)
    add("magnitude", fmt::format("{}: {} is negative; {} is used", subject, value, -value));
  return std::abs(value);
}

double Repairs::not_zero(double value, double absent, const std::string& subject) {
  if (value != 0) return value;
  add("zero", fmt::format("{}: 0 is none; {} is used, as where it is missing", subject, absent));
  return absent;
}

double Repairs::within(double value, double low, double high, const std::string& subject) {
  const double nearest = std::clamp(value, low, high);
  if (nearest != value)
    add("range",
        fmt::format("{}: {} is not in {}..{}; {} is used", subject, value, low, high, nearest));
  return nearest;
}

int Repairs::count(std::string_view word, const std::string& subject) {
  constexpr double max_count = 1e6;
  const auto value = parse_number(word);
  if (value && *value >= 0 && *value <= max_count && *value == std::floor(*value))
    return floor_int(*value);
  add("count", fmt::format("{}: expected a whole number from 0 on, got {}; 0 is used", subject,
                           in_quotes(word)));
  return 0;
}

void Repairs::add(const std::string& way, const std::string& sentence) {
  const auto known = std::ranges::find(kinds_, way, &Kind::way);
  if (known != kinds_.end())
    ++known->more;
  else
    kinds_.push_back({way, sentence});
}

void Repairs::tell() {
  for (const Kind& kind : std::exchange(kinds_, {}))
    clench::tell(
        listeners_.repair, listeners_.warn,
        kind.more ? fmt::format("{} ({} more alike)", kind.sentence, kind.more) : kind.sentence);
}

}  // namespace clench
