// SPDX-License-Identifier: GPL-3.0-or-later
// Makes the summary, or a part of it, from the table of its members, and the timing.
#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <chrono>
#include <ctime>
#include <nlohmann/json.hpp>

#include "earthtop/results/results.hpp"
#include "results/digits.hpp"
#include "results/figures.hpp"
#include "text/json.hpp"
#include "text/utf8.hpp"

namespace earthtop {
namespace {

using Json = nlohmann::ordered_json;

const Json kNothing = Json(Json::value_t::discarded);

bool is_holder(const SummaryMember& member) { return member.form == MemberForm::object || member.form == MemberForm::list; }

/// Removes the first step of a dotted path, and returns it.
std::string_view take_step(std::string_view& path) {
  const std::size_t dot = path.find('.');
  const std::string_view step = path.substr(0, dot);
  path.remove_prefix(dot == path.npos ? path.size() : dot + 1);
  return step;
}

/// The relation of a path to a member's path, in which a star stands for any step: the path lies apart from the member, above
/// it, at it, or below it.
enum class Relation { apart, above, same, below };
Relation relation(std::string_view path, std::string_view member) {
  while (!path.empty() && !member.empty()) {
    const std::string_view wanted = take_step(member);
    if (take_step(path) != wanted && wanted != "*") return Relation::apart;
  }
  if (path.empty() && member.empty()) return Relation::same;
  return path.empty() ? Relation::above : Relation::below;
}

/// The document with every number replaced by null.
Json without_numbers(Json json) {
  if (json.is_number()) return nullptr;
  for (Json& part : json)
    if (part.is_structured() || part.is_number()) part = without_numbers(std::move(part));
  return json;
}

/// A member's value in a result, or an empty object or list without the members that it holds; a discarded value where the
/// member is left out.
Json own_value(const SummaryMember& member, const RunResult& result, std::size_t element, bool has_numbers) {
  if (!is_holder(member)) {
    Json value = member.value(result, element);
    return has_numbers ? value : without_numbers(std::move(value));
  }
  const std::optional<std::size_t> count = member.count(result);
  if (!count) return member.left_out ? kNothing : Json();
  return member.form == MemberForm::object ? Json::object() : Json(*count, Json::object());
}

/// Puts a member into a document. @param path  the rest of the member's path, below `at`
void put(Json& at, std::string_view path, const SummaryMember& member, const RunResult& result, std::size_t element,
         bool has_numbers) {
  const std::string_view step = take_step(path);
  if (path.empty()) {
    Json value = own_value(member, result, element, has_numbers);
    if (!value.is_discarded()) at[std::string(step)] = std::move(value);
  } else if (step == "*") {
    for (std::size_t i = 0; i < at.size(); ++i) put(at[i], path, member, result, i, has_numbers);
  } else if (const auto holder = at.find(step); holder != at.end() && holder->is_structured()) {
    put(*holder, path, member, result, element, has_numbers);
  }
}

/// The summary with those of its members that are wanted. @param wanted  whether a member is needed
template <class Wanted>
Json document_of(const RunResult& result, const Wanted& wanted) {
  Json document = Json::object();
  bool has_numbers = true;
  for (const SummaryMember& member : summary_members()) {
    if (member.path.find('.') == std::string_view::npos) has_numbers = !member.of_rows || has_drift(result);
    if (wanted(member)) put(document, member.path, member, result, 0, has_numbers);
  }
  return document;
}

/// The number of a list's element from a step of a path; none where the step is not a number.
std::optional<std::size_t> element_number(std::string_view step) {
  std::size_t number = 0;
  const auto [end, error] = std::from_chars(step.data(), step.data() + step.size(), number);
  return error == std::errc() && end == step.data() + step.size() ? std::optional(number) : std::nullopt;
}

/// Writes JSON as text. Bytes of a user's text that are not UTF-8 become U+FFFD, instead of an exception.
std::string dump(const Json& json) { return json_with_escapes(written_replacing(json, 2)) + '\n'; }

std::string host_name() {
  char name[256] = {};
  return gethostname(name, sizeof name - 1) == 0 ? name : "unknown";
}

std::string utc_now() {
  const std::time_t now = std::chrono::system_clock::to_time_t(std::chrono::system_clock::now());
  std::tm utc{};
  gmtime_r(&now, &utc);
  char text[32];
  return std::string(text, std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &utc));
}

}  // namespace

const SummaryMember* find_member(std::string_view path) {
  for (const SummaryMember& member : summary_members()) {
    const Relation to_member = relation(path, member.path);
    if (to_member == Relation::same || (to_member == Relation::below && !is_holder(member))) return &member;
  }
  return nullptr;
}

bool is_known_at_the_end(std::string_view path) {
  const auto members = summary_members();
  return std::all_of(members.begin(), members.end(), [&](const SummaryMember& member) {
    const Relation to_member = relation(path, member.path);
    if (to_member == Relation::same && member.form != MemberForm::value)
      return member.form == MemberForm::words || member.form == MemberForm::list;
    return to_member == Relation::apart || is_holder(member) || member.known == KnownFrom::end;
  });
}

Json summary_part(const RunResult& result, std::string_view path) {
  // Most members already differ in their first letter.
  const Json document = document_of(result, [&](const SummaryMember& member) {
    return !path.empty() && member.path.front() == path.front() && relation(path, member.path) != Relation::apart;
  });
  const Json* at = &document;
  while (!path.empty()) {
    const std::string_view step = take_step(path);
    if (at->is_array()) {
      const auto number = element_number(step);
      if (!number || *number >= at->size()) return {};
      at = &(*at)[*number];
    } else {
      const auto member = at->is_object() ? at->find(step) : at->end();
      if (!at->is_object() || member == at->end()) return {};
      at = &*member;
    }
  }
  return *at;
}

std::string summary_json(const RunResult& result) {
  return dump(document_of(result, [](const SummaryMember&) { return true; }));
}

std::string matching_rule(const Scenario& scenario) {
  return scenario.release.rates_relative_to == RatesRelativeTo::laboratory
             ? "same attitude and same rates relative to the laboratory at release"
             : "same attitude and same rates relative to inertial space at release";
}

std::optional<DriftDigits> drift_digits(const RunResult& result) {
  if (result.extended_rows.empty() || !has_drift(result)) return std::nullopt;
  const auto in_full = [&](float128 value) { return digits(value, result.scene.scenario().precision); };
  float128 axis_max = result.extended_axis_max_rad;
  for (const ExtendedDriftRow& row : result.extended_rows) axis_max = std::max(axis_max, row.drift_axis_rad);
  const ExtendedDriftRow& last = result.extended_rows.back();
  return DriftDigits{in_full(last.drift_axis_rad), in_full(axis_max), in_full(last.drift_attitude_rad),
                     in_full(last.drift_spin_rad)};
}

std::string timing_json(const RunResult& result) {
  return dump({{"solution_s", result.solution.seconds},
               {"certificate_s", result.certificate.seconds},
               {"looks_s", result.looks_seconds},
               {"selection_s", result.selection ? Json(result.selection->seconds) : Json()},
               {"written_utc", utc_now()},
               {"host", host_name()}});
}

}  // namespace earthtop
