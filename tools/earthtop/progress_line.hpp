/// Progress on a terminal: a line that is written over itself.
#pragma once

#include <condition_variable>
#include <mutex>
#include <string>
#include <thread>

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

/// Shows how long work has taken, of how long it may take, from its first second on, as long as this lives.
class ElapsedLine {
 public:
  /// @param expected_s  by estimate
  ElapsedLine(bool wanted, double expected_s);
  ~ElapsedLine();
  ElapsedLine(const ElapsedLine&) = delete;
  ElapsedLine& operator=(const ElapsedLine&) = delete;

 private:
  void tell(double expected_s);
  ProgressLine line_;
  std::mutex mutex_;
  std::condition_variable done_;
  bool is_done_ = false;
  std::thread thread_;
};

}  // namespace earthtop::tool
