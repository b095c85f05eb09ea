// SPDX-License-Identifier: GPL-3.0-or-later
/// Packs points and results into bytes, for messages between processes of one program on machines of the same kind.
#pragma once

#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "study/chunk.hpp"

namespace earthtop::study {

class MessageWriter {
 public:
  void put(std::uint64_t number) { append(&number, sizeof number); }
  void put(double number) { append(&number, sizeof number); }
  void put(std::string_view text) {
    put(std::uint64_t{text.size()});
    append(text.data(), text.size());
  }
  const std::string& bytes() const { return bytes_; }

 private:
  void append(const void* from, std::size_t size) { bytes_.append(static_cast<const char*>(from), size); }
  std::string bytes_;
};

class MessageReader {
 public:
  explicit MessageReader(std::string_view bytes) : bytes_(bytes) {}
  std::uint64_t number() { return take<std::uint64_t>(); }
  double real() { return take<double>(); }
  std::string text() {
    const std::uint64_t size = number();
    if (size > bytes_.size()) throw std::runtime_error("a message between processes is cut short");
    std::string text(bytes_.substr(0, size));
    bytes_.remove_prefix(size);
    return text;
  }

 private:
  template <class T>
  T take() {
    T value;
    if (bytes_.size() < sizeof value) throw std::runtime_error("a message between processes is cut short");
    std::memcpy(&value, bytes_.data(), sizeof value);
    bytes_.remove_prefix(sizeof value);
    return value;
  }
  std::string_view bytes_;
};

std::string to_message(const Chunk& chunk);
Chunk chunk_from(std::string_view bytes);
std::string to_message(const std::vector<PointResult>& results);
std::vector<PointResult> results_from(std::string_view bytes);

}  // namespace earthtop::study
