// SPDX-License-Identifier: GPL-3.0-or-later
/// Everything that is wrong with a document, collected before anything is thrown.
#pragma once

#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "earthtop/error.hpp"
#include "input/node.hpp"

namespace earthtop::input {

/// Diagnostics shown; one more says how many were left out.
inline constexpr std::size_t kMostDiagnostics = 20;
/// Findings kept for sorting. Rules run through the text from front to back, so the first ones found hold the first ones to
/// show; a hostile file can have many thousands, which are only counted.
inline constexpr std::size_t kMostKept = 2000;

class Findings {
 public:
  void add(Place place, std::string pointer, std::string message);
  /// A key given again; both places are named.
  void add_duplicate(Place again, Place first, std::string pointer);
  bool empty() const { return count_ == 0; }
  std::size_t count() const { return count_; }                 ///< of errors
  bool full() const { return findings_.size() >= kMostKept; }  ///< further ones are only counted

  /// A key that an unknown key probably meant: it is not reported as missing as well.
  void expect(std::string pointer) { expected_.insert(std::move(pointer)); }
  bool expected(const std::string& pointer) const { return expected_.contains(pointer); }

  /// Notes a value that is not wrong, but looks like a mistake.
  void warn(Place place, std::string pointer, std::string message);

  /// Sorted by position, with lines and columns (1-based, in bytes) counted in `text`; what comes from --set stands first,
  /// at line 0. At most 20, then one more that says how many were left out.
  std::vector<Diagnostic> errors(std::string_view text) const { return report(findings_, count_, "errors", text); }
  std::vector<Diagnostic> warnings(std::string_view text) const {
    return report(warnings_, warnings_.size(), "warnings", text);
  }

 private:
  struct Finding {
    Place place;
    std::string pointer;
    std::string message;
    std::optional<Place> first;  // of a duplicate key
  };
  void keep(Finding finding);
  static std::vector<Diagnostic> report(std::vector<Finding> sorted, std::size_t count, std::string_view kind,
                                        std::string_view text);
  std::vector<Finding> findings_;
  std::vector<Finding> warnings_;
  std::size_t count_ = 0;
  std::set<std::string> expected_;
};

}  // namespace earthtop::input
