// Problems and decisions that readers, writers and builders report: values, passed to a sink that
// the caller gives.
#pragma once
#include <functional>
#include <string>
#include <utility>

#include "clench/base/place.h"

namespace clench {

enum class Severity { note, warning, error };

/// Category of a problem or decision.
enum class About {
  none,       ///< none of the others, for example a loss in a written file
  inferred,   ///< a file leaves it open, and it is guessed
  ignored,    ///< a file contains it, and it is not used
  repaired,   ///< a file has it wrong, and it is put right
  suspicious  ///< it is used as it stands, and looks wrong
};

struct Diagnostic {
  Diagnostic() = default;
  Diagnostic(Place where, std::string sentence)
      : place(std::move(where)), text(std::move(sentence)) {}
  /// Without a place.
  Diagnostic(std::string sentence) : text(std::move(sentence)) {}

  Place place;
  std::string text;  ///< without the place
  Severity severity = Severity::warning;
  About about = About::none;
  int count = 1;  ///< number of equal problems in the file, of which this is the first
  /// The text is a sentence that begins with the name of the file.
  bool names_file = false;

  /// The text, with the number of further equal problems: "... (3 more alike)".
  std::string message() const {
    return count > 1 ? text + fmt::format(" ({} more alike)", count - 1) : text;
  }
  /// As shown to a user: "Barrett.xml:31: joint 2: ..."
  std::string sentence() const { return names_file ? message() : place.before(message()); }
};

/// Receiver of diagnostics. May be empty: then nothing is formatted.
class Diagnostics {
 public:
  using Receiver = std::function<void(const Diagnostic&)>;

  Diagnostics() = default;
  explicit Diagnostics(Receiver receiver) : receiver_(std::move(receiver)) {}
  /// True if there is a receiver.
  explicit operator bool() const { return static_cast<bool>(receiver_); }

  void report(About about, Diagnostic diagnostic) const {
    if (!receiver_) return;
    diagnostic.about = about;
    diagnostic.severity = about == About::inferred ? Severity::note : Severity::warning;
    receiver_(diagnostic);
  }
  template <class... Args>
  void report(About about, const Place& place, fmt::format_string<Args...> format,
              Args&&... args) const {
    if (receiver_)
      report(about, Diagnostic(place, fmt::format(format, std::forward<Args>(args)...)));
  }

  /// Reports contents that are not used.
  void warn(Diagnostic diagnostic) const { report(About::ignored, std::move(diagnostic)); }
  template <class... Args>
  void warn(const Place& place, fmt::format_string<Args...> format, Args&&... args) const {
    report(About::ignored, place, format, std::forward<Args>(args)...);
  }
  /// Reports an assumption.
  void note(Diagnostic diagnostic) const { report(About::inferred, std::move(diagnostic)); }
  template <class... Args>
  void note(const Place& place, fmt::format_string<Args...> format, Args&&... args) const {
    report(About::inferred, place, format, std::forward<Args>(args)...);
  }
  /// Reports a repair.
  void repaired(Diagnostic diagnostic) const { report(About::repaired, std::move(diagnostic)); }
  template <class... Args>
  void repaired(const Place& place, fmt::format_string<Args...> format, Args&&... args) const {
    report(About::repaired, place, format, std::forward<Args>(args)...);
  }
  /// Reports a suspicious value that is used nevertheless.
  void suspected(Diagnostic diagnostic) const { report(About::suspicious, std::move(diagnostic)); }
  template <class... Args>
  void suspected(const Place& place, fmt::format_string<Args...> format, Args&&... args) const {
    report(About::suspicious, place, format, std::forward<Args>(args)...);
  }
  /// Reports something that a written file cannot hold: "hand.urdf does not hold `what`".
  void lost(const std::string& file, const std::string& what) const {
    Diagnostic diagnostic(Place(file), file + " does not hold " + what);
    diagnostic.names_file = true;
    report(About::none, std::move(diagnostic));
  }

  /// The same sink, which receives no notes.
  Diagnostics without_notes() const {
    if (!receiver_) return {};
    return Diagnostics([receiver = receiver_](const Diagnostic& diagnostic) {
      if (diagnostic.severity != Severity::note) receiver(diagnostic);
    });
  }

 private:
  Receiver receiver_;
};

}  // namespace clench
