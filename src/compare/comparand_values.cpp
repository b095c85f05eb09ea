// SPDX-License-Identifier: GPL-3.0-or-later
// Apart from the reading of files, so that the values of a summary can be had without it.
#include <cmath>
#include <nlohmann/json.hpp>

#include "compare/comparand.hpp"

namespace earthtop::compare {

Document::Document() : Document(Json()) {}
Document::Document(Json json) : json_(std::make_shared<const Json>(std::move(json))) {}

std::optional<double> Comparand::number(const std::string& pointer) const {
  const Json::json_pointer at(pointer);
  if (!summary->is_object() || !summary->contains(at) || !summary->at(at).is_number()) return std::nullopt;
  const auto value = summary->at(at).get<double>();
  return std::isfinite(value) ? std::optional(value) : std::nullopt;
}

std::string Comparand::word(const std::string& pointer) const {
  const Json::json_pointer at(pointer);
  return summary->is_object() && summary->contains(at) && summary->at(at).is_string() ? summary->at(at).get<std::string>() : "";
}

std::optional<double> Comparand::seconds() const {
  double sum = 0;
  for (const char* part : {"solution_s", "certificate_s"}) {
    if (!timing->is_object() || !timing->contains(part) || !timing->at(part).is_number()) return std::nullopt;
    sum += timing->at(part).get<double>();
  }
  return sum;
}

bool Comparand::has_summary() const { return summary->is_object(); }

}  // namespace earthtop::compare
