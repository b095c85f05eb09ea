// SPDX-License-Identifier: GPL-3.0-or-later
// Decodes a study file into a `Study`.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>

#include "earthtop/study/study.hpp"
#include "input/check.hpp"
#include "input/pointers.hpp"
#include "input/reader.hpp"
#include "input/section.hpp"
#include "results/figures.hpp"
#include "scenario/fields.hpp"
#include "study/fields.hpp"
#include "study/json_text.hpp"

namespace earthtop {
namespace study {
namespace {

using namespace input;

constexpr std::size_t kMostAxes = 20;  // GSL's Sobol sequence has 40 dimensions; Sobol indices need two per axis
constexpr std::uint64_t kMostSobolPoints = (std::uint64_t{1} << 30U) - 1;  // GSL's sequence then ends
constexpr std::size_t kMostQuantities = 200;
constexpr std::size_t kLongestColumn = 200;  // bytes of a quantity's name

/// A node of the study file, with its JSON pointer and the list to which errors are added.
struct Given {
  const Node& node;
  std::string pointer;
  Findings& findings;
  void refuse(std::string message) const { findings.add(node.place, pointer, std::move(message)); }
  Given element(std::size_t i) const { return {node.children[i], fmt::format("{}/{}", pointer, i), findings}; }
};

bool is_column_name(std::string_view text) {
  return !text.empty() && text.size() <= 64 && text.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789_") == text.npos;
}

bool is_pointer(std::string_view text) { return text.size() > 1 && text.front() == '/'; }

/// One number for each pointer, from a single number that holds for all, or from an array with one for each.
std::optional<std::vector<double>> end_of_range(const Given& end, std::size_t pointers) {
  if (end.node.kind == JsonKind::number) return std::vector<double>(pointers, end.node.number);
  if (end.node.kind == JsonKind::refused) return std::nullopt;
  std::vector<double> numbers;
  for (const Node& child : end.node.children)
    if (child.kind == JsonKind::number) numbers.push_back(child.number);
  if (end.node.kind == JsonKind::array && numbers.size() == end.node.children.size() && numbers.size() == pointers)
    return numbers;
  end.refuse(fmt::format("must be a number{}",
                         pointers > 1 ? fmt::format(", or an array of {}, one for each pointer", pointers) : ""));
  return std::nullopt;
}

class Decoder {
 public:
  Decoder(const ScenarioSource& source, const std::optional<ScenarioSource>& base, Findings& findings)
      : source_(source), base_(base), findings_(findings) {}

  Study decode(const Section& root) {
    decode_name(root);
    for (auto [key, text] :
         {std::pair("title", &study_.title), std::pair("purpose", &study_.purpose), std::pair("finding", &study_.finding)})
      *text = root.word(key).value_or("");
    if (root.require("base")) decode_base(root);
    if (const Node* set = root.any("set")) decode_set({*set, "/set", findings_});
    decode_design(root.section("design"));
    if (root.require("axes")) {
      for (std::size_t i = 0; i < std::min(root.size("axes"), kMostAxes); ++i) decode_axis(root.element("axes", i), i);
      if (root.size("axes") > kMostAxes) root.refuse("axes", fmt::format("more than {} axes", kMostAxes));
    }
    decode_quantities(root);
    study_.needed_rows_only = root.word("rows").value_or("needed") == "needed";
    for (std::size_t i = 0; i < root.size("fits"); ++i) decode_fit(root.element("fits", i));
    for (std::size_t i = 0; i < root.size("figures"); ++i) decode_figure(root.element("figures", i));
    const Section limits = root.section("limits");
    study_.limits.points = static_cast<std::uint64_t>(limits.number("points").value_or(1));
    study_.limits.core_hours = limits.number("core_hours").value_or(1);
    study_.limits.disk_gb = limits.number("disk_gb").value_or(1);
    study_.limits.stops_beyond_estimate = limits.flag("stops_beyond_estimate").value_or(true);
    return std::move(study_);
  }

 private:
  void decode_name(const Section& root) {
    if (const auto name = root.word("name")) {
      study_.name = *name;
    } else if (!root.has("name") && source_.file != "<stdin>") {
      const std::string stem = std::filesystem::path(source_.file).stem().string();
      if (is_name(stem))
        study_.name = stem;
      else
        root.missing("name", fmt::format("is missing, and the file's stem \"{}\" is not a name; give a name", excerpt(stem)));
    }
  }

