// SPDX-License-Identifier: GPL-3.0-or-later
// The doors of typed documents and tables that the user writes: scenarios, tables of angles, studies, mappings, tolerances,
// measured motions and other programs' motions.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <utility>

#include "compare/mapping.hpp"
#include "compare/row_source.hpp"
#include "earthtop/compare/compare.hpp"
#include "earthtop/frames/angle_spline.hpp"
#include "earthtop/measure/measurement.hpp"
#include "earthtop/scene/scene.hpp"
#include "fuzz/door.hpp"
#include "fuzz/fixture.hpp"
#include "fuzz/properties.hpp"
#include "input/reader.hpp"
#include "scenario/angle_table.hpp"
#include "study/store.hpp"

namespace earthtop::fuzz {
namespace {

constexpr bool kMayNameFiles = false;  // any bytes may be the name of any file

/// The position is 1-based and not beyond the end of a line.
bool stands_in(std::string_view text, int line, int column) {
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  if (line < 1 || column < 1) return false;
  for (int i = 1; i < line; ++i) {
    const auto newline = text.find('\n');
    if (newline == std::string_view::npos) return false;
    text.remove_prefix(newline + 1);
  }
  return static_cast<std::size_t>(column) <= std::min(text.find('\n'), text.size()) + 1;
}

/// As `accepts`; every diagnostic without exception has a place in the text.
template <class Work>
bool accepts_text(std::string_view text, const Work& work) {
  return accepts([&] {
    try {
      work();
    } catch (const ScenarioError& error) {
      for (const Diagnostic& diagnostic : error.diagnostics())
        demand(stands_in(text, diagnostic.line, diagnostic.column), "an error stands in the text", error.what());
      throw;
    }
  });
}

std::vector<std::string> with(std::vector<std::string> seeds, std::vector<std::string> more) {
  std::move(more.begin(), more.end(), std::back_inserter(seeds));
  return seeds;
}

}  // namespace

/// An accepted input is a scenario whose canonical form decodes to itself. Further parts are --set pairs.
void enter_scenario(std::string_view input) {
  const auto parts = parts_of(input);
  std::vector<std::pair<std::string, std::string>> sets;
  for (std::size_t i = 2; i < parts.size(); i += 2) sets.emplace_back(parts[i - 1], parts[i]);
  std::string canonical;
  const auto decode = [&] { canonical = canonical_json(parse_scenario({"fuzz.json", parts[0], kMayNameFiles}, sets)); };
  if (sets.empty() ? !accepts_text(parts[0], decode) : !accepts(decode)) return;
  check_json(canonical);
  std::string again;
  const bool accepted = accepts([&] { again = canonical_json(parse_scenario({"canonical.json", canonical, kMayNameFiles})); });
  demand(accepted && again == canonical, "a canonical form decodes to itself", canonical + "\n" + again);
}

std::vector<std::string> scenario_seeds() {
  std::vector<std::string> seeds = {shipped("toy-top.json") + "\x01/site/latitude_deg\x01" +
                                    "12\x01/numerics/method\x01"
                                    "dopri5"};
  for (const char* directory : {"", "hard"})
    for (const std::string& path : shipped_in(directory)) seeds.push_back(shipped(path));
  return with(std::move(seeds), hostile_texts());
}

/// An accepted input is a table whose spline has bounded accelerations, and that reads back from its text.
void enter_angle_table(std::string_view input) {
  const auto parsed = scenario::parse_angle_table(input, 1);
  if (const auto* fault = std::get_if<scenario::TableFault>(&parsed)) {
    demand(fault->line > 0, "a fault has a line", fault->message);
    check_message(fault->message);
    return;
  }
  const auto& table = std::get<AngleTable>(parsed);
  const AngleSpline<double> spline(table);
  demand(std::abs(spline.angle_acceleration(0.5)) <= 1e9 * (1 + 1e-9), "an acceleration is bounded", input);
  std::string text = "t_s,angle_rad\n";
  for (std::size_t i = 0; i < table.t_s.size(); ++i) text += fmt::format("{},{}\n", table.t_s[i], table.value[i]);
  check_csv(text);
  const auto again = scenario::parse_angle_table(text, 1);
  demand(std::holds_alternative<AngleTable>(again) && std::get<AngleTable>(again) == table, "a table reads back", text);
}

std::vector<std::string> angle_table_seeds() {
  std::string table = "t_s,angle_rad\r\n";
  for (int i = 0; i < 8; ++i) table += fmt::format("{},{}\r\n", 0.25 * i - 0.25, 0.1 * i * i);
  return {table, "t_s,angle_rad\n0,0\n1,1e-3\n2,1e300\n3,-1e-300"};
}

/// An accepted input can be kept in a store, which then holds the same study.
void enter_study(std::string_view input) {
  const std::string text(input);
  Study study;
  // A base in a file: any name may stand there, and nothing is known of that file.
  accepts_text(text, [&] { parse_study({"fuzz.json", text}, Fixture::get().scenario()); });
  input::Node root;
  input::Findings findings;
  input::read_json(text, "", false, root, findings);
  const input::Node* base = root.find("base");
  if (base && base->kind == input::JsonKind::string) return;
  if (!accepts_text(text, [&] { study = parse_study({"fuzz.json", text}); })) return;
  const auto points = point_count(study);
  if (!points) return;
  accepts([&] { require_affordable(study); });
  accepts([&] { sample_points(study); });
  const std::filesystem::path file = Scratch::empty() / "study.sqlite";
  accepts([&] {
    { study::Store::create(file, study, {}).finish(); }
    const study::Store store = study::Store::open(file, study::sqlite::Connection::Mode::read);
    demand(store.sha256() == study_sha256(study) && study_sha256(store.study()) == store.sha256() &&
               point_count(store.study()) == points && store.study().title == study.title && store.study().name == study.name,
           "a study reads back from its store", text);
  });
}

std::vector<std::string> study_seeds() {
  std::vector<std::string> seeds = {Fixture::get().study().text};
  for (const std::string& path : shipped_in("studies")) {
    std::string text = shipped(path);
    seeds.push_back(text);
    const std::size_t base = text.find("\"../"), end = base == text.npos ? base : text.find('"', base + 1);
    if (end == text.npos) continue;
    seeds.push_back(text.replace(base, end + 1 - base, shipped(text.substr(base + 4, end - base - 4))));
  }
  return with(std::move(seeds), hostile_texts());
}

/// An accepted input names the columns of a motion in proper axes.
void enter_mapping(std::string_view input) {
  Scratch::empty();
  const std::string file = Scratch::write("mapping.json", input);
  accepts_text(input, [&] {
    const compare::Mapping mapping = compare::read_mapping(file);
    demand(mapping.quaternion || mapping.rates || mapping.axis, "there is something to compare", input);
    demand(mapping.time_unit_s > 0 && mapping.rate_unit_rad_s > 0 && std::isfinite(mapping.time_offset_s), "units", input);
    demand(!mapping.attitude_error_rad || *mapping.attitude_error_rad >= 0, "an error is not negative", input);
    for (const compare::AxisTurn& turn : {mapping.world, mapping.body}) {
      auto index = turn.index;
      std::sort(index.begin(), index.end());
      demand(index == std::array<std::size_t, 3>{0, 1, 2}, "three different axes", input);
    }
  });
}

namespace {

constexpr const char* kMapping =
    R"({"$schema": "earthtop-mapping-1.json", "separator": ";", "comment": "%", "time": {"column": "time", "unit": "ms", "offset_s": 0.1},
 "quaternion": {"columns": ["qx", "qy", "qz", "qw"], "order": "xyzw", "rotation": "world_to_body"},
 "rates": {"columns": ["p", "q", "r"], "unit": "deg/s", "axes": "world"}, "axis": {"columns": ["ax", "ay", "az"]},
 "world_axes": "NED", "body_axes": ["3", "1", "2"], "attitude_error_rad": 1e-6})";
