// SPDX-License-Identifier: GPL-3.0-or-later
/// A value that is made when it is first asked for.
#pragma once

#include <atomic>
#include <mutex>
#include <optional>

namespace earthtop {

/// Holds a value that is made on first request. Several threads may request it at once. If making it throws, the next request
/// tries again. (std::call_once would pass the exception through the C library, which needs memory for that.)
template <class V>
class Once {
 public:
  template <class Make>
  const V& get(const Make& make) const {
    if (!is_made_.load(std::memory_order_acquire)) {
      const std::lock_guard lock(making_);
      if (!value_) value_.emplace(make());
      is_made_.store(true, std::memory_order_release);
    }
    return *value_;
  }

 private:
  mutable std::atomic<bool> is_made_ = false;
  mutable std::mutex making_;
  mutable std::optional<V> value_;
};

}  // namespace earthtop
