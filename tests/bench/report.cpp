#include "bench/report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>

namespace clench::bench {

double cpu_seconds() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return double(t.tv_sec) + 1e-9 * double(t.tv_nsec);
}

std::optional<BenchOptions> read_options(int argc, char** argv, const char* program) {
  BenchOptions out;
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    if (word == "--check") {
      out.check = true;
    } else if (word == "--brief") {
      out.brief = true;
    } else if (word == "--csv" && i + 1 < argc) {
      out.csv = argv[++i];
    } else {
      fmt::print(stderr, "usage: {} [--brief] [--csv FILE] [--check]\n", program);
      return {};
    }
  }
  return out;
}

static double middle_of(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<long>(values.size()) / 2;
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

void Report::check(bool agrees, const std::string& what) {
  ++checked_;
  if (agrees) return;
  ++disagreed_;
  if (disagreed_ <= 20) fmt::print("DISAGREES: {}\n", what);
}

void Report::count(const std::string& library, bool agrees) {
  auto& [wrong, all] = wrong_[library];
  wrong += !agrees, ++all;
}

void Report::add(const std::string& query, const std::string& pair, const Times& times) {
  Row row{query, pair, {}};
  for (const auto& [library, values] : times)
    if (!values.empty()) row.medians[library] = middle_of(values);
  rows_.push_back(row);
}

void Report::sort() {
  std::stable_sort(rows_.begin(), rows_.end(),
                   [](const Row& x, const Row& y) { return x.query < y.query; });
}

double Report::mean(const std::string& query) const {
  double sum = 0;
  int count = 0;
  for (const Row& row : rows_)
    if (row.query == query) sum += std::log(median(query, row.pair)), ++count;
  return count == 0 ? std::nan("") : std::exp(sum / count);
}

double Report::median(const std::string& query, const std::string& pair) const {
  for (const Row& row : rows_)
    if (row.query == query && row.pair == pair && row.medians.contains("ours"))
      return row.medians.at("ours");
  return std::nan("");
}

double Report::ratio(const std::string& query, const std::string& other,
                     const std::string& own_query) const {
  double sum = 0;
  int count = 0;
  for (const Row& row : rows_) {
    if (row.query != query || !row.medians.contains(other)) continue;
    const double own = median(own_query.empty() ? query : own_query, row.pair);
    sum += std::log(row.medians.at(other) / own);
    ++count;
  }
  return count == 0 ? std::nan("") : std::exp(sum / count);
}

void Report::print(const std::vector<std::string>& libraries) const {
  fmt::print("{:40} {:27}", "median microseconds", "");
  for (const auto& library : libraries) fmt::print(" {:>10}", library);
  fmt::print("\n");
  for (const Row& row : rows_) {
    fmt::print("{:40} {:27}", row.query, row.pair);
    for (const auto& library : libraries)
      if (row.medians.contains(library))
        fmt::print(" {:10.2f}", row.medians.at(library));
      else
        fmt::print(" {:>10}", "");
    fmt::print("\n");
  }
  fmt::print("\n{} answers compared, {} disagree\n", checked_, disagreed_);
  for (const auto& [library, answers] : wrong_)
    fmt::print("{} answers of {}: {} wrong\n", answers.second, library, answers.first);
}

bool Aim::measured() const { return std::isfinite(value) && (value > 0 || must == 0); }

bool Report::judge(const std::vector<Aim>& aims) const {
  if (checked_ == 0) fmt::print("no answer was compared with another library's\n");
  bool good = checked_ > 0 && disagreed_ == 0;
  for (const Aim& aim : aims) {
    if (aim.measured())
      fmt::print("{:48} {:>8}   must be {} {}{}\n", aim.what,
                 std::abs(aim.value) < 0.01 ? fmt::format("{:.2g}", aim.value)
                                            : fmt::format("{:.2f}", aim.value),
                 aim.at_most ? "<=" : ">=", aim.must, aim.met() ? "" : "   MISSED");
    else
      fmt::print("{:48} NOT MEASURED: is the other library here?\n", aim.what);
    good = good && aim.met();
  }
  return good;
}

bool Report::write_csv(const std::string& path) const {
  std::FILE* file = std::fopen(path.c_str(), "w");
  if (!file) {
    fmt::print(stderr, "{}: cannot be written\n", path);
    return false;
  }
  fmt::print(file, "query,pair,library,median\n");
  for (const Row& row : rows_)
    for (const auto& [library, value] : row.medians)
      fmt::print(file, "\"{}\",{},{},{:.4g}\n", row.query, row.pair, library, value);
  if (std::fclose(file) == 0) return true;
  fmt::print(stderr, "{}: cannot be written\n", path);
  return false;
}

}  // namespace clench::bench
