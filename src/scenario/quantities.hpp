// SPDX-License-Identifier: GPL-3.0-or-later
/// The names of the quantities that a headline figure or a criterion may use, separated by '|'.
#pragma once

#include <array>
#include <string_view>

#include "drift/row_quantities.hpp"
#include "earthtop/model/conserved.hpp"

namespace earthtop::scenario {

/// A list of names, joined at compile time. @tparam spell  function that calls its argument with the pieces of the list in
/// order, including the "|" between names
template <auto spell>
struct Spelled {
  static constexpr std::size_t kSize = [] {
    std::size_t size = 0;
    spell([&](std::string_view piece) { size += piece.size(); });
    return size;
  }();
  static constexpr std::array<char, kSize> kLetters = [] {
    std::array<char, kSize> letters{};
    std::size_t end = 0;
    spell([&](std::string_view piece) {
      for (const char c : piece) letters[end++] = c;
    });
    return letters;
  }();
  static constexpr std::string_view text{kLetters.data(), kSize};
};

/// Joins several lists to one.
template <const std::string_view&... lists>
using Joined = Spelled<[](const auto& add) {
  bool first = true;
  const auto add_list = [&](std::string_view list) {
    if (!first) add("|");
    first = false;
    add(list);
  };
  (add_list(lists), ...);
}>;

/// Whether a headline or a criterion may be about a quantity of the rows.
constexpr bool is_figure(const RowQuantity& quantity) {
  return quantity.part != RowPart::error && quantity.kind != MeasureKind::word;
}

/// The columns of trajectory.csv except those that state errors and those of words.
inline constexpr std::string_view kColumns = Spelled<[](const auto& add) {
  bool first = true;
  for (const RowQuantity& quantity : kDriftQuantities)
    for (std::size_t i = 0; is_figure(quantity) && i < quantity.width(); ++i) {
      if (!first) add("|");
      first = false;
      quantity.spell_column(i, add);
    }
}>::text;

/// The figures of summary.json that a headline may use. The table of figures checks at compile time that each of them exists.
inline constexpr std::string_view kSummaryFigures =
    "drift.axis_max_rad|drift.threshold_time_s|drift.secular.azimuth_rate_rad_s|drift.tip_max_m|contact.events.0.t_s|"
    "contact.events.0.time_difference_s|contact.events.1.t_s|contact.events.2.t_s|contact.events.2.time_difference_s|"
    "contact.events.3.t_s";

inline constexpr std::string_view kFigures = Joined<kColumns, kSummaryFigures>::text;

/// Vectors that consist of several columns (the error of an attitude is an angle).
inline constexpr std::string_view kColumnVectors = Spelled<[](const auto& add) {
  bool first = true;
  for (const MeasureKind kind : {MeasureKind::attitude, MeasureKind::vector, MeasureKind::direction, MeasureKind::place})
    for (const RowQuantity& quantity : kDriftQuantities) {
      if (quantity.kind != kind) continue;
      if (!first) add("|");
      first = false;
      add(quantity.stem), add(quantity.unit);
    }
}>::text;

/// Rates about body axis 3 relative to inertial space, which are in no column.
inline constexpr std::string_view kInertialSpins = "inertial_spin_rad_s|ref_inertial_spin_rad_s";

/// Quantities of the whole run, one number each. (The type of what is gone through is named: with `auto` g++ 13 does not compile
/// the loop.)
inline constexpr std::string_view kRunNumbers = Spelled<[](const auto& add) {
  for (const ConservedQuantity<double>& quantity : kConserved<double>)
    if (quantity.unit == "J") add(quantity.name), add("_J|");
  add("critical_spin_rad_s");
}>::text;

/// What a body on a pivot conserves.
inline constexpr std::string_view kInvariants = Spelled<[](const auto& add) {
  bool first = true;
  for (const ConservedQuantity<double>& quantity : kConserved<double>) {
    if (quantity.on_pivot == nullptr) continue;
    if (!first) add("|");
    first = false;
    add(quantity.name);
  }
}>::text;

inline constexpr std::string_view kClosedForms =
    "reference|motion|motion_axis|balanced_axis|steady_precession|homoclinic_tilt|separatrix_rates|cusp_tilts|growth_rate|"
    "foucault_rate|resting_axis|mean_lean";

inline constexpr std::string_view kRelations =
    "same|same_axis|same_drift|mirrored_north_south|proportional_to_earth_rate|reversed_in_time|reference_turned";

inline constexpr std::string_view kZeros = "drift|axis_drift|reference_tilt";

inline constexpr std::string_view kOrders = "step_resonance|convergence";

inline constexpr std::string_view kVerdicts = "reliable|noise_floor|unstable|chaotic|marginal";

inline constexpr std::string_view kValues = Joined<kFigures, kColumnVectors, kInertialSpins, kRunNumbers>::text;

}  // namespace earthtop::scenario
