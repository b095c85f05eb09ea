// SPDX-License-Identifier: GPL-3.0-or-later
#include <condition_variable>
#include <deque>
#include <mutex>
#include <thread>

#include "earthtop/run.hpp"
#include "study/workforce.hpp"

namespace earthtop::study {
namespace {

class Threads : public Workforce {
 public:
  Threads(const Study& study, unsigned jobs, const Watch& watch)
      : study_(study), collector_(study), jobs_(jobs), watch_(watch) {
    threads_.reserve(jobs);
    for (unsigned i = 0; i < jobs; ++i) threads_.emplace_back([this] { work(); });
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

  bool wants_work() override {
    const std::lock_guard lock(mutex_);
    return waiting_.size() < jobs_;  // at most one chunk waiting per thread
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
    std::unique_lock lock(mutex_);
    result_came_.wait_for(lock, patience, [&] { return came_; });
    came_ = false;
    return std::exchange(results_, {});
  }

 private:
  void work() {
    for (;;) {
      Chunk chunk;
      Progress progress;
      {
        std::unique_lock lock(mutex_);
        work_came_.wait(lock, [&] { return ends_ || !waiting_.empty(); });
        if (ends_) return;
        chunk = std::move(waiting_.front());
        waiting_.pop_front();
        busy_.push_back({&progress, chunk.size()});
      }
      std::vector<PointResult> results = compute(study_, collector_, chunk, watch_.with_progress(&progress));
      {
        const std::lock_guard lock(mutex_);
        results_.insert(results_.end(), std::make_move_iterator(results.begin()), std::make_move_iterator(results.end()));
        --under_way_;
        std::erase_if(busy_, [&](const Busy& busy) { return busy.progress == &progress; });
        came_ = true;
      }
      result_came_.notify_one();
    }
  }

  /// A chunk that is being computed.
  struct Busy {
    const Progress* progress;
    std::size_t points;
  };

  const Study& study_;
  Collector collector_;
  unsigned jobs_;
  Watch watch_;
  mutable std::mutex mutex_;
  std::condition_variable work_came_, result_came_;
  std::deque<Chunk> waiting_;
  std::vector<PointResult> results_;
  std::vector<Busy> busy_;
  std::size_t under_way_ = 0;
  bool came_ = false, ends_ = false;
  std::vector<std::thread> threads_;
};

}  // namespace

std::unique_ptr<Workforce> make_threads(const Study& study, unsigned jobs, const Watch& watch) {
  return std::make_unique<Threads>(study, jobs, watch);
}

}  // namespace earthtop::study
