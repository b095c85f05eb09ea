// SPDX-License-Identifier: GPL-3.0-or-later
/// How a caller watches long work: it can ask the work to stop, and it can be told how far the work has come.
#pragma once

#include <algorithm>
#include <atomic>

namespace earthtop {

/// How far some work has come. Only one thread at a time writes it; any thread may read it meanwhile. The share never
/// decreases.
class Progress {
 public:
  double share() const noexcept { return share_.load(std::memory_order_relaxed); }  ///< done part of the whole work, 0 to 1
  const char* phase() const noexcept { return phase_.load(std::memory_order_relaxed); }
  void reach(double share) noexcept {
    if (share > share_.load(std::memory_order_relaxed)) share_.store(std::min(share, 1.0), std::memory_order_relaxed);
  }
  /// @param phase  name of what is being done; must have static storage duration
  void enter(const char* phase) noexcept { phase_.store(phase, std::memory_order_relaxed); }

 private:
  std::atomic<double> share_ = 0;
  std::atomic<const char*> phase_ = "";
};

/// The link between a piece of work and its watcher: it tells whether to stop, and takes reports of the share of this piece
/// that is done. It is a small value: pass it by copy or by reference. Loops check it once per step, which costs one load, and
/// report their progress from time to time. A default-constructed watch never asks to stop and reports to nobody.
class Watch {
 public:
  Watch() = default;
  /// @param stop, progress  either may be null; both must outlive the work
  Watch(const std::atomic<bool>* stop, Progress* progress = nullptr)
      : stop_(stop), progress_(progress) {}  // NOLINT: a stop flag converts to a watch implicitly

  /// The same stop flag with another progress, for work that reports to somebody else.   @param progress  may be null; must
  /// outlive the work
  Watch with_progress(Progress* progress) const noexcept { return {stop_, progress}; }

  /// Whether anybody wants to know the progress.
  bool has_progress() const noexcept { return progress_ != nullptr; }
  bool asks_to_stop() const noexcept { return stop_ != nullptr && stop_->load(std::memory_order_relaxed); }
  /// Reports the progress.   @param share  done part of this piece of work, 0 to 1
  void reach(double share) const noexcept {
    if (progress_ != nullptr) progress_->reach(from_ + (to_ - from_) * std::clamp(share, 0.0, 1.0));
  }
  /// The watch for the sub-piece between the shares `from` and `to` of this piece; everything before `from` is reported as
  /// done.
  Watch part(double from, double to) const noexcept {
    Watch part = *this;
    part.from_ = from_ + (to_ - from_) * std::clamp(from, 0.0, 1.0);
    part.to_ = from_ + (to_ - from_) * std::clamp(to, 0.0, 1.0);
    part.reach(0);
    return part;
  }
  /// The same, and sets the name of the phase that is shown.   @param phase  must have static storage duration
  Watch part(double from, double to, const char* phase) const noexcept {
    if (progress_ != nullptr) progress_->enter(phase);
    return part(from, to);
  }

 private:
  const std::atomic<bool>* stop_ = nullptr;
  Progress* progress_ = nullptr;
  double from_ = 0, to_ = 1;
};

/// Divides a watch among several pieces of work that are done one after the other, in proportion to their costs.
class Parts {
 public:
  /// @param total  sum of all costs, in any unit
  Parts(const Watch& watch, double total) : watch_(watch), total_(total) {}
  Watch next(double cost) noexcept {
    const double from = share();
    done_ += cost;
    return watch_.part(from, share());
  }
  /// @param phase  name shown unless the cost of the piece is zero; must have static storage duration
  Watch next(double cost, const char* phase) noexcept {
    if (cost > 0) watch_.part(share(), 1, phase);
    return next(cost);
  }

 private:
  double share() const noexcept { return total_ > 0 ? done_ / total_ : 0; }
  Watch watch_;
  double total_, done_ = 0;
};

}  // namespace earthtop
