// SPDX-License-Identifier: GPL-3.0-or-later
/// The codec that writes the keys of keys.hpp to a JSON object.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>

#include "scenario/rules.hpp"

namespace earthtop::scenario {

class Writing {
 public:
  using Json = nlohmann::json;  // sorts keys; writes the shortest digits that read back exactly
  static constexpr bool kWrites = true;
  explicit Writing(Json& json) : json_(json) {}

  bool takes(std::string_view /*key*/, bool held) const { return held; }
  bool takes_array(std::string_view /*key*/, bool held) const { return held; }

  template <class T>
  void key(std::string_view key, const T& member) {
    json_[std::string(key)] = member;
  }
  template <class T>
  void key(std::string_view key, const std::optional<T>& member) {
    if (member) this->key(key, *member);
  }
  template <class T>
  void sparse(std::string_view key, const T& member) {
    if (!(member == T{})) this->key(key, member);
  }

  template <class E, class Rows>
  void word(std::string_view key, const E& member, const Rows& rows) {
    json_[std::string(key)] = std::string(row_of(rows, member).word);
  }
  template <class E>
  void named(std::string_view key, const E& member) {
    json_[std::string(key)] = std::string(to_string(member));
  }
  template <class E>
  void named(std::string_view key, const std::optional<E>& member) {
    if (member) named(key, *member);
  }
  void yes(std::string_view key) { json_[std::string(key)] = true; }
  void literal(std::string_view key, std::string_view word) { json_[std::string(key)] = std::string(word); }

  /// Writes an object below a key, or nothing if the object would be empty.
  template <class Keys>
  void object(std::string_view key, bool held, Keys keys) {
    if (!held) return;
    Json object = Json::object();
    Writing below(object);
    keys(below);
    if (!object.empty()) json_[std::string(key)] = std::move(object);
  }
  template <class T>
  bool switched(std::string_view /*key*/, const std::optional<T>& member) {
    return member.has_value();
  }
  template <class List, class Keys>
  void list(std::string_view key, const List& members, Keys keys) {
    if (members.empty()) return;
    Json list = Json::array();
    for (const auto& member : members) {
      Writing element(list.emplace_back(Json::object()));
      keys(element, member);
    }
    json_[std::string(key)] = std::move(list);
  }

 private:
  Json& json_;
};

}  // namespace earthtop::scenario
