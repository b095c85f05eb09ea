// SPDX-License-Identifier: GPL-3.0-or-later
#include "text/json.hpp"

#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

namespace earthtop {

using Json = nlohmann::ordered_json;

namespace {

constexpr int kOwnTypeError = 302;  // one of nlohmann's numbers

/// Builds a document from what nlohmann's parser finds.
class Builder {
 public:
  Json take() { return std::move(root_); }

  // NOLINTBEGIN: the names and types are nlohmann's.
  bool null() { return put(nullptr); }
  bool boolean(bool value) { return put(value); }
  bool number_integer(Json::number_integer_t value) { return put(value); }
  bool number_unsigned(Json::number_unsigned_t value) { return put(value); }
  bool number_float(Json::number_float_t value, const std::string&) { return put(value); }
  bool string(std::string& value) { return put(std::move(value)); }
  bool binary(Json::binary_t&) { return false; }
  bool start_object(std::size_t) { return open(Json::object()); }
  bool start_array(std::size_t) { return open(Json::array()); }
  bool key(std::string& key) {
    key_ = std::move(key);
    return true;
  }
  bool end_object() { return close(); }
  bool end_array() { return close(); }
  bool parse_error(std::size_t, const std::string&, const Json::exception&) { return false; }
  // NOLINTEND

 private:
  Json& add(Json value) {
    if (open_.empty()) return root_ = std::move(value);
    Json& parent = *open_.back();
    if (parent.is_array()) return parent.emplace_back(std::move(value));
    auto& members = static_cast<Json::object_t::Container&>(parent.get_ref<Json::object_t&>());
    return members.emplace_back(std::move(key_), std::move(value)).second;
  }
  bool put(Json value) {
    add(std::move(value));
    return true;
  }
  bool open(Json value) {
    open_.push_back(&add(std::move(value)));
    return true;
  }
  bool close() {
    open_.pop_back();
    return true;
  }

  Json root_;
  std::string key_;
  std::vector<Json*> open_;  // the containers around the next value; none of them grows before those in it are closed
};

}  // namespace

Json json_of(std::string_view text) { return Json::parse(text); }
Json json_of_checked(std::string_view text) {
  Builder builder;
  Json::sax_parse(text, &builder);
  return builder.take();
}

std::string written(const Json& json, int indent) { return json.dump(indent); }
std::string written_replacing(const Json& json, int indent) {
  return json.dump(indent, ' ', false, Json::error_handler_t::replace);
}

void refuse_value(const std::string& what) { throw Json::type_error::create(kOwnTypeError, what, nullptr); }

std::uint64_t count_in(const Json& json) {
  if (!json.is_number_unsigned()) refuse_value("not a whole number of at least 0");
  return json.get<std::uint64_t>();
}

std::string complaint_of(const std::exception& error) {
  const std::string what = error.what();  // "[json.exception.out_of_range.403] key 'drift' not found"
  const auto end = what.find("] ");
  const std::string said = end == what.npos ? "" : what.substr(end + 2);
  constexpr int kNoSuchKey = 403;
  const auto quote = said.find('\'');
  const auto* json = dynamic_cast<const Json::exception*>(&error);
  const int id = json == nullptr ? 0 : json->id;
  if (id == kNoSuchKey) return "a member is missing: " + said.substr(quote + 1, said.rfind('\'') - quote - 1);
  // Its own complaints of types are about C++; those that earthtop makes are whole sentences.
  const bool is_own = id == kOwnTypeError && !said.starts_with("type must be");
  return is_own ? said : "a value is of another kind, or a list has another length";
}

Json or_nothing(const std::optional<double>& number) { return number ? Json(*number) : Json(nullptr); }

}  // namespace earthtop
