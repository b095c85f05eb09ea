// SPDX-License-Identifier: GPL-3.0-or-later
/// Collects all errors and warnings of a document before an exception is thrown.
#pragma once

#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "earthtop/error.hpp"
#include "input/node.hpp"

namespace earthtop::input {

/// Number of diagnostics shown; one more says how many were left out.
inline constexpr std::size_t kMostDiagnostics = 20;
/// Number of findings kept for sorting. Rules go through the text from front to back, so the findings to be shown are among the
/// first ones found. A hostile file can have many thousands; further ones are only counted.
inline constexpr std::size_t kMostKept = 100;

class Findings {
 public:
  void add(Place place, std::string pointer, std::string message);
  /// Adds the error that a key is given twice; the message names both places.
  void add_duplicate(Place again, Place first, std::string pointer);
  bool empty() const { return count_ == 0; }
  std::size_t count() const { return count_; }                 ///< number of errors
  bool full() const { return findings_.size() >= kMostKept; }  ///< whether further findings are only counted

  /// The values that are put into the text from now on are the program's own: findings on them do not name the option --set.
  void leave_out_option() { names_option_ = false; }

  /// Notes a key that an unknown key probably meant, so that it is not also reported as missing.
  void expect(std::string pointer) { expected_.insert(std::move(pointer)); }
  bool expected(const std::string& pointer) const { return expected_.contains(pointer); }

  /// Adds a warning about a value that is allowed, but looks like a mistake.
  void warn(Place place, std::string pointer, std::string message);

  /// Returns the errors sorted by position, with lines and columns (1-based, in bytes) counted in `text`. Errors of --set come
  /// first, at line 0. There are at most 20, and one more that says how many were left out.
  std::vector<Diagnostic> errors(std::string_view text) const { return report(findings_, count_, "errors", text); }
  std::vector<Diagnostic> warnings(std::string_view text) const {
    return report(warnings_, warnings_.size(), "warnings", text);
  }

 private:
  struct Finding {
    Place place;
    std::string pointer;
    std::string message;
    std::optional<Place> first;  // first place of a duplicate key
  };
  void keep(Finding finding);
  std::vector<Diagnostic> report(std::vector<Finding> sorted, std::size_t count, std::string_view kind,
                                 std::string_view text) const;
  std::vector<Finding> findings_;
  std::vector<Finding> warnings_;
  std::size_t count_ = 0;
  bool names_option_ = true;
  std::set<std::string> expected_;
};

}  // namespace earthtop::input
