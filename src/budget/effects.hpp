// SPDX-License-Identifier: GPL-3.0-or-later
/// The catalogue of effects lists everything that could turn a top, one row each. The lists in summary.json, the budget, the
/// choice by "auto" and the report take the effects' names, keys, states and sizes from it.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "earthtop/budget/budget.hpp"
#include "earthtop/drift/sensitivity.hpp"
#include "scene/parts.hpp"

namespace earthtop {

inline constexpr std::string_view kCoriolis = "coriolis", kCentrifugal = "centrifugal", kAxisPrecession = "axis_precession",
                                  kRotorBearing = "rotor_bearing", kTransverse = "transverse", kTransport = "transport",
                                  kEotvos = "eotvos", kBallistic = "ballistic";

struct Effect;

/// An effect of known size, as an input of the variational equations.
struct Candidate {
  const Effect* effect = nullptr;
  bool assumed = false;       ///< its size is a typical one, not given by the scene
  bool in_difference = true;  ///< as in EffectEntry
  bool has_responses = true;  ///< whether the input stands for it; else its torque alone is known
  std::string reason;         ///< why it is modelled or left out
  ProblemDerivative input;    ///< scaled so that responses are of order 1
  double size = 1;            ///< size of the effect in units of the input
  /// Gives the size of its torque on the motion on the rotating Earth, for one unit of the input (natural units).
  std::function<double(const FollowedStep&)> torque;
};

/// Where an effect is listed.
enum class Listing {
  both,                        ///< in summary.json and in the budget
  summary,                     ///< in summary.json alone
  summary_and_where_modelled,  ///< in summary.json; in the budget only of a scene that models it
  budget_where_modelled,       ///< in the budget of a scene that models it
  where_modelled               ///< in both, of a scene that models it
};

struct Effect {
  std::string_view name;
  std::string_view key;  ///< JSON pointer of its scenario key; empty if no scenario can give or omit it
  bool (*is_modelled)(const Scene&);
  Listing listing = Listing::both;
  /// Gives its size in a scene, whether it is modelled there or not; empty where the size is unknown.
  std::optional<Candidate> (*size)(const Scene&) = nullptr;
  /// Switches it on without a parameter of its own, as "auto" does; null for an effect that "auto" does not choose.
  void (*switch_on)(Scenario&) = nullptr;
  bool needs_date = false;      ///< whether it can be switched on only if the scenario gives a start date
  bool is_zero = false;         ///< whether its torque is always zero
  std::string_view share = "";  ///< member of kAppliedShares in which the ledger counts it; empty for none
  /// Reasons for an entry without a size.
  std::string_view modelled_unsized = "", left_out_unsized = "";
  /// The reason for an entry without a size on a journey; empty for an effect that is carried along.
  std::string_view aboard = "";
  /// The size of its torque (N m) at the release and the largest, of an effect whose drift is not found; null: not known.
  std::array<double, 2> (*torque)(const Scene&) = nullptr;

  bool is_in_summary(const Scene& scene) const {
    return listing != Listing::budget_where_modelled && (listing != Listing::where_modelled || is_modelled(scene));
  }
  bool is_in_budget(const Scene& scene) const {
    return listing == Listing::both || (listing != Listing::summary && is_modelled(scene));
  }
};

std::span<const Effect> all_effects();

/// Returns the effects of a scene's budget whose size is known from the scene or from nature, in the catalogue's order.
/// @param scene  must outlive the candidates
std::vector<Candidate> effect_candidates(const Scene& scene);

/// Returns the effects that "auto" may switch on and that the scene does not model yet.
std::vector<Candidate> selectable_effects(const Scene& scene);

/// Returns the budget entry of an effect whose size is not known.
EffectEntry unsized_entry(const Effect& effect, const Scene& scene);

/// Returns whether a scene models an effect whose torque the ledger counts in `share`, a member of kAppliedShares.
bool has_share(const Scene& scene, std::string_view share);

/// Returns the names that summary.json lists as modelled, or as left out.
std::vector<std::string_view> effect_names(const Scene& scene, bool modelled);

}  // namespace earthtop
