// SPDX-License-Identifier: GPL-3.0-or-later
/// The codec that reads the keys of keys.hpp from a checked section.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "input/section.hpp"
#include "scenario/rules.hpp"

namespace earthtop::scenario {

/// Reads the keys of a section into members. A member keeps its value if its key has been refused, or is missing and has no
/// default.
class Reading {
 public:
  static constexpr bool kWrites = false;
  explicit Reading(const input::Section& section) : section_(section) {}

  /// Returns whether no requested key is missing or has been refused.
  bool complete() const { return complete_ && section_.present(); }

  /// Returns whether the text uses the variant with this key. @param held  whether the members do; only `Writing` uses it
  bool takes(std::string_view key, bool /*held*/) const { return section_.has(key); }
  /// The same, of a key that takes a number or an array.
  bool takes_array(std::string_view key, bool /*held*/) const { return section_.is_array(key); }
  bool is_object(std::string_view key) const { return section_.is_object(key); }
  bool is_word(std::string_view key) const { return section_.is_word(key); }

  template <class T>
  void key(std::string_view key, T& member) {
    if (section_.is_required(key)) section_.require(key);
    if (auto value = value_of(key, member))
      member = *std::move(value);
    else if (section_.has(key) || section_.is_required(key) || !section_.present())
      complete_ = false;
  }
  /// Reads a key that `Writing` leaves out if its member is 0 or empty.
  template <class T>
  void sparse(std::string_view key, T& member) {
    this->key(key, member);
  }

  /// Reads a word that stands for a value: `word` uses the words of the rows, `named` those of `to_string`.
  template <class E, class Rows>
  void word(std::string_view key, E& member, const Rows& rows) {
    std::string word;
    this->key(key, word);
    if (!word.empty()) member = row_of_word(rows, word).value;
  }
  template <class E>
  void named(std::string_view key, E& member) {
    std::string word;
    this->key(key, word);
    if (word.empty()) return;        // to_string of what is not an enumerator is empty, too
    constexpr int kMostValues = 64;  // enumerators count from 0, and no enumeration has more
    for (int i = 0; i < kMostValues; ++i)
      if (to_string(static_cast<E>(i)) == word) member = static_cast<E>(i);
  }
  template <class E>
  void named(std::string_view key, std::optional<E>& member) {
    if (section_.word(key)) named(key, member.emplace());
  }
  /// `yes` and `literal` write true or a word in place of an object; for reading they do nothing.
  void yes(std::string_view) {}
  void literal(std::string_view, std::string_view) {}

  /// Reads the keys below a key if its value is an object. @param held  as for `takes`
  template <class Keys>
  void object(std::string_view key, bool /*held*/, Keys keys) {
    if (!section_.is_object(key)) return;
    Reading below(section_.section(key));
    keys(below);
    complete_ = complete_ && below.complete();
  }
  /// Reads an object, true or a word that switches something on. @returns whether it is on
  template <class T>
  bool switched(std::string_view key, std::optional<T>& member) {
    const bool on = section_.is_object(key) || section_.is_word(key) || section_.flag(key).value_or(false);
    if (on && !member) member.emplace();
    return on;
  }

 private:
  std::optional<double> value_of(std::string_view key, double) { return section_.number(key); }
  std::optional<bool> value_of(std::string_view key, bool) { return section_.flag(key); }
  std::optional<std::string> value_of(std::string_view key, const std::string&) { return section_.word(key); }
  std::optional<std::array<double, 2>> value_of(std::string_view key, const std::array<double, 2>&) {
    return section_.pair(key);
  }
  std::optional<std::array<double, 3>> value_of(std::string_view key, const std::array<double, 3>&) {
    return section_.vector(key);
  }
  std::optional<std::array<std::array<double, 3>, 3>> value_of(std::string_view key,
                                                               const std::array<std::array<double, 3>, 3>&) {
    return section_.matrix(key);
  }
  std::optional<std::vector<double>> value_of(std::string_view key, const std::vector<double>&) {
    return section_.numbers(key);
  }
  std::optional<std::vector<std::array<double, 3>>> value_of(std::string_view key, const std::vector<std::array<double, 3>>&) {
    return section_.points(key);
  }
  std::optional<std::vector<std::string>> value_of(std::string_view key, const std::vector<std::string>&) {
    return section_.changes(key);
  }
  template <class T>
  std::optional<T> value_of(std::string_view key, const std::optional<T>&) {
    return value_of(key, T{});
  }

  input::Section section_;
  bool complete_ = true;
};

}  // namespace earthtop::scenario
