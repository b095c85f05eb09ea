// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/core.h>

#include <Eigen/Eigenvalues>
#include <array>
#include <cmath>

#include "earthtop/model/gyrostat.hpp"
#include "scenario/decode.hpp"
#include "scenario/fields.hpp"
#include "scenario/keys.hpp"
#include "scenario/reading.hpp"
#include "scenario/rules.hpp"

namespace earthtop::scenario {
namespace {

using Matrix = std::array<std::array<double, 3>, 3>;

void check_member(const Section& solid, std::string_view key, Need need, std::string_view shape) {
  if (need == Need::required && !solid.has(key)) {
    solid.require(key);
  } else if (need == Need::none && solid.has(key)) {
    std::string hollow;  // the shapes that have an inner radius
    for (const ShapeRule& rule : kShapeRules)
      if (rule.inner_radius != Need::none) hollow += fmt::format("{}a {}", hollow.empty() ? "" : " and ", rule.word);
    const std::string instead = key == "inner_radius_m" ? fmt::format("; only {} have one", hollow) : "; leave it out";
    solid.refuse_key(key, fmt::format("a {} has no {}{}", shape, key, instead));
  }
}

/// Returns what a solid lacks to have a volume, without which its mass cannot come from a density; empty if it has one.
std::string thinness(const Solid& solid) {
  switch (solid.shape) {
    case SolidShape::disc:
    case SolidShape::ring:
      if (solid.length_m == 0) return "without length_m";
      break;
    case SolidShape::rod:
      if (solid.radius_m == 0) return "without radius_m";
      break;
    default: break;
  }
  return solid.inner_radius_m == solid.radius_m ? "as thin as its radii say" : "";
}

std::optional<Solid> decode_solid(const Section& section) {
  if (!section.present()) return std::nullopt;
  const bool has_mass = section.has("mass_kg"), has_density = section.has("density_kg_m3");
  if (has_mass && has_density)
    section.refuse_key("density_kg_m3", "mass_kg and density_kg_m3 are both given; give exactly one");
  else if (!has_mass && !has_density)
    section.missing("mass_kg", "neither mass_kg nor density_kg_m3 is given; give exactly one");
  Solid solid;
  Reading codec(section);
  solid_keys(codec, solid);
  const auto shape = section.word("shape");
  if (!shape) return std::nullopt;
  const ShapeRule& rule = row_of(kShapeRules, solid.shape);
  check_member(section, "radius_m", rule.radius, *shape);
  check_member(section, "inner_radius_m", rule.inner_radius, *shape);
  check_member(section, "length_m", rule.length, *shape);
  if (!codec.complete()) return std::nullopt;
  bool complete = has_mass != has_density;
  if (section.has("radius_m") && solid.inner_radius_m > solid.radius_m && rule.inner_radius != Need::none) {
    section.refuse("inner_radius_m",
                   fmt::format("{} is larger than radius_m, {}; the inner radius must not be above the outer one",
                               solid.inner_radius_m, solid.radius_m));
    complete = false;
  }
  if (rule.length == Need::required && section.has("length_m") && solid.length_m == 0) {
    section.refuse("length_m", fmt::format("is 0; the length of a {} must be above 0 (m)", *shape));
    complete = false;
  }
  if (const std::string thin = thinness(solid); has_density && !has_mass && !thin.empty()) {
    section.refuse_key("density_kg_m3", fmt::format("a {} {} has no volume; give mass_kg", *shape, thin));
    complete = false;
  }
  if (rule.radius == Need::required && !section.has("radius_m")) complete = false;
  if (!complete) return std::nullopt;
  return solid;
}

bool decode_solids(const Section& body, BodySpec& spec) {
  for (const std::string_view key : {"mass_kg", "center_of_mass_m", "inertia"})
    if (body.has(key))
      body.refuse_key(key, "solids are given too; give either solids or mass_kg, center_of_mass_m and inertia");
  bool complete = body.size("solids") > 0;
  for (std::size_t i = 0; i < body.size("solids"); ++i) {
    const auto solid = decode_solid(body.element("solids", i));
    if (solid)
      spec.solids.push_back(*solid);
    else
      complete = false;
  }
  return complete && !body.has("mass_kg") && !body.has("center_of_mass_m") && !body.has("inertia");
}

/// Averages the off-diagonal entries, which must agree to 4 eps of the larger one (the rounding of a rotated tensor).
bool make_symmetric(const Section& inertia, Matrix& matrix) {
  bool symmetric = true;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = i + 1; j < 3; ++j) {
      double &upper = matrix[i][j], &lower = matrix[j][i];
      if (std::abs(upper - lower) > 4 * real::epsilon<double>() * std::max(std::abs(upper), std::abs(lower))) {
        inertia.refuse("matrix_kg_m2",
                       fmt::format("is not symmetric: row {}, column {} is {}, row {}, column {} is {}; the two "
                                   "must be equal",
                                   i + 1, j + 1, upper, j + 1, i + 1, lower));
        symmetric = false;
      }
      if (upper != lower) upper = lower = upper / 2 + lower / 2;
    }
  }
  return symmetric;
}

