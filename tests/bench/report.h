// Medians of what was asked, by question, pair and library, and how many answers disagreed.
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

/// the answer of a question, and how long it took [us]
template <class Ask>
auto timed(std::vector<double>& times, Ask&& ask) {
  const double start = now();
  auto answer = ask();
  times.push_back(now() - start);
  return answer;
}

using Times = std::map<std::string, std::vector<double>>;  ///< by library [us]

/// Libraries take turns on blocks of so many questions: near in time, and each with its own data at
/// hand.
inline constexpr int block = 10;

/// A figure that issue and specification ask for.
struct Aim {
  std::string what;
  double value, must;
  bool at_most = false;
  /// nothing measured gives NaN; of no time at all the ratio is infinite or 0
  bool measured() const;
  bool met() const { return measured() && (at_most ? value <= must : value >= must); }
};

/// one line of the table: a question, in a situation, of a pair of meshes
struct Row {
  std::string query, pair;
  std::map<std::string, double> medians;  ///< by library [us]
};

/// What the command of a bench asks for.
struct BenchOptions {
  bool brief = false;  ///< to see that all works
  bool check = false;  ///< a missed aim is a failure
  std::string csv;     ///< where the table goes; "": nowhere
};
/// empty, after a sentence of usage, when a word is none of them
std::optional<BenchOptions> read_options(int argc, char** argv, const char* program);

class Report {
 public:
  /// of a library that must be right
  void check(bool agrees, const std::string& what);
  /// of one that need not be
  void count(const std::string& library, bool agrees);
  void add(const std::string& query, const std::string& pair, const Times& times);
  void sort();

  /// geometric mean over the pairs of our own figure
  double mean(const std::string& query) const;
  /// geometric mean over the pairs of the time of `other` over that of ours, in own_query if given;
  /// NaN when one of them was not measured
  double ratio(const std::string& query, const std::string& other,
               const std::string& own_query = "") const;
  /// our own figure of one pair; NaN when it was not measured
  double median(const std::string& query, const std::string& pair) const;

  void print(const std::vector<std::string>& libraries) const;
  /// Prints each aim with its figure. True when answers were compared, all agree, and every aim was
  /// measured and is met.
  bool judge(const std::vector<Aim>& aims) const;
  /// false, after a sentence, when it cannot be written
  bool write_csv(const std::string& path) const;

 private:
  std::vector<Row> rows_;
  int checked_ = 0, disagreed_ = 0;
  std::map<std::string, std::pair<int, int>> wrong_;  // wrong answers, and all of them, by library
};

}  // namespace clench::bench
