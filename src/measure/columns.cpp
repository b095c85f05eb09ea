// SPDX-License-Identifier: GPL-3.0-or-later
#include "measure/columns.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numbers>
#include <optional>

#include "input/findings.hpp"
#include "input/node.hpp"
#include "input/suggest.hpp"
#include "measure/quantities.hpp"

namespace earthtop::measure {
namespace {

constexpr std::string_view kAxisColumns[] = {"axis_L_x", "axis_L_y", "axis_L_z"};
constexpr std::string_view kExtremeColumn = "extreme", kTurnsColumn = "passage_turns";
constexpr MeasuredUnit kTimeUnits[] = {{"t_s", 1}, {"t_ms", 1e-3}, {"t_min", 60}};

std::string allowed_columns() {
  return fmt::format(
      "allowed are t_s, t_ms or t_min; {}; for each of these its standard error, as azimuth_se_deg of azimuth_deg; axis_L_x, "
      "axis_L_y "
      "and axis_L_z for an axis; {} (max or min) of turning points; {}; and names that begin with _, which are skipped",
      quantities_in_words(), kExtremeColumn, kTurnsColumn);
}

/// A word on how a quantity is counted, other than as earthtop does.
struct Sense {
  std::string_view word;
  std::string_view of;  ///< the quantity, or the end of its name; empty: any
  double sign;
  double zero_rad;  ///< the angle that is written as 0
};
constexpr double kRight = std::numbers::pi / 2;
constexpr Sense kSenses[] = {
    {"mathematical", "azimuth", -1, kRight},   // counterclockwise from East
    {"counterclockwise", "azimuth", -1, 0},    // from North
    {"from_east", "azimuth", 1, kRight},       // clockwise
    {"from_south", "azimuth", 1, 2 * kRight},  // clockwise
    {"elevation", "tilt", -1, kRight},         // above the horizon
    {"from_down", "tilt", -1, 2 * kRight},    {"reversed", "", -1, 0},
};

bool is_counted(const QuantityRow& row, const Sense& sense) {
  const std::string_view name = row_of(row.of).name;
  return sense.of.empty() || name == sense.of || (name == "swing_azimuth" && sense.of == "azimuth");
}

struct Column {
  std::size_t place;  // place in the header
  double unit;        // its size
};

/// The names of a quantity's columns in all units: "azimuth_rad, azimuth_deg or azimuth_arcsec"
std::string in_all_units(MeasuredQuantity quantity, const std::string& stem) {
  std::string names;
  const auto units = units_of(quantity);
  for (std::size_t i = 0; i < units.size(); ++i) {
    if (i > 0) names += i + 1 == units.size() ? " or " : ", ";
    names += fmt::format("{}_{}", stem, units[i].name);
  }
  return names;
}

bool is_number(const std::string& name) {
  double number = 0;
  const char* const end = name.data() + name.size();
  return std::from_chars(name.data(), end, number).ptr == end;
}

[[noreturn]] void refuse(std::string_view option, std::string_view text, const std::string& message) {
  throw ScenarioError(fmt::format("{} {}", option, input::excerpt(std::string(text), 80)), message);
}

/// The two sides of "name=what".
std::pair<std::string, std::string> sides_of(std::string_view option, const std::string& text, std::string_view example) {
  const std::size_t equals = text.rfind('=');
  if (equals == text.npos || equals == 0 || equals + 1 == text.size())
    refuse(option, text, fmt::format("is not of the form {}", example));
  return {text.substr(0, equals), text.substr(equals + 1)};
}

/// A quantity with a unit: "azimuth_deg"
struct QuantityInUnit {
  const QuantityRow* row = nullptr;
  double unit = 1;
};
std::optional<QuantityInUnit> quantity_in_unit(std::string_view name) {
  for (const QuantityRow& row : quantity_rows())
    for (const MeasuredUnit& unit : units_of(row.quantity))
      if (name == fmt::format("{}_{}", row.name, unit.name)) return QuantityInUnit{&row, unit.size};
  return std::nullopt;
}

/// All names that a column may have.
std::vector<std::string> known_names() {
  std::vector<std::string> names = value_columns();
  for (const MeasuredUnit& unit : kTimeUnits) names.emplace_back(unit.name);
  for (const QuantityRow& row : quantity_rows())
    for (const MeasuredUnit& unit : units_of(row.quantity)) names.push_back(fmt::format("{}_se_{}", row.name, unit.name));
  names.emplace_back(kExtremeColumn);
  names.emplace_back(kTurnsColumn);
  return names;
}

class HeaderReader {
 public:
  HeaderReader(const std::vector<std::string>& header, const MeasurementFormat& format)
      : header_(header), senses_(header.size(), nullptr), names_(known_names()), known_(names_.begin(), names_.end()) {
    for (const std::string& column : format.columns) rename(column);
    for (std::size_t i = 0; i < header_.size(); ++i)
      for (std::size_t k = 0; k < i; ++k)
        if (header_[i] == header_[k] && !header_[i].empty() && header_[i] != "_")
          refuse("--columns", header[i],
                 fmt::format("is {} then, as \"{}\" is; keep one", header_[i], input::excerpt(header[k])));
    for (const std::string& sigma : format.sigmas) take_sigma(sigma);
  }