  void decode_base(const Section& root) {
    const Node* base = root.any("base");
    if (!base) return;
    if (base_) {
      study_.base = *base_;
      return;
    }
    namespace fs = std::filesystem;
    if (base->kind == JsonKind::object) {
      study_.base = {source_.file, json_text(*base)};
      study_.base_inside = true;
    } else if (base->kind == JsonKind::string && !base->text.empty() && base->text != "-") {
      const fs::path beside = fs::path(source_.file).parent_path() / base->text;
      try {
        study_.base = read_scenario_source(beside.string());
      } catch (const ScenarioError& error) {
        root.refuse("base", fmt::format("{}: {}", printable(beside.string()), error.diagnostics().front().message));
      }
    } else {
      root.refuse("base", "must be a scenario file's path, or a scenario {...}");
    }
  }

  void decode_set(const Given& set) {
    if (set.node.kind != JsonKind::object) return set.refuse("must be an object of JSON pointers and values");
    for (const Node& change : set.node.children) {
      if (is_comment(change.key) && !is_pointer(change.key)) continue;
      if (change.key.starts_with("//")) continue;
      if (!is_pointer(change.key))
        findings_.add(change.key_place, set.pointer + pointer_step(change.key),
                      "is not a JSON pointer; write e.g. /motion/duration_s");
      else if (const auto fault = base_ ? std::nullopt : pointer_target(scenario::fields(), change.key).fault)
        findings_.add(change.key_place, set.pointer + pointer_step(change.key), *fault);
      else
        study_.set.emplace_back(change.key, json_text(change));
    }
  }

  void decode_design(const Section& design) {
    StudyDesign& d = study_.design;
    const std::string kind = design.word("kind").value_or("grid");
    for (const DesignKind candidate :
         {DesignKind::grid, DesignKind::random, DesignKind::latin_hypercube, DesignKind::sobol, DesignKind::one_at_a_time})
      if (to_string(candidate) == kind) d.kind = candidate;
    drawn_ = d.kind != DesignKind::grid && d.kind != DesignKind::one_at_a_time;
    d.seed = whole(design, "seed").value_or(1);
    d.indices = design.flag("indices").value_or(false);
    if (drawn_ && !design.has("points")) design.missing("points", "is missing; a drawn design needs their number");
    if (!drawn_ && design.has("points")) design.refuse_key("points", fmt::format("belongs to a drawn design, not to {}", kind));
    if (!drawn_ && design.has("seed")) design.refuse_key("seed", fmt::format("belongs to a drawn design, not to {}", kind));
    if (d.indices && d.kind != DesignKind::sobol && d.kind != DesignKind::random)
      design.refuse_key("indices", "belongs to the designs sobol and random");
    d.points = whole(design, "points").value_or(0);
    if (d.kind == DesignKind::sobol && d.points > kMostSobolPoints)
      design.refuse("points",
                    fmt::format("{} is too large: a Sobol sequence has {} points; take fewer, or another kind of design",
                                d.points, kMostSobolPoints));
  }

  static std::optional<std::uint64_t> whole(const Section& section, std::string_view key) {
    const auto number = section.number(key);
    if (!number) return std::nullopt;
    if (*number != std::floor(*number)) section.refuse(key, fmt::format("{} is not a whole number", *number));
    return static_cast<std::uint64_t>(*number);
  }

