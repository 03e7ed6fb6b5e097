// Repairs invalid values in files. Errors of the same kind at many places are reported once, at the
// first place.
#pragma once
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "clench/base/diagnostic.h"

namespace clench {

class Repairs {
 public:
  /// about  category of the diagnostics
  explicit Repairs(Diagnostics diagnostics, About about = About::repaired)
      : diagnostics_(std::move(diagnostics)), about_(about) {}

  /// Exchanges limits that are in the wrong order: "hand.xml:31: joint 2: minValue 30 exceeds
  /// maxValue -4; they are exchanged".   names  of the two limits
  void order(double& low, double& high, const Place& subject,
             std::pair<const char*, const char*> names = {"min", "max"});
  /// A value that must not be negative: "hand.xml:6: DOF 0: maxEffort: -1.5 is negative; 1.5 is
  /// used".
  double magnitude(double value, const Place& subject);
  /// A value that must not be 0: "distal.xml:5: mass: 0 is not allowed; 300 is used, as for a
  /// missing value".
  double not_zero(double value, double absent, const Place& subject);
  /// The value clamped to low..high: "hand.xml:9: color: rgba: 1.5 is not in 0..1; 1 is used".
  double within(double value, double low, double high, const Place& subject);
  /// A count; 0 if the word is not one: "hand.xml:304: flockOfBirds: number: expected a whole
  /// number from 0 on, got 't'; 0 is used".
  int count(std::string_view word, const Place& subject);
  /// way  kind of error; errors of the same kind are reported together
  void add(const std::string& way, Diagnostic diagnostic);
  template <class... Args>
  void add(const std::string& way, const Place& place, fmt::format_string<Args...> format,
           Args&&... args) {
    add(way, Diagnostic(place, fmt::format(format, std::forward<Args>(args)...)));
  }
  /// Reports all repairs so far: for each kind the first message, and the number of further ones.
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

/// "finger_2" for "finger", or the first free number from 2 on.
template <class Names>
std::string unused_name(const std::string& name, const Names& taken) {
  for (int i = 2;; ++i)
    if (const std::string own = name + '_' + std::to_string(i); !taken.contains(own)) return own;
}

}  // namespace clench
