#include "clench/script/lua/watching.h"

#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <string>

#include "clench/base/convert.h"
#include "clench/base/text.h"
#include "clench/script/lua/kept.h"

namespace clench {

static double bar_time() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

// before it is shown, and between two updates [s]
static constexpr double bar_delay = 0.5, pause = 0.1;

static constexpr std::string_view erase_line = "\r\x1b[K";

// The terminal is shared by all states and threads of the process.
static std::atomic<bool> bar_stands = false;

void write_above_bar(std::string_view lines) {
  std::string text(bar_stands.exchange(false) ? erase_line : "");
  text += lines;
  std::fwrite(text.data(), 1, text.size(), stderr);
}

Bar::Bar() : terminal_(isatty(STDERR_FILENO) == 1) {}

void Bar::begin() {
  if (depth_++ == 0) began_ = last_ = bar_time();
}

void Bar::end() {
  if (--depth_ > 0 || !drawn_) return;
  write_above_bar("");
  drawn_ = false;
}

bool Bar::take_end_of_time() {
  if (!out_of_time_.exchange(false)) return false;
  take_stop();
  if (interrupted_ || stopped_for_good_) stop();
  return true;
}

bool Bar::take_all() {
  interrupted_ = false, out_of_time_ = false;
  const bool asked = take_stop();
  if (stopped_for_good_) stop();
  return asked;
}

void Bar::show(double fraction, std::string_view text) {
  if (scripts_ == 0 || in_script_) draw(fraction, text);
}

void Bar::begin_script() {
  begin();
  ++scripts_;
}

void Bar::end_script() {
  if (--scripts_ == 0) {
    const std::lock_guard lock(mutex_);
    script_.reset();
  }
  end();
}

Watcher::State Bar::shown() const {
  const std::lock_guard lock(mutex_);
  return script_ ? *script_ : state();
}

void Bar::note_script(double fraction, std::string_view text) {
  {
    const std::lock_guard lock(mutex_);
    script_ = {fraction, std::string(text)};
  }
  in_script_ = true;
  note(fraction, text);
  in_script_ = false;
}

void Bar::draw(double fraction, std::string_view text) {
  if (!terminal_ || depth_ == 0) return;
  const double time = bar_time();
  if (time - began_ < bar_delay || time - last_ < pause) return;
  last_ = time;
  drawn_ = true;
  std::string line(erase_line);
  if (fraction >= 0) {
    constexpr int width = 30;
    const int full = floor_between(fraction * width, 0, width);
    line += fmt::format("[{:#<{}}{: <{}}] {:3d} %  ", "", full, "", width - full,
                        floor_between(100 * fraction, 0, 100));
    // remaining time, if it can be estimated
    if (fraction > 0.02 && fraction < 1)
      line += fmt::format("{:.0f} s left  ", (time - began_) * (1 - fraction) / fraction);
  }
  line += excerpt(text);
  bar_stands = true;
  std::fwrite(line.data(), 1, line.size(), stderr);
}

namespace {

struct KeptBar {
  std::shared_ptr<Bar> bar = std::make_shared<Bar>();
};

}  // namespace

const std::shared_ptr<Bar>& bar_of(lua_State* L) { return kept<KeptBar>(L).bar; }

Watching::Watching(lua_State* L) : bar_(bar_of(L)), progress_(bar_) { bar_->begin(); }

}  // namespace clench
