// SPDX-License-Identifier: GPL-3.0-or-later
/// A value that is made when it is first asked for.
#pragma once

#include <mutex>
#include <optional>

namespace earthtop {

/// Safe where several threads ask at once. Where making it throws, it is tried again when it is asked for again.
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