constexpr const char* kPlainMapping = R"({"time": {"column": "t"}, "axis": {"columns": ["x", "y", "z"]}, "world_axes": "ENU"})";
constexpr const char* kForeignRows =
    "% made elsewhere\ntime;qx;qy;qz;qw;p;q;r;ax;ay;az\n0;0;0;0;1;1;2;3;0;0;1\n100;0;0.6;0;0.8;1;2;3;0;1;0\n";

}  // namespace

std::vector<std::string> mapping_seeds() { return with({kMapping, kPlainMapping, "{}"}, hostile_texts()); }

/// An accepted input reads back from the same tolerances, written anew.
void enter_tolerances(std::string_view input) {
  Scratch::empty();
  const std::string file = Scratch::write("tolerances.json", input);
  Tolerances read;
  if (!accepts_text(input, [&] { read = read_tolerances(file); })) return;
  const auto number = [](const char* key, const std::optional<double>& value) {
    demand(!value || (std::isfinite(*value) && *value >= 0), "a limit is a number of at least 0", key);
    return value ? fmt::format("\"{}\": {}", key, *value) : fmt::format("\"_{}\": 0", key);
  };
  std::string rules;
  for (const auto& [name, rule] : read.rules)
    rules += fmt::format("{}\"{}\": {{{}, {}, {}}}", rules.empty() ? "" : ", ", name, number("absolute", rule.absolute),
                         number("relative", rule.relative), number("bounds", rule.bounds));
  const std::string written =
      fmt::format(R"({{"profile": "{}", "quantities": {{{}}}, "cost": {{{}, {}}}}})", to_string(read.profile), rules,
                  number("steps_ratio", read.steps_ratio), number("seconds_ratio", read.seconds_ratio));
  // A quantity's name of which a plain string is another one cannot be written so simply.
  for (const auto& [name, rule] : read.rules)
    if (name.find_first_of("\"\\\n\t") != name.npos || printable(name) != name) return;
  Scratch::write("tolerances.json", written);
  Tolerances again;
  demand(accepts([&] { again = read_tolerances(file); }), "tolerances written anew are accepted", written);
  const auto same = [](const auto& a, const auto& b) {
    return a.first == b.first && a.second.absolute == b.second.absolute && a.second.relative == b.second.relative &&
           a.second.bounds == b.second.bounds;
  };
  demand(read.profile == again.profile && read.steps_ratio == again.steps_ratio && read.seconds_ratio == again.seconds_ratio &&
             std::equal(read.rules.begin(), read.rules.end(), again.rules.begin(), again.rules.end(), same),
         "tolerances read back", written);
}

