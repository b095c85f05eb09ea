// SPDX-License-Identifier: GPL-3.0-or-later
/// Progress on a terminal: a line that is written over itself.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <string_view>

namespace earthtop {
class Progress;
}

namespace earthtop::tool {

/// Whether a stream is a terminal whose user wants more than text (NO_COLOR is honoured). @param descriptor  e.g. STDERR_FILENO
bool is_lively_terminal(int descriptor);

class ProgressLine {
 public:
  /// @param wanted  false: nothing is ever shown; nor is it where standard error is no such terminal
  explicit ProgressLine(bool wanted);
  ~ProgressLine() { clear(); }
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;
  void show(const std::string& line);
  void clear();
  bool is_shown() const { return shown_; }

 private:
  bool shown_;
  std::size_t width_ = 0;
};

/// Whether a line stands on the terminal. Safe in a signal handler.
bool is_line_shown() noexcept;

/// "3.2 s", "12 min", "4.5 h", "2.1 days".
std::string duration_text(double seconds);

/// "42%  error bound, 12 s left". @param seconds  since the work began
std::string progress_text(double share, std::string_view phase, double seconds);

/// Shows how much of some work is done, in which phase it is and how long it will take, from its first second on, as long as
/// this lives.
class ProgressDisplay {
 public:
  /// @param progress  outlives this
  ProgressDisplay(bool wanted, const Progress& progress);
  ~ProgressDisplay();
  ProgressDisplay(const ProgressDisplay&) = delete;
  ProgressDisplay& operator=(const ProgressDisplay&) = delete;

  /// Whether there is anybody to show it to.
  bool is_shown() const;
  /// Says something else, for which the line makes way.
  void aside(const std::function<void()>& say);

 private:
  class Teller;  // with a thread of its own
  std::unique_ptr<Teller> teller_;
};

}  // namespace earthtop::tool