  MeasurementColumns read() && {
    look_at_unknown_columns();
    if (!columns_.errors.empty()) return std::move(columns_);  // a misspelled column is not missing as well
    find_time();
    if (const auto place = find(kExtremeColumn)) columns_.extreme = want(*place);
    if (const auto place = find(kTurnsColumn)) columns_.turns = want(*place);
    for (const QuantityRow& row : quantity_rows()) read_quantity(row.quantity);
    if (columns_.quantities.empty() && columns_.errors.empty())
      columns_.errors.push_back(fmt::format("there is no measured quantity; {}", allowed_columns()));
    for (const Sigma& sigma : sigmas_)
      if (!sigma.is_used)
        columns_.errors.push_back(fmt::format("--sigma {}: there is no column {}", input::excerpt(sigma.text, 80),
                                              in_all_units(sigma.quantity, std::string(to_string(sigma.quantity)))));
    require_features();
    return std::move(columns_);
  }

 private:
  struct Sigma {
    std::string text;
    MeasuredQuantity quantity;
    double error;  // in rad, rad/s, m or s
    bool is_used = false;
  };

  /// Takes "phi=azimuth_deg:mathematical" into account.
  void rename(const std::string& text) {
    const auto [from, to] =
        sides_of("--columns", text, "NAME=COLUMN, as \"phi=azimuth_deg\" or \"phi=azimuth_deg:mathematical\"");
    const std::size_t colon = to.find(':');
    const std::string name = to.substr(0, colon);
    const auto place = std::ranges::find(header_, from);
    if (place == header_.end()) {
      const auto meant = input::suggest(from, std::vector<std::string_view>(header_.begin(), header_.end()));
      refuse("--columns", text,
             fmt::format("the file has no column \"{}\"; it has {}{}", input::excerpt(from),
                         input::excerpt(fmt::format("{}", fmt::join(header_, ", ")), 200),
                         meant ? fmt::format("; did you mean \"{}\"?", *meant) : ""));
    }
    if (!name.starts_with('_') && std::ranges::find(names_, name) == names_.end()) {
      const auto meant = input::suggest(name, known_);
      refuse("--columns", text,
             fmt::format("there is no \"{}\"; {}{}", input::excerpt(name), allowed_columns(),
                         meant ? fmt::format("; did you mean \"{}\"?", *meant) : ""));
    }
    if (colon != to.npos)
      senses_[static_cast<std::size_t>(place - header_.begin())] = &sense_of(text, name, to.substr(colon + 1));
    *place = name;
  }

