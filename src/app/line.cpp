#include "clench/app/line.h"

#include <histedit.h>
#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <clocale>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cwchar>
#include <memory>
#include <string_view>
#include <system_error>

#include "clench/app/interrupt.h"
#include "clench/app/kept_terminal.h"
#include "clench/base/error.h"
#include "clench/base/file.h"
#include "clench/base/printable.h"

namespace clench {

namespace fs = std::filesystem;

struct LineEditor::Terminal {
  KeptTerminal kept;  // settings before the editor changes them
  EditLine* edit = nullptr;
  History* history = nullptr;
  HistEvent event = {};
  fs::path file;
  Complete complete;
  Background background;
  std::string prompt;
  bool interrupted = false;
  bool pasting = false;  // is the input pasted text?
  std::string pending;   // bytes already read, returned before those of the terminal

  static Terminal* of(EditLine* edit) {
    void* data = nullptr;
    el_get(edit, EL_CLIENTDATA, &data);
    return static_cast<Terminal*>(data);
  }
};

static size_t common_start(const std::vector<std::string>& words) {
  size_t size = words[0].size();
  for (const auto& word : words) {
    const auto end =
        std::mismatch(words[0].begin(), words[0].end(), word.begin(), word.end()).first;
    size = std::min(size, static_cast<size_t>(end - words[0].begin()));
  }
  return size;
}

// lists words below the line, in as many columns as fit
static void list_words(const std::vector<std::string>& words) {
  size_t widest = 0;
  for (const auto& word : words) widest = std::max(widest, word.size() + 2);
  const size_t columns = std::max<size_t>(1, 78 / widest);
  std::fputc('\n', stdout);
  for (size_t i = 0; i < words.size(); ++i) {
    const bool last = (i + 1) % columns == 0 || i + 1 == words.size();
    std::fprintf(stdout, "%-*s%s", last ? 0 : static_cast<int>(widest), printable(words[i]).c_str(),
                 last ? "\n" : "");
  }
  std::fflush(stdout);
}

template <class Terminal>
static unsigned char complete_word(EditLine* edit, int) {
  Terminal* terminal = Terminal::of(edit);
  const LineInfo* info = el_line(edit);
  auto words = terminal->complete(std::string(info->buffer, info->cursor));
  if (words.size() < 2) return CC_REFRESH_BEEP;
  const size_t typed = words[0].size();
  words.erase(words.begin());
  const size_t common = common_start(words);
  if (common > typed) {
    el_insertstr(edit, words[0].substr(typed, common - typed).c_str());
    return CC_REFRESH;
  }
  if (words.size() == 1) return CC_NORM;
  list_words(words);
  return CC_REDISPLAY;
}

// clears the typed line, lets the background print, and shows the line again
template <class Terminal>
static void run_background(Terminal& terminal) {
  std::fputs("\r\x1b[K", stdout);
  terminal.background.run();
  std::fflush(stdout);
  el_set(terminal.edit, EL_REFRESH);
}

// reads a byte from the terminal: 1, end of input: 0, Ctrl-C or a failure: -1
template <class Terminal>
static int read_byte(Terminal& terminal, char& byte) {
  // the signal is unblocked only while poll waits, so that none is missed immediately before
  sigset_t only, before;
  sigemptyset(&only);
  sigaddset(&only, SIGINT);
  sigprocmask(SIG_BLOCK, &only, &before);
  int count = -1;
  for (;;) {
    terminal.interrupted = take_interrupt();
    if (terminal.interrupted) break;
    // poll ignores a negative descriptor
    pollfd inputs[] = {{STDIN_FILENO, POLLIN, 0}, {terminal.background.descriptor, POLLIN, 0}};
    const int ready = ppoll(inputs, 2, nullptr, &before);
    if (ready < 0 && errno == EINTR) continue;
    if (inputs[0].revents == 0 && inputs[1].revents != 0) {
      sigprocmask(SIG_SETMASK, &before, nullptr);
      run_background(terminal);
      sigprocmask(SIG_BLOCK, &only, nullptr);
      continue;
    }
    count = static_cast<int>(::read(STDIN_FILENO, &byte, 1));
    if (count >= 0 || errno != EINTR) break;
  }
  sigprocmask(SIG_SETMASK, &before, nullptr);
  return count;
}

// markers of bracketed paste
static constexpr std::string_view paste_begins = "\x1b[200~", paste_ends = "\x1b[201~";

// does a byte follow immediately, as in the sequence of a key?
static bool goes_on() {
  pollfd input{STDIN_FILENO, POLLIN, 0};
  return poll(&input, 1, 20) == 1;
}

// as read_byte; tabs in pasted text are quoted, so that they do not trigger completion
template <class Terminal>
static int next_byte(Terminal& terminal, char& byte) {
  std::string& pending = terminal.pending;
  for (;;) {
    if (!pending.empty()) {
      byte = pending.front();
      pending.erase(0, 1);
      return 1;
    }
    const int count = read_byte(terminal, byte);
    if (count <= 0 || (byte != '\x1b' && !(byte == '\t' && terminal.pasting))) return count;
    if (byte == '\t') {
      pending = byte;
      byte = '\x16';  // Ctrl-V
      return 1;
    }
    std::string seen(1, byte);
    char next = 0;
    while ((paste_begins.starts_with(seen) || paste_ends.starts_with(seen)) &&
           seen.size() < paste_begins.size() && goes_on() && read_byte(terminal, next) > 0)
      seen += next;
    if (seen != paste_begins && seen != paste_ends) {
      pending = seen.substr(1);
      return 1;
    }
    terminal.pasting = seen == paste_begins;
  }
}

// reads one character from the terminal; Ctrl-C ends the wait
template <class Terminal>
static int read_character(EditLine* edit, wchar_t* out) {
  Terminal* terminal = Terminal::of(edit);
  std::mbstate_t partial = {};
  for (;;) {
    char byte = 0;
    const int count = next_byte(*terminal, byte);
    if (count <= 0) return count;
    const size_t used = std::mbrtowc(out, &byte, 1, &partial);
    if (used == static_cast<size_t>(-2)) continue;  // incomplete character
    if (used == static_cast<size_t>(-1)) partial = {}, *out = L'?';
    return 1;
  }
}

LineEditor::LineEditor(fs::path history, Complete complete, Background background)
    : terminal_(new Terminal) {
  std::setlocale(LC_CTYPE, "C.UTF-8");
  Terminal& t = *terminal_;
  t.file = std::move(history);
  t.complete = std::move(complete);
  t.background = std::move(background);
  t.edit = el_init("clench", stdin, stdout, stderr);
  t.history = history_init();
  el_set(t.edit, EL_CLIENTDATA, &t);
  el_set(
      t.edit, EL_PROMPT, +[](EditLine* edit) { return Terminal::of(edit)->prompt.data(); });
  el_set(t.edit, EL_EDITOR, "emacs");
  el_set(t.edit, EL_SIGNAL, 0);
  el_set(t.edit, EL_GETCFN, &read_character<Terminal>);
  el_set(t.edit, EL_ADDFN, "clench-complete", "complete a name", &complete_word<Terminal>);
  el_set(t.edit, EL_BIND, "^I", "clench-complete", nullptr);
  el_set(t.edit, EL_BIND, "^R", "em-inc-search-prev", nullptr);
  ::history(t.history, &t.event, H_SETSIZE, 2000);
  ::history(t.history, &t.event, H_SETUNIQUE, 1);
  ::history(t.history, &t.event, H_LOAD, t.file.c_str());
  el_set(t.edit, EL_HIST, ::history, t.history);
  el_source(t.edit, nullptr);
}

LineEditor::~LineEditor() {
  history_end(terminal_->history);
  el_end(terminal_->edit);
}

LineEditor::Key LineEditor::read(const std::string& prompt, std::string& line) {
  Terminal& t = *terminal_;
  t.prompt = prompt;
  t.interrupted = false;
  take_interrupt();
  // set before the prompt is shown, otherwise a key pressed at that time would be handled by the
  // terminal
  el_set(t.edit, EL_PREP_TERM, 1);
  mark_pastes(true);
  int count = 0;
  const char* text = el_gets(t.edit, &count);
  mark_pastes(false);
  if (t.interrupted) {
    t.pasting = false;
    t.pending.clear();
    std::fputs("^C\n", stdout);
    el_reset(t.edit);
    return Key::interrupted;
  }
  if (!text || count <= 0) return Key::end;
  line.assign(text, static_cast<size_t>(count));
  while (!line.empty() && (line.back() == '\n' || line.back() == '\r')) line.pop_back();
  return Key::line;
}

void LineEditor::remember(const std::string& entry) {
  Terminal& t = *terminal_;
  if (entry.find_first_not_of(" \t\n") == std::string::npos) return;
  ::history(t.history, &t.event, H_ENTER, entry.c_str());
  if (t.file.empty()) return;
  const SignalsLater whole_file;
  std::error_code ignored;
  fs::create_directories(t.file.parent_path(), ignored);
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> lines(std::tmpfile(), std::fclose);
  if (!lines || ::history(t.history, &t.event, H_SAVE_FP, lines.get()) < 0) return;
  if (std::fflush(lines.get()) != 0) return;
  std::rewind(lines.get());
  std::string text;
  char part[4096];
  while (const size_t count = std::fread(part, 1, sizeof part, lines.get()))
    text.append(part, count);
  try {
    if (fs::exists(t.file, ignored))
      write_file(t.file, text);
    else
      Draft(t.file, text, 0600).move_to(t.file);
  } catch (const Error&) {
    // the console works without a history file
  }
}

fs::path history_file() {
  std::error_code none;
  if (const char* state = std::getenv("XDG_STATE_HOME"); state && *state)
    return fs::path(state) / "clench/history";
  const char* home = std::getenv("HOME");
  if (!home || !*home) return {};
  const fs::path state = fs::path(home) / ".local/state";
  if (fs::is_directory(state, none)) return state / "clench/history";
  return fs::path(home) / ".clench_history";
}

}  // namespace clench