std::vector<std::string> tolerances_seeds() {
  return with({R"({"profile": "physics", "quantities": {"attitude_rad": {"absolute": 1e-6, "_why": "x"},
 "drift_axis_rad": {"relative": 1e-3, "bounds": 2}, "drift.axis_final_rad": {"absolute": 0}}, "cost": {"steps_ratio": 1.1, "seconds_ratio": 2}})",
               R"({"profile": "bitwise"})", "{}"},
              hostile_texts());
}

/// An accepted input has finite values with positive errors in the order of their times, and reads back from its values.
void enter_measurement(std::string_view input) {
  Measurement read;
  if (!accepts([&] { read = parse_measurement("fuzz.csv", std::string(input)); })) return;
  std::string text =
      "t_s,azimuth_rad,azimuth_se_rad,tilt_rad,tilt_se_rad,drift_azimuth_rad,drift_azimuth_se_rad,drift_tilt_rad,"
      "drift_tilt_se_rad,axis_L_x,axis_L_y,axis_L_z,axis_se_rad\n";
  double latest_s = 0;
  for (const MeasuredValue& value : read.values) {
    demand(value.t_s >= latest_s && value.t_s <= 1e9, "times ascend", input);
    demand(std::isfinite(value.value) && value.standard_error > 0 && std::isfinite(value.standard_error),
           "a value is finite and has an error", input);
    latest_s = value.t_s;
    const bool is_axis = value.quantity == MeasuredQuantity::axis;
    const auto& n = value.axis_L;
    demand(!is_axis || std::abs(std::hypot(n[0], n[1], n[2]) - 1) < 1e-12, "an axis is a unit vector", input);
    constexpr MeasuredQuantity kAngles[] = {MeasuredQuantity::azimuth, MeasuredQuantity::tilt, MeasuredQuantity::drift_azimuth,
                                            MeasuredQuantity::drift_tilt};
    text += fmt::format("{}", value.t_s);
    for (const MeasuredQuantity angle : kAngles)
      text += value.quantity == angle ? fmt::format(",{},{}", value.value, value.standard_error) : ",,";
    text += is_axis ? fmt::format(",{},{},{},{}\n", n[0], n[1], n[2], value.standard_error) : ",,,,\n";
  }
  check_csv(text);
  Measurement again;
  demand(accepts([&] { again = parse_measurement("again.csv", text); }), "a measurement written anew is accepted", text);
  const auto same = [](const MeasuredValue& a, const MeasuredValue& b) {
    bool near = a.quantity == b.quantity && a.t_s == b.t_s && a.value == b.value && a.standard_error == b.standard_error;
    for (std::size_t i = 0; i < 3; ++i) near = near && std::abs(a.axis_L[i] - b.axis_L[i]) <= 4e-16;  // normalised again
    return near;
  };
  demand(std::equal(read.values.begin(), read.values.end(), again.values.begin(), again.values.end(), same),
         "a measurement reads back", text);
}

