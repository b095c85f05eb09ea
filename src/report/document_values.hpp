// SPDX-License-Identifier: GPL-3.0-or-later
/// Values of a document's members as they are put on a page; nothing where a member is missing or of another kind.
#pragma once

#include <string>

#include "report/html.hpp"

namespace earthtop::report {

inline std::string text_of(const Json& json, const char* key) {
  const Json value = json.value(key, Json());
  return value.is_string() ? value.get<std::string>() : "";
}

/// HTML of a number.
inline std::string number_of(const Json& json, const char* key, int digits = 3) {
  const Json value = json.value(key, Json());
  return value.is_number() ? number_html(value.get<double>(), "", digits) : "";
}

}  // namespace earthtop::report
