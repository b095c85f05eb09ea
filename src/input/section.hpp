// SPDX-License-Identifier: GPL-3.0-or-later
/// A typed view of one object of a checked tree, with the defaults of the table of fields.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "input/fields.hpp"
#include "input/findings.hpp"
#include "input/node.hpp"

namespace earthtop::input {

/// A typed view of one object. A value is empty if its key has been refused, or is missing and has no default. Keys must be in
/// the table.
class Section {
 public:
  /// Makes the section of the whole text.
  Section(const Node& root, Findings& findings, const FieldTable& table);

  Section section(std::string_view key) const;
  Section element(std::string_view key, std::size_t index) const;

  bool present() const { return node_ != nullptr; }
  bool has(std::string_view key) const { return node_ && node_->find(key); }
  bool is_object(std::string_view key) const { return has(key) && node_->find(key)->kind == JsonKind::object; }
  bool is_array(std::string_view key) const { return has(key) && node_->find(key)->kind == JsonKind::array; }
  bool is_word(std::string_view key) const { return has(key) && node_->find(key)->kind == JsonKind::string; }
  /// Returns whether the key is required wherever this object is given.
  bool is_required(std::string_view key) const;
  std::size_t size(std::string_view key) const;  ///< number of elements of a list; 0 if it has been refused

  std::optional<double> number(std::string_view key) const;
  std::optional<bool> flag(std::string_view key) const;
  std::optional<std::string> word(std::string_view key) const;
  std::optional<std::vector<double>> numbers(std::string_view key) const;
  std::optional<std::vector<std::array<double, 3>>> points(std::string_view key) const;
  std::optional<std::vector<std::string>> changes(std::string_view key) const;
  const Node* any(std::string_view key) const;  ///< the key's node; null if it is missing or refused
  std::optional<std::array<double, 2>> pair(std::string_view key) const;
  std::optional<std::array<double, 3>> vector(std::string_view key) const;
  std::optional<std::array<std::array<double, 3>, 3>> matrix(std::string_view key) const;

  /// Adds an error about a key that is given, placed at its value or at the key itself.
  void refuse(std::string_view key, std::string message) const;
  void refuse_key(std::string_view key, std::string message) const;
  /// Adds a warning about a value that is allowed, but looks like a mistake.
  void warn(std::string_view key, std::string message) const;
  /// Adds an error about a missing key, placed at the object, unless a misspelled key probably meant it.
  void missing(std::string_view key, std::string message) const;
  /// Returns whether a misspelled key probably meant this one.
  bool expects(std::string_view key) const;
  /// Adds an error as `missing` does if the key is not given. @returns whether it is given
  bool require(std::string_view key) const;

  const std::string& pointer() const { return pointer_; }

 private:
  Section(const Node* node, Place place, bool refused, std::string pointer, std::string pattern, Findings& findings,
          const FieldTable& table)
      : node_(node),
        place_(place),
        refused_(refused),
        pointer_(std::move(pointer)),
        pattern_(std::move(pattern)),
        findings_(&findings),
        table_(&table) {}
  template <class Get>
  auto read(std::string_view key, Get get) const;
  /// Returns the node of a key, or of its default; null if there is neither or it has been refused.
  const Node* value(std::string_view key, Node& fallback) const;

  const Node* node_;  // null if the object is missing or refused
  Place place_;       // place of the object, or of the parent in which it is missing
  bool refused_;
  std::string pointer_;
  std::string pattern_;  // the pointer with * for indices
  Findings* findings_;
  const FieldTable* table_;
};

}  // namespace earthtop::input
