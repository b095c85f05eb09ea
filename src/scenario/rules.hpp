// SPDX-License-Identifier: GPL-3.0-or-later
/// Which keys go with a word: with a solid's shape, a platform's motion, a criterion's kind; and the methods and precisions
/// there are. Decoder and schema read the same rows.
#pragma once

#include <array>
#include <span>
#include <string_view>

#include "earthtop/integrate/options.hpp"
#include "earthtop/model/body_spec.hpp"
#include "earthtop/model/platform_spec.hpp"
#include "earthtop/scenario/criterion.hpp"
#include "scenario/quantities.hpp"

namespace earthtop::scenario {

using earthtop::Need;

struct ShapeRule {
  std::string_view word;
  SolidShape shape;
  Need radius, inner_radius, length;  ///< a length that is required is above 0
};

inline constexpr std::array kShapeRules = {
    ShapeRule{"disc", SolidShape::disc, Need::required, Need::none, Need::optional},
    ShapeRule{"cylinder", SolidShape::cylinder, Need::required, Need::none, Need::required},
    ShapeRule{"ring", SolidShape::ring, Need::required, Need::required, Need::optional},
    ShapeRule{"cone", SolidShape::cone, Need::required, Need::none, Need::required},
    ShapeRule{"sphere", SolidShape::sphere, Need::required, Need::optional, Need::none},
    ShapeRule{"rod", SolidShape::rod, Need::optional, Need::none, Need::required},
};

struct MotionRule {
  std::string_view word;
  PlatformMotion motion;
  std::string_view required;  ///< keys without which nothing moves as the word says, separated by '|'
  std::string_view allowed;   ///< of kMotionKeys
};

inline constexpr std::string_view kMotionKeys =
    "rate_rad_s|acceleration_rad_s2|amplitude_rad|frequency_hz|phase_deg|file|file_sha256";
inline constexpr std::array kMotionRules = {
    MotionRule{"constant", PlatformMotion::constant, "rate_rad_s", "rate_rad_s"},
    MotionRule{"ramp", PlatformMotion::ramp, "acceleration_rad_s2", "rate_rad_s|acceleration_rad_s2"},
    MotionRule{"harmonic", PlatformMotion::harmonic, "amplitude_rad|frequency_hz", "amplitude_rad|frequency_hz|phase_deg"},
    MotionRule{"table", PlatformMotion::table, "file", "file|file_sha256"},
};

inline constexpr std::array kCompositions = {Composition::automatic, Composition::aba82,   Composition::aba84,
                                             Composition::aba864,    Composition::aba1064, Composition::rkn6,
                                             Composition::kahan_li8};

/// What a criterion of a kind must and may say besides kind, set, why and slow.
struct CriterionRule {
  std::string_view word;
  CriterionKind kind;
  std::string_view required, allowed;  ///< of kCriterionKeys
  std::string_view quantities;         ///< of which there is one; empty where there is none
};

inline constexpr std::string_view kCriterionKeys = "quantity|values|at_s|until_s|tolerance";
inline constexpr std::array kCriterionRules = {
    CriterionRule{"value", CriterionKind::value, "quantity|values|tolerance", "quantity|values|tolerance|at_s", kValues},
    CriterionRule{"invariant", CriterionKind::invariant, "quantity|tolerance", "quantity|tolerance", kInvariants},
    CriterionRule{"closed_form", CriterionKind::closed_form, "quantity|tolerance", "quantity|tolerance|until_s", kClosedForms},
    CriterionRule{"equivalence", CriterionKind::equivalence, "quantity|tolerance", "quantity|tolerance|until_s", kRelations},
    CriterionRule{"exactly_zero", CriterionKind::exactly_zero, "quantity", "quantity", kZeros},
    CriterionRule{"order", CriterionKind::order, "quantity|tolerance", "quantity|tolerance|values", kOrders},
    CriterionRule{"verdict", CriterionKind::verdict, "quantity", "quantity|values", kVerdicts},
    CriterionRule{"refused", CriterionKind::refused, "set", "", ""},
};

inline constexpr std::array kPrecisions = {Precision::bits53, Precision::bits64, Precision::bits113};

}  // namespace earthtop::scenario