  static const Sense& sense_of(const std::string& text, const std::string& column, const std::string& word) {
    const auto quantity = quantity_in_unit(column);
    std::vector<std::string_view> words;
    for (const Sense& sense : kSenses) {
      if (!quantity || !is_counted(*quantity->row, sense)) continue;
      if (sense.word == word) return sense;
      words.push_back(sense.word);
    }
    if (words.empty())
      refuse("--columns", text, fmt::format("{} has no other sense; leave out what follows the colon", column));
    const auto meant = input::suggest(word, words);
    refuse("--columns", text,
           fmt::format("{} is not counted as \"{}\"; allowed are {}{}", column, input::excerpt(word), fmt::join(words, ", "),
                       meant ? fmt::format("; did you mean \"{}\"?", *meant) : ""));
  }

  void take_sigma(const std::string& text) {
    const auto [name, number] = sides_of("--sigma", text, "COLUMN=NUMBER, as azimuth_deg=0.2");
    const auto quantity = quantity_in_unit(name);
    if (!quantity) {
      const auto meant = input::suggest(name, known_);
      refuse("--sigma", text,
             fmt::format("there is no \"{}\"; it is a quantity with its unit, as azimuth_deg: {}{}", input::excerpt(name),
                         quantities_in_words(), meant ? fmt::format("; did you mean \"{}\"?", *meant) : ""));
    }
    double error = 0;
    const char* const end = number.data() + number.size();
    const auto [last, fault] = std::from_chars(number.data(), end, error);
    if (fault != std::errc() || last != end || !(error > 0) || !std::isfinite(error) ||
        !std::isfinite(1 / (error * quantity->unit)))
      refuse("--sigma", text, "must be a number above 0, in the unit of the name");
    for (const Sigma& other : sigmas_)
      if (other.quantity == quantity->row->quantity)
        refuse("--sigma", text, fmt::format("{} is given, too; keep one", input::excerpt(other.text, 80)));
    sigmas_.push_back({text, quantity->row->quantity, error * quantity->unit});
  }

  /// Columns with other names are left out, but those that may be a slip are refused.
  void look_at_unknown_columns() {
    if (std::ranges::all_of(header_, is_number)) {
      columns_.errors.emplace_back("the first line has numbers; it must name the columns, as t_s,azimuth_deg,azimuth_se_deg");
      return;
    }
    constexpr std::size_t kMostLooked = 500;  // a look at each takes a quarter of a millisecond
    std::size_t looked = 0;
    for (const std::string& name : header_) {
      if (name.starts_with('_') || std::ranges::find(names_, name) != names_.end()) continue;
      const auto meant = ++looked <= kMostLooked ? input::suggest(name, known_) : std::nullopt;
      if (!meant) {
        if (!name.empty()) columns_.left_out.push_back(name);
        continue;
      }
      if (columns_.errors.size() >= input::kMostDiagnostics) {  // it is counted, and not shown
        columns_.errors.emplace_back();
        continue;
      }
      columns_.errors.push_back(
          fmt::format("unknown column \"{}\"; did you mean \"{}\"? rename it, or begin its name with _ to leave it out",
                      input::excerpt(name), *meant));
    }
  }

  void find_time() {
    std::optional<std::size_t> found;
    for (const MeasuredUnit& unit : kTimeUnits) {
      const auto place = find(unit.name);
      if (!place) continue;
      if (found)
        columns_.errors.push_back(fmt::format("columns {} and {} both give the time; keep one", header_[*found], unit.name));
      found = place;
      columns_.time_unit_s = unit.size;
    }
    if (found) columns_.time = want(*found);
  }

