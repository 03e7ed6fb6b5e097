// What a file has wrong and a reader puts right. What is wrong in one way at many places is told
// once, at the first.
#pragma once
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "clench/base/listeners.h"

namespace clench {

class Repairs {
 public:
  explicit Repairs(Listeners listeners) : listeners_(std::move(listeners)) {}

  /// Limits that are the wrong way round are exchanged: "hand.xml:31: joint 2: minValue 30 exceeds
  /// maxValue -4; they are exchanged".   `names`  of the two
  void order(double& low, double& high, const std::string& subject,
             std::pair<const char*, const char*> names = {"min", "max"});
  /// Of what is never negative: "hand.xml:6: DOF 0: maxEffort: -1.5 is negative; 1.5 is used".
  double magnitude(double value, const std::string& subject);
  /// Of what is never 0: "distal.xml:5: mass: 0 is none; 300 is used, as where it is missing".
  double not_zero(double value, double absent, const std::string& subject);
  /// The nearest of low..high: "hand.xml:9: color: rgba: 1.5 is not in 0..1; 1 is used".
  double within(double value, double low, double high, const std::string& subject);
  /// Of a number of something, 0 when it is none: "hand.xml:304: flockOfBirds: number: expected a
  /// whole number from 0 on, got 't'; 0 is used".
  int count(std::string_view word, const std::string& subject);
  /// `way`: what many places may have wrong alike
  void add(const std::string& way, const std::string& sentence);
  /// Tells of all so far: of each way the first sentence, and how many more there are.
  void tell();

 private:
  struct Kind {
    std::string way, sentence;
    int more = 0;
  };
  Listeners listeners_;
  std::vector<Kind> kinds_;
};

/// "finger", when that is taken, becomes "finger_2", or the next that is not.
template <class Names>
std::string unused_name(const std::string& name, const Names& taken) {
  for (int i = 2;; ++i)
    if (const std::string own = name + '_' + std::to_string(i); !taken.contains(own)) return own;
}

}  // namespace clench