  void decode_axis(const Section& axis, std::size_t index) {
    if (!axis.present()) return;
    StudyAxis decoded;
    const std::string where = fmt::format("/axes/{}", index);
    if (axis.has("pointer") == axis.has("pointers")) {
      axis.missing("pointer", "give either pointer or pointers");
      return;
    }
    if (const auto pointer = axis.word("pointer")) decoded.pointers = {*pointer};
    if (const Node* list = axis.any("pointers")) {
      for (const Node& child : list->children) decoded.pointers.push_back(child.text);
      if (list->kind != JsonKind::array || decoded.pointers.empty())
        axis.refuse("pointers", "must be an array of JSON pointers");
    }
    for (const std::string& pointer : decoded.pointers)
      if (!is_pointer(pointer)) {
        axis.refuse(axis.has("pointer") ? "pointer" : "pointers",
                    fmt::format("\"{}\" is not a JSON pointer; write e.g. /site/latitude_deg", excerpt(pointer)));
        return;
      } else if (!pointers_.insert(pointer).second) {
        axis.refuse(axis.has("pointer") ? "pointer" : "pointers", fmt::format("{} is varied twice", excerpt(pointer)));
      } else if (const auto fault = base_ ? std::nullopt : pointer_target(scenario::fields(), pointer).fault) {
        axis.refuse(axis.has("pointer") ? "pointer" : "pointers", fmt::format("{}: {}", excerpt(pointer, 200), *fault));
      }
    if (decoded.pointers.empty()) return;
    const std::string& first = decoded.pointers.front();
    decoded.name = axis.word("name").value_or(first.substr(first.rfind('/') + 1));
    if (!is_column_name(decoded.name) || !columns_.insert(decoded.name).second)
      axis.refuse(axis.has("name") ? "name" : "pointer",
                  fmt::format("\"{}\" cannot name a column: 1 to 64 of a-z, 0-9 and _, no name twice; give a name",
                              excerpt(decoded.name)));
    const int kinds = int(axis.has("values")) + int(axis.has("range")) + int(axis.has("log_range"));
    if (kinds != 1) return axis.missing("values", "give one of values, range and log_range");
    if (const Node* values = axis.any("values")) decode_levels({*values, where + "/values", findings_}, decoded);
    if (axis.has("range")) decode_range(axis.section("range"), where + "/range", false, decoded);
    if (axis.has("log_range")) decode_range(axis.section("log_range"), where + "/log_range", true, decoded);
    study_.axes.push_back(std::move(decoded));
  }

  void decode_levels(const Given& values, StudyAxis& axis) {
    if (values.node.kind != JsonKind::array || values.node.children.empty()) return values.refuse("must be an array of values");
    axis.levels.reserve(values.node.children.size());
    for (std::size_t i = 0; i < values.node.children.size(); ++i) {
      const Given value = values.element(i);
      if (axis.pointers.size() > 1 && value.node.kind == JsonKind::array) {
        if (value.node.children.size() != axis.pointers.size()) {
          value.refuse(
              fmt::format("has {} values; must be {}, one for each pointer", value.node.children.size(), axis.pointers.size()));
          continue;
        }
        std::vector<std::string>& level = axis.levels.emplace_back();
        for (const Node& child : value.node.children) level.push_back(json_text(child));
      } else {
        axis.levels.emplace_back(axis.pointers.size(), json_text(value.node));
      }
    }
  }

  void decode_range(const Section& range, const std::string& where, bool logarithmic, StudyAxis& axis) {
    StudyAxis::Range decoded;
    decoded.logarithmic = logarithmic;
    for (const auto& [key, end] : {std::pair("from", &decoded.from), std::pair("to", &decoded.to)}) {
      if (!range.require(key)) return;
      const Node* node = range.any(key);
      const auto numbers =
          node ? end_of_range({*node, fmt::format("{}/{}", where, key), findings_}, axis.pointers.size()) : std::nullopt;
      if (!numbers) return;
      *end = *numbers;
    }
    for (std::size_t i = 0; logarithmic && i < decoded.from.size(); ++i)
      if (!(decoded.from[i] * decoded.to[i] > 0)) {
        range.refuse("from", "equal ratios need ends of one sign, neither of them 0");
        break;
      }
    decoded.points = whole(range, "points").value_or(0);
    if (!drawn_ && !range.has("points")) range.missing("points", "is missing; the design needs their number");
    axis.range = std::move(decoded);
  }

  void decode_quantities(const Section& root) {
    Node fallback;
    const Node* list = root.any("collect");
    if (!list) {
      Findings none;
      read_json(fields().find("/collect")->fallback, "", false, fallback, none);
      list = &fallback;
    }
    const Given given{*list, "/collect", findings_};
    if (list->kind != JsonKind::array || list->children.empty())
      return given.refuse("must be an array of paths in summary.json, e.g. [\"drift.axis_final_rad\"]");
    if (list->children.size() > kMostQuantities) return given.refuse(fmt::format("more than {} quantities", kMostQuantities));
    for (std::size_t i = 0; i < list->children.size(); ++i) decode_quantity(given.element(i));
  }