  void read_quantity(MeasuredQuantity quantity) {
    const std::string name(to_string(quantity));
    const bool is_axis = quantity == MeasuredQuantity::axis;
    const std::optional<Column> error = find_in_a_unit(quantity, name + "_se");
    const std::optional<Column> value = is_axis ? find_axis() : find_in_a_unit(quantity, name);
    const auto sigma = std::ranges::find(sigmas_, quantity, &Sigma::quantity);
    if (value && !error && sigma == sigmas_.end())
      columns_.errors.push_back(fmt::format("{} has no standard error; give a column {}, or --sigma {}_{}=...", name,
                                            in_all_units(quantity, name + "_se"), name,
                                            units_of(quantity)[units_of(quantity).size() > 1 ? 1 : 0].name));
    if (error && !value && !is_axis)
      columns_.errors.push_back(
          fmt::format("{} is given without a column {}", header_[error->place], in_all_units(quantity, name)));
    if (error && !value && is_axis)
      columns_.errors.push_back(header_[error->place] + " is given without all of axis_L_x, axis_L_y, axis_L_z");
    if (!value) return;
    if (sigma != sigmas_.end()) sigma->is_used = true;
    if (error && sigma != sigmas_.end())
      columns_.errors.push_back(fmt::format("--sigma {}: column {} gives standard errors; leave one of them out",
                                            input::excerpt(sigma->text, 80), header_[error->place]));
    if (!error && sigma == sigmas_.end()) return;
    QuantityCells cells{quantity, want(value->place), {value->unit, 0}};
    if (const Sense* sense = senses_[value->place]) cells.value_is = {sense->sign * value->unit, sense->zero_rad};
    if (is_axis)
      for (const std::string_view column : {kAxisColumns[1], kAxisColumns[2]}) want(*find(column));
    if (error) {
      cells.error = want(error->place);
      cells.error_unit = error->unit;
    } else {
      cells.error_unit = sigma->error;
    }
    columns_.quantities.push_back(cells);
  }

  /// The time may be left out only where all values are times themselves; words on features need such a feature.
  void require_features() {
    if (!columns_.errors.empty()) return;
    const auto has = [&](Feature feature) {
      return std::ranges::any_of(columns_.quantities,
                                 [&](const QuantityCells& cells) { return row_of(cells.quantity).feature == feature; });
    };
    const bool only_passages = std::ranges::all_of(
        columns_.quantities, [](const QuantityCells& cells) { return row_of(cells.quantity).feature == Feature::passage; });
    if (!columns_.time && !only_passages)
      columns_.errors.emplace_back(
          "there is no column t_s, t_ms or t_min, the time since the release; if it has another name, say --columns NAME=t_s");
    if (columns_.extreme && !has(Feature::turning))
      columns_.errors.push_back(fmt::format("{} is given without a turning point, as azimuth_turning_deg", kExtremeColumn));
    if (columns_.turns && !has(Feature::passage))
      columns_.errors.push_back(fmt::format("{} is given without passage_s", kTurnsColumn));
  }

  std::optional<std::size_t> find(std::string_view name) const {
    const auto at = std::find(header_.begin(), header_.end(), name);
    if (at == header_.end()) return std::nullopt;
    return static_cast<std::size_t>(at - header_.begin());
  }

  /// The column of this quantity, in any unit. Reports an error if there are two.
  std::optional<Column> find_in_a_unit(MeasuredQuantity quantity, const std::string& stem) {
    std::optional<Column> found;
    for (const MeasuredUnit& unit : units_of(quantity)) {
      const std::string name = fmt::format("{}_{}", stem, unit.name);
      const auto place = find(name);
      if (!place) continue;
      if (found)
        columns_.errors.push_back(
            fmt::format("columns {} and {} give the same quantity in two units; keep one", header_[found->place], name));
      found = Column{*place, unit.size};
    }
    return found;
  }

  std::optional<Column> find_axis() const {
    for (const std::string_view column : kAxisColumns)
      if (!find(column)) return std::nullopt;
    return Column{*find(kAxisColumns[0]), 1};
  }

  std::size_t want(std::size_t place) {
    columns_.wanted.push_back(place);
    return columns_.wanted.size() - 1;
  }

  std::vector<std::string> header_;
  std::vector<const Sense*> senses_;  // of each column; null: as earthtop counts
  std::vector<Sigma> sigmas_;
  std::vector<std::string> names_;
  std::vector<std::string_view> known_;
  MeasurementColumns columns_;
};

}  // namespace

MeasurementColumns measurement_columns(const std::vector<std::string>& header, const MeasurementFormat& format) {
  return HeaderReader(header, format).read();
}

}  // namespace earthtop::measure
