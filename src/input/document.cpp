// SPDX-License-Identifier: GPL-3.0-or-later
#include "input/document.hpp"

#include <fmt/core.h>

#include <nlohmann/json.hpp>

#include "earthtop/error.hpp"
#include "input/reader.hpp"
#include "text/json.hpp"

namespace earthtop::input {
namespace {

constexpr bool kHasComments = false;

}  // namespace

nlohmann::ordered_json read_document(std::string_view text, const std::string& file, const DocumentKind& kind) {
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  Findings findings;
  if (text.empty()) findings.add({}, "", fmt::format("is empty; a {} is an object {{...}}", kind.noun));
  JsonKind outermost = JsonKind::object;
  if (findings.empty())
    check_json(text, findings, {kind.noun, kind.most_MiB << 20U, kind.most_values, kMostMembers, kHasComments}, outermost);
  if (findings.empty() && outermost != JsonKind::object)
    findings.add({}, "", fmt::format("the text is {}; a {} is an object {{...}}", name_of(outermost), kind.noun));
  if (!findings.empty()) throw ScenarioError(findings.errors(text), file);
  return json_of_checked(text);
}

}  // namespace earthtop::input