/// Checks that exactly one of the two ways to give a tensor is used. @returns whether that is so
bool check_inertia(const Section& inertia) {
  const bool principal = inertia.has("principal_kg_m2"), full = inertia.has("matrix_kg_m2");
  if (principal && full)
    inertia.refuse_key("matrix_kg_m2", "principal_kg_m2 and matrix_kg_m2 are both given; give exactly one");
  else if (!principal && !full)
    inertia.missing("principal_kg_m2", "neither principal_kg_m2 nor matrix_kg_m2 is given; give exactly one");
  return principal != full;
}

bool decode_given(const Section& body, BodySpec& spec) {
  if (!body.has("mass_kg") && !body.has("center_of_mass_m") && !body.has("inertia")) {
    body.missing("mass_kg", "mass_kg, center_of_mass_m and inertia are missing; give them, or solids");
    return false;
  }
  bool given = true;
  for (const std::string_view key : {"mass_kg", "center_of_mass_m", "inertia"}) given = body.require(key) && given;
  Reading codec(body);
  body_keys(codec, spec);
  if (!body.has("inertia")) return false;
  return complete_inertia(body.section("inertia"), spec) && codec.complete() && given;
}

}  // namespace

bool complete_inertia(const Section& inertia, BodySpec& spec) {
  return check_inertia(inertia) && (inertia.has("principal_kg_m2") || make_symmetric(inertia, spec.inertia_kg_m2));
}

std::optional<BodySpec> decode_body(const Section& body, bool has_rotor) {
  BodySpec spec;
  const bool from_solids = body.has("solids");
  if (!(from_solids ? decode_solids(body, spec) : decode_given(body, spec))) return std::nullopt;
  const std::string_view source = from_solids ? "solids" : "inertia";
  const auto violations = body_violations(spec, has_rotor);
  for (const Diagnostic& violation : violations) {
    // Messages about the body as a whole are placed at the part from which it is computed.
    const bool at_inertia = violation.pointer.starts_with("/body/inertia") || violation.pointer.starts_with("/body/solids");
    body.refuse(at_inertia ? source : "mass_kg", violation.message);
  }
  if (!violations.empty()) return std::nullopt;
  const Body<double> made = make_body<double>(spec);
  const input::Range mass_range = fields().find("/body/mass_kg")->range;
  if (!mass_range.contains(made.mass)) {
    body.refuse(source, fmt::format("the mass is {} kg in all; it must be {} kg", made.mass, input::range_text(mass_range)));
    return std::nullopt;
  }
  if (has_rotor) return spec;  // its moments are checked together with the rotor's
  if (!made.I_BP_B_inverse.allFinite() || !made.I_BP_B.allFinite() || !(made.I_BP_B.determinant() > 0)) {
    body.refuse(source, "the moments of inertia are too small or too large for a double; give a body of everyday size");
    return std::nullopt;
  }
  return spec;
}

void check_gyrostat(const Section& root, const BodySpec& body, const RotorSpec& rotor) {
  // A free rotor turns about its own axis without the body, which then has to have a moment about it.
  const auto both = gyrostat_body(make_body<float80>(body), rotor, rotor.drive != RotorDrive::none);
  const Eigen::SelfAdjointEigenSolver<Mat3<float80>> moments(both.I_BP_B, Eigen::EigenvaluesOnly);
  const float80 least = moments.eigenvalues()[0], largest = moments.eigenvalues()[2];
  if (least > 32 * static_cast<float80>(real::epsilon<double>()) * largest && both.I_BP_B_inverse.allFinite()) return;
  root.section("body").refuse(
      body.solids.empty() ? "inertia" : "solids",
      fmt::format("body and rotor together are not free to turn about three axes: without the rotor's axial moment, which "
                  "counts only if "
                  "a drive holds the rotor, the least moment about the pivot is {:.6g} kg m^2, the largest {:.6g}",
                  static_cast<double>(least), static_cast<double>(largest)));
}

}  // namespace earthtop::scenario