std::vector<std::string> measurement_seeds() {
  return {"t_s,azimuth_deg,azimuth_se_deg,tilt_arcsec,tilt_se_rad,_note\n0,90,0.1,,,\n0.5,89.5,0.1,72000,1e-3,x\n",
          "t_s\taxis_L_x\taxis_L_y\taxis_L_z\taxis_se_rad\n0\t0\t0.6\t0.8\t1e-3\n1\t0\t0\t1\t1e-3\n",
          "t_s,drift_azimuth_rad,drift_azimuth_se_rad,drift_tilt_rad,drift_tilt_se_rad\r\n1,1e-5,1e-6,-1e-5,1e-6\r\n",
          "# a comment\n\nt_s,azimuth_rad,azimuth_se_rad\n0,nan,1\n1,1e999,1\n2,1,1e-400\n"};
}

/// A mapping and the file that it is about. The rows that it gives are numbers in the order of their times.
void enter_foreign_rows(std::string_view input) {
  const auto parts = parts_of(input);
  Scratch::empty();
  const std::string mapping = Scratch::write("mapping.json", parts[0]),
                    file = Scratch::write("rows.csv", parts.size() > 1 ? parts[1] : parts[0]);
  accepts([&] {
    const compare::Mapping meaning = compare::read_mapping(mapping);
    const auto rows = compare::open_mapped_csv(file, meaning);
    compare::Row row;
    double latest_s = -INFINITY;
    while (rows->next(row)) {
      demand(!std::isfinite(row.t_s) || row.t_s > latest_s, "times ascend", input);
      if (std::isfinite(row.t_s)) latest_s = row.t_s;
      check_message(rows->where());
      for (std::size_t i = 0; i < compare::trajectory_table().columns.size(); ++i)
        demand(!rows->has_column(i) || row.kind[i] != compare::CellKind::number || !std::isnan(row.value[i]),
               "a number is a number", input);
    }
  });
  CompareOptions options;
  options.mapping = mapping;
  options.tolerances.profile = Profile::physics;
  std::string document;
  if (accepts([&] { document = comparison_json(compare_results(Fixture::get().results(), file, options)); }))
    check_json(document);
}

std::vector<std::string> foreign_rows_seeds() {
  return {std::string(kMapping) + kBetweenParts + kForeignRows,
          std::string(kPlainMapping) + kBetweenParts + "t,x,y,z\n0,0,0,1\n0.1,0,0,1\n0.2,0,0.6,0.8\n0.5,0,0,1\n"};
}

}  // namespace earthtop::fuzz
