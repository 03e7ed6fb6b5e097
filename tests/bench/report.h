// Medians of times by query, pair and library, and the number of disagreeing answers.
#pragma once
#include <chrono>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace clench::bench {

/// [us]
inline double now() {
  return std::chrono::duration<double, std::micro>(
             std::chrono::steady_clock::now().time_since_epoch())
      .count();
}

/// Processor time of this thread [s].
double cpu_seconds();

/// the answer of a query, and its time [us]
template <class Ask>
auto timed(std::vector<double>& times, Ask&& ask) {
  const double start = now();
  auto answer = ask();
  times.push_back(now() - start);
  return answer;
}

using Times = std::map<std::string, std::vector<double>>;  ///< by library [us]

/// Libraries alternate on blocks of this many queries: close in time, and each with its own data in
/// the cache.
inline constexpr int block = 10;

/// A figure required by an issue or the specification.
struct Aim {
  std::string what;
  double value, must;
  bool at_most = false;
  /// NaN without measurements; infinite or 0 for a time of zero
  bool measured() const;
  bool met() const { return measured() && (at_most ? value <= must : value >= must); }
};

/// one row of the table: a query, in a situation, for a pair of meshes
struct Row {
  std::string query, pair;
  std::map<std::string, double> medians;  ///< by library [us]
};

/// Options of the command of a bench.
struct BenchOptions {
  bool brief = false;  ///< only checks that everything works
  bool check = false;  ///< a missed aim is a failure
  std::string csv;     ///< path of the table; "": not written
};
/// empty, after a usage message, if a word is unknown
std::optional<BenchOptions> read_options(int argc, char** argv, const char* program);

class Report {
 public:
  /// for a library whose answers must be correct
  void check(bool agrees, const std::string& what);
  /// for a library whose answers may be wrong
  void count(const std::string& library, bool agrees);
  void add(const std::string& query, const std::string& pair, const Times& times);
  void sort();

  /// geometric mean of Clench's own figure over the pairs
  double mean(const std::string& query) const;
  /// geometric mean over the pairs of the time of `other` divided by Clench's, for own_query if
  /// given; NaN if one of them was not measured
  double ratio(const std::string& query, const std::string& other,
               const std::string& own_query = "") const;
  /// Clench's own figure for one pair; NaN if it was not measured
  double median(const std::string& query, const std::string& pair) const;

  void print(const std::vector<std::string>& libraries) const;
  /// Prints each aim with its figure. True if answers were compared, all agree, and every aim was
  /// measured and is met.
  bool judge(const std::vector<Aim>& aims) const;
  /// false, after a message, if the file cannot be written
  bool write_csv(const std::string& path) const;

 private:
  std::vector<Row> rows_;
  int checked_ = 0, disagreed_ = 0;
  std::map<std::string, std::pair<int, int>> wrong_;  // wrong answers and all answers, by library
};

}  // namespace clench::bench
