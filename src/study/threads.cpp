// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <condition_variable>
#include <deque>
#include <exception>
#include <mutex>
#include <system_error>
#include <thread>

#include "earthtop/run.hpp"
#include "study/workforce.hpp"

namespace earthtop::study {
namespace {

class Threads : public Workforce {
 public:
  Threads(const Study& study, unsigned jobs, const Watch& watch) : study_(study), collector_(study), watch_(watch) {
    threads_.reserve(jobs);
  }
  ~Threads() override {
    {
      const std::lock_guard lock(mutex_);
      ends_ = true;
      waiting_.clear();
    }
    work_came_.notify_all();
    for (std::thread& thread : threads_) thread.join();
  }

  /// Starts the threads, or as many of them as the system grants. If it grants none, `collect` computes in the calling thread.
  void start() {
    try {
      while (threads_.size() < threads_.capacity()) threads_.emplace_back([this] { work(); });
    } catch (const std::system_error&) {
    }
  }

  bool wants_work() override {
    const std::lock_guard lock(mutex_);
    return waiting_.size() < std::max<std::size_t>(1, threads_.size());  // at most one chunk waiting per thread
  }
  void give(Chunk chunk) override {
    {
      const std::lock_guard lock(mutex_);
      waiting_.push_back(std::move(chunk));
      ++under_way_;
    }
    work_came_.notify_one();
  }
  std::size_t under_way() const override {
    const std::lock_guard lock(mutex_);
    return under_way_;
  }
  double points_begun() const override {
    const std::lock_guard lock(mutex_);
    double points = 0;
    for (const Busy& busy : busy_) points += busy.progress->share() * static_cast<double>(busy.points);
    return points;
  }
  std::vector<PointResult> collect(std::chrono::milliseconds patience) override {
    if (threads_.empty() && under_way() > 0) compute_next();
    std::unique_lock lock(mutex_);
    result_came_.wait_for(lock, patience, [&] { return came_; });
    came_ = false;
    if (thrown_) std::rethrow_exception(thrown_);
    return std::exchange(results_, {});
  }

 private:
  /// The work of a thread. An exception, for want of memory, ends it and waits for `collect`.
  void work() noexcept {
    try {
      while (compute_next()) {
      }
    } catch (...) {
      {
        const std::lock_guard lock(mutex_);
        thrown_ = std::current_exception();
        came_ = true;
      }
      result_came_.notify_one();
    }
  }

  /// Waits for a chunk and computes it. @returns false if there will be none
  bool compute_next() {
    Chunk chunk;
    Progress progress;
    {
      std::unique_lock lock(mutex_);
      work_came_.wait(lock, [&] { return ends_ || !waiting_.empty(); });
      if (ends_) return false;
      chunk = std::move(waiting_.front());
      waiting_.pop_front();
      busy_.push_back({&progress, chunk.size()});
    }
    const LeavesBusy leaves{*this, &progress};
    std::vector<PointResult> results = compute(study_, collector_, chunk, watch_.with_progress(&progress));
    {
      const std::lock_guard lock(mutex_);
      results_.insert(results_.end(), std::make_move_iterator(results.begin()), std::make_move_iterator(results.end()));
      --under_way_;
      came_ = true;
    }
    result_came_.notify_one();
    return true;
  }

  /// A chunk that is being computed.
  struct Busy {
    const Progress* progress;
    std::size_t points;
  };
  /// Takes the chunk with this progress off the list when it is done, or given up.
  struct LeavesBusy {
    Threads& threads;
    const Progress* progress;
    ~LeavesBusy() {
      const std::lock_guard lock(threads.mutex_);
      std::erase_if(threads.busy_, [&](const Busy& busy) { return busy.progress == progress; });
    }
  };

  const Study& study_;
  Collector collector_;
  Watch watch_;
  mutable std::mutex mutex_;
  std::condition_variable work_came_, result_came_;
  std::deque<Chunk> waiting_;
  std::vector<PointResult> results_;
  std::vector<Busy> busy_;
  std::size_t under_way_ = 0;
  std::exception_ptr thrown_;  // the last exception that ended a thread
  bool came_ = false, ends_ = false;
  std::vector<std::thread> threads_;
};

}  // namespace

std::unique_ptr<Workforce> make_threads(const Study& study, unsigned jobs, const Watch& watch) {
  auto threads = std::make_unique<Threads>(study, jobs, watch);
  threads->start();
  return threads;
}

}  // namespace earthtop::study
