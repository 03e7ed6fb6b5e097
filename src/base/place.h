// Place of a problem in a file, with the part of the file that it concerns.
#pragma once
#include <fmt/format.h>

#include <string>
#include <string_view>
#include <utility>

namespace clench {

/// Each part may be missing. There is no conversion from a string, so that "hand.cfg:31" cannot be
/// mistaken for a file's name.
struct Place {
  Place() = default;
  explicit Place(std::string file_name, int line_number = 0, std::string what = {})
      : file(std::move(file_name)), line(line_number), subject(std::move(what)) {}

  std::string file;     ///< name as shown to a user, without folders
  int line = 0;         ///< from 1; 0: none
  std::string subject;  ///< "joint 2", "robot 'DLR': DOF 3"

  /// The same place, narrowed: `what` is appended to the subject.
  Place of(std::string_view what) const {
    return Place(file, line,
                 subject.empty() ? std::string(what) : subject + ": " + std::string(what));
  }
  template <class... Args>
  Place of(fmt::format_string<Args...> format, Args&&... args) const {
    return of(std::string_view(fmt::format(format, std::forward<Args>(args)...)));
  }
  /// "Barrett.xml:31: joint 2"; "" when all parts are missing
  std::string text() const {
    std::string out = file;
    if (line > 0) out += ':' + std::to_string(line);
    if (!out.empty() && !subject.empty()) out += ": ";
    return out + subject;
  }
  /// "Barrett.xml:31: joint 2: `sentence`"
  std::string before(const std::string& sentence) const {
    const std::string where = text();
    return where.empty() ? sentence : where + ": " + sentence;
  }

  bool operator==(const Place&) const = default;
};

}  // namespace clench

/// A place in a sentence, as text() gives it.
template <>
struct fmt::formatter<clench::Place> : fmt::formatter<std::string> {
  template <class Context>
  auto format(const clench::Place& place, Context& context) const {
    return fmt::formatter<std::string>::format(place.text(), context);
  }
};
