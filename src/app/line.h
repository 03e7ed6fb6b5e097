// Reads a line typed at a terminal: editing, history, completion. The only file that uses libedit.
#pragma once
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace clench {

class LineEditor {
 public:
  /// Completions of the word at the cursor: first its part up to the cursor, then complete words.
  using Complete = std::function<std::vector<std::string>(const std::string& before_cursor)>;
  enum class Key { line, interrupted, end };
  /// Background work while a line is typed: `run` is called whenever the descriptor is readable. It
  /// may print; the typed line is then shown again below the output.
  struct Background {
    int descriptor = -1;  ///< -1: no background work
    std::function<void()> run;
  };

  /// history  a file; created when a line is first remembered, and ignored if that fails
  LineEditor(std::filesystem::path history, Complete complete, Background background);
  ~LineEditor();

  /// Reads a line, without its end. interrupted: Ctrl-C; end: Ctrl-D.
  Key read(const std::string& prompt, std::string& line);
  void remember(const std::string& entry);

 private:
  struct Terminal;
  std::unique_ptr<Terminal> terminal_;
};

/// $XDG_STATE_HOME/clench/history; otherwise ~/.local/state/clench/history if that folder exists,
/// or ~/.clench_history.
std::filesystem::path history_file();

}  // namespace clench
