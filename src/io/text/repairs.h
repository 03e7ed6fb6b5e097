// What a file has wrong and a reader puts right. What is wrong in one way at many places is told
// once, at the first.
#pragma once
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "clench/base/diagnostic.h"

namespace clench {

class Repairs {
 public:
  /// `about`  what tell() reports of
  explicit Repairs(Diagnostics diagnostics, About about = About::repaired)
      : diagnostics_(std::move(diagnostics)), about_(about) {}

  /// Limits that are the wrong way round are exchanged: "hand.xml:31: joint 2: minValue 30 exceeds
  /// maxValue -4; they are exchanged".   `names`  of the two
  void order(double& low, double& high, const Place& subject,
             std::pair<const char*, const char*> names = {"min", "max"});
  /// Of what is never negative: "hand.xml:6: DOF 0: maxEffort: -1.5 is negative; 1.5 is used".
  double magnitude(double value, const Place& subject);
  /// Of what is never 0: "distal.xml:5: mass: 0 is none; 300 is used, as where it is missing".
  double not_zero(double value, double absent, const Place& subject);
  /// The nearest of low..high: "hand.xml:9: color: rgba: 1.5 is not in 0..1; 1 is used".
  double within(double value, double low, double high, const Place& subject);
  /// Of a number of something, 0 when it is none: "hand.xml:304: flockOfBirds: number: expected a
  /// whole number from 0 on, got 't'; 0 is used".
  int count(std::string_view word, const Place& subject);
  /// `way`: what many places may have wrong alike
  void add(const std::string& way, Diagnostic diagnostic);
  template <class... Args>
  void add(const std::string& way, const Place& place, fmt::format_string<Args...> format,
           Args&&... args) {
    add(way, Diagnostic(place, fmt::format(format, std::forward<Args>(args)...)));
  }
  /// Tells of all so far: of each way the first sentence, and how many more there are.
  void tell();

 private:
  struct Kind {
    std::string way;
    Diagnostic first;
  };
  Diagnostics diagnostics_;
  About about_;
  std::vector<Kind> kinds_;
};

/// "finger", when that is taken, becomes "finger_2", or the next that is not.
template <class Names>
std::string unused_name(const std::string& name, const Names& taken) {
  for (int i = 2;; ++i)
    if (const std::string own = name + '_' + std::to_string(i); !taken.contains(own)) return own;
}

}  // namespace clench
