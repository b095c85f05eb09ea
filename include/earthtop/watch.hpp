// SPDX-License-Identifier: GPL-3.0-or-later
/// Who watches some work: they may ask it to stop, and may want to know how far it has come.
#pragma once

#include <algorithm>
#include <atomic>

namespace earthtop {

/// How far some work has come. One thread at a time writes it; any may read it meanwhile. The share never falls.
class Progress {
 public:
  double share() const noexcept { return share_.load(std::memory_order_relaxed); }  ///< 0 to 1, of the whole work
  const char* phase() const noexcept { return phase_.load(std::memory_order_relaxed); }
  void reach(double share) noexcept {
    if (share > share_.load(std::memory_order_relaxed)) share_.store(std::min(share, 1.0), std::memory_order_relaxed);
  }
  /// @param phase  what is being done; of static storage
  void enter(const char* phase) noexcept { phase_.store(phase, std::memory_order_relaxed); }

 private:
  std::atomic<double> share_ = 0;
  std::atomic<const char*> phase_ = "";
};

/// A part of the watched work, as who does it sees it: whether to stop, and where to tell how much of the part is done. It is a
/// small value: hand it on by copy or by reference. Loops ask it once a step, which costs one load, and tell it how far they
/// are now and then. A default one asks for nothing and tells nobody.
class Watch {
 public:
  Watch() = default;
  /// @param stop, progress  either may be null; both outlive the work
  Watch(const std::atomic<bool>* stop, Progress* progress = nullptr)
      : stop_(stop), progress_(progress) {}  // NOLINT: a flag is one

  /// Stopped by the same, for work that tells another how far it is. @param progress  may be null; outlives the work
  Watch telling(Progress* progress) const noexcept { return {stop_, progress}; }

  /// Whether anybody wants to know how far the work is.
  bool is_told() const noexcept { return progress_ != nullptr; }
  bool asks_to_stop() const noexcept { return stop_ != nullptr && stop_->load(std::memory_order_relaxed); }
  /// @param share  0 to 1, of this part
  void reach(double share) const noexcept {
    if (progress_ != nullptr) progress_->reach(from_ + (to_ - from_) * std::clamp(share, 0.0, 1.0));
  }
  /// The part of this part between two shares of it. What comes before is done.
  Watch part(double from, double to) const noexcept {
    Watch part = *this;
    part.from_ = from_ + (to_ - from_) * std::clamp(from, 0.0, 1.0);
    part.to_ = from_ + (to_ - from_) * std::clamp(to, 0.0, 1.0);
    part.reach(0);
    return part;
  }
  /// The same, with the name that it is shown by. @param phase  of static storage
  Watch part(double from, double to, const char* phase) const noexcept {
    if (progress_ != nullptr) progress_->enter(phase);
    return part(from, to);
  }

 private:
  const std::atomic<bool>* stop_ = nullptr;
  Progress* progress_ = nullptr;
  double from_ = 0, to_ = 1;
};

/// Gives each of several pieces of work, one after the other, the part of a watch that its cost has of all.
class Parts {
 public:
  /// @param total  of all costs, in any unit
  Parts(const Watch& watch, double total) : watch_(watch), total_(total) {}
  Watch next(double cost) noexcept {
    const double from = share();
    done_ += cost;
    return watch_.part(from, share());
  }
  /// @param phase  shown where the piece costs anything; of static storage
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
