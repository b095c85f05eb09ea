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

/// Values are nothing where the key is missing without a default or has been refused already. Keys are those of the table.
class Section {
 public:
  /// The whole text.
  Section(const Node& root, Findings& findings, const FieldTable& table);

  Section section(std::string_view key) const;
  Section element(std::string_view key, std::size_t index) const;

  bool present() const { return node_ != nullptr; }
  bool has(std::string_view key) const { return node_ && node_->find(key); }
  bool is_object(std::string_view key) const { return has(key) && node_->find(key)->kind == JsonKind::object; }
  bool is_word(std::string_view key) const { return has(key) && node_->find(key)->kind == JsonKind::string; }
  /// Returns whether the key must stand wherever this object does.
  bool is_required(std::string_view key) const;
  std::size_t size(std::string_view key) const;  ///< elements of a list; 0 where it has been refused

  std::optional<double> number(std::string_view key) const;
  std::optional<bool> flag(std::string_view key) const;
  std::optional<std::string> word(std::string_view key) const;
  std::optional<std::vector<double>> numbers(std::string_view key) const;
  std::optional<std::vector<std::string>> changes(std::string_view key) const;
  const Node* any(std::string_view key) const;  ///< null where it is missing or refused
  std::optional<std::array<double, 3>> vector(std::string_view key) const;
  std::optional<std::array<std::array<double, 3>, 3>> matrix(std::string_view key) const;

  /// Complains about a key that stands there, at its value or at the key itself.
  void refuse(std::string_view key, std::string message) const;
  void refuse_key(std::string_view key, std::string message) const;
  /// Notes a value that is allowed, but looks like a mistake.
  void warn(std::string_view key, std::string message) const;
  /// Complains about a key that does not stand there, at the object; not where a misspelled key probably meant it.
  void missing(std::string_view key, std::string message) const;
  /// Complains as `missing` does where the key is not there. @returns whether it is there
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
  /// The node of a key, or of its default; null where there is neither or it has been refused.
  const Node* value(std::string_view key, Node& fallback) const;

  const Node* node_;  // null where the object is missing or refused
  Place place_;       // of the object, or of the one it is missing in
  bool refused_;
  std::string pointer_;
  std::string pattern_;  // the pointer with * for indices
  Findings* findings_;
  const FieldTable* table_;
};

}  // namespace earthtop::input
