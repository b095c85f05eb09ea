// SPDX-License-Identifier: GPL-3.0-or-later
/// A value that is made when it is first asked for.
#pragma once

#include <mutex>
#include <optional>

namespace earthtop {

/// Holds a value that is made on first request. Several threads may request it at once. If making it throws, the next request
/// tries again.
template <class V>
class Once {
 public:
  template <class Make>
  const V& get(const Make& make) const {
    std::call_once(made_, [&] { value_.emplace(make()); });
    return *value_;
  }

 private:
  mutable std::once_flag made_;
  mutable std::optional<V> value_;
};

}  // namespace earthtop