  void decode_quantity(const Given& given) {
    const Node& node = given.node;
    StudyQuantity quantity;
    if (node.kind == JsonKind::string) {
      const std::string path = summary_path(node.text);
      quantity = {node.text.starts_with('/') ? path : node.text, path};
    } else {
      const Node* name = node.kind == JsonKind::object ? node.find("name") : nullptr;
      const Node* path = node.kind == JsonKind::object ? node.find("path") : nullptr;
      if (path && path->kind == JsonKind::string)
        quantity = {name && name->kind == JsonKind::string ? name->text : path->text, summary_path(path->text)};
    }
    if (quantity.path.empty() || quantity.path.size() > 200)
      return given.refuse("must be a path in summary.json, e.g. \"drift.axis_final_rad\", or {\"name\": ..., \"path\": ...}");
    if (const auto fault = base_ ? std::nullopt : summary_path_fault(quantity.path)) return given.refuse(*fault);
    constexpr std::string_view kAllowed = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_.-";
    if (quantity.name.empty() || quantity.name.find_first_not_of(kAllowed) != std::string::npos)
      return given.refuse(fmt::format("\"{}\" cannot name a column: letters, digits, _, - and . only", excerpt(quantity.name)));
    if (quantity.name.size() > kLongestColumn)
      return given.refuse(fmt::format("\"{}\" has more than {} characters", excerpt(quantity.name), kLongestColumn));
    // SQLite does not tell capitals apart in the names of columns.
    std::string column = quantity.name;
    std::transform(column.begin(), column.end(), column.begin(),
                   [](char c) { return c >= 'A' && c <= 'Z' ? char(c + 32) : c; });
    if (!columns_.insert(column).second)
      return given.refuse(fmt::format("there is already a column \"{}\"; give another name", excerpt(quantity.name)));
    study_.quantities.push_back(std::move(quantity));
  }

  void decode_fit(const Section& fit) {
    if (!fit.present() || !fit.require("kind") || !fit.require("axis") || !fit.require("quantity")) return;
    StudyFit decoded;
    const std::string kind = fit.word("kind").value_or("");
    for (const FitKind candidate :
         {FitKind::linear, FitKind::sin_latitude, FitKind::cos_latitude, FitKind::logarithmic, FitKind::power_law})
      if (to_string(candidate) == kind) decoded.kind = candidate;
    decoded.axis = fit.word("axis").value_or("");
    decoded.quantity = fit.word("quantity").value_or("");
    if (std::none_of(study_.axes.begin(), study_.axes.end(), [&](const StudyAxis& a) { return a.name == decoded.axis; }))
      fit.refuse("axis", fmt::format("there is no axis \"{}\"", excerpt(decoded.axis)));
    if (std::none_of(study_.quantities.begin(), study_.quantities.end(),
                     [&](const StudyQuantity& q) { return q.name == decoded.quantity; }))
      fit.refuse("quantity", fmt::format("\"{}\" is not collected", excerpt(decoded.quantity)));
    study_.fits.push_back(std::move(decoded));
  }

  void decode_figure(const Section& figure) {
    if (!figure.present()) return;
    for (const auto* key : {"figure", "value", "tolerance", "origin"})
      if (!figure.require(key)) return;
    study_.figures.push_back({figure.word("figure").value_or(""), figure.number("value").value_or(0),
                              figure.number("tolerance").value_or(0), figure.word("origin").value_or("")});
  }

  const ScenarioSource& source_;
  const std::optional<ScenarioSource>& base_;
  Findings& findings_;
  Study study_;
  bool drawn_ = false;
  std::set<std::string> pointers_;
  std::set<std::string> columns_ = {"point", "number", "status", "reason", "scenario_sha256", "row_checksum"};
};

}  // namespace
}  // namespace study

std::string_view to_string(DesignKind kind) {
  switch (kind) {
    case DesignKind::grid: return "grid";
    case DesignKind::random: return "random";
    case DesignKind::latin_hypercube: return "latin_hypercube";
    case DesignKind::sobol: return "sobol";
    case DesignKind::one_at_a_time: return "one_at_a_time";
  }
  return "unknown";
}

std::string_view to_string(FitKind kind) {
  switch (kind) {
    case FitKind::linear: return "linear";
    case FitKind::sin_latitude: return "sin_latitude";
    case FitKind::cos_latitude: return "cos_latitude";
    case FitKind::logarithmic: return "logarithmic";
    case FitKind::power_law: return "power_law";
  }
  return "unknown";
}

Study parse_study(const ScenarioSource& source, const std::optional<ScenarioSource>& base) {
  using namespace input;
  Findings findings;
  std::string_view text = source.text;
  const Node root = read_checked(text, source.file, study::fields(), findings);
  Study decoded = study::Decoder(source, base, findings).decode(Section(root, findings, study::fields()));
  if (!findings.empty()) throw ScenarioError(findings.errors(text), source.file);
  decoded.text = source.text;
  return decoded;
}

}  // namespace earthtop
