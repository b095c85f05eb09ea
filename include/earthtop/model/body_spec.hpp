// SPDX-License-Identifier: GPL-3.0-or-later
/// The top as a scenario gives it: mass, centre of mass and inertia, or solids from which these are computed.
#pragma once

#include <array>
#include <optional>
#include <vector>

namespace earthtop {

enum class InertiaAbout { pivot, center_of_mass };
enum class SolidShape { disc, cylinder, ring, cone, sphere, rod };

/// A uniform solid of revolution about body axis 3. The tip of a cone points to -z.
struct Solid {
  SolidShape shape = SolidShape::disc;
  double radius_m = 0;        ///< outer radius; a rod without radius is thin
  double inner_radius_m = 0;  ///< ring: annular cylinder; sphere: shell
  double length_m = 0;        ///< along axis 3; may be 0 for disc and ring
  std::optional<double> mass_kg;
  std::optional<double> density_kg_m3;
  double at_m = 0;  ///< axial coordinate of its centre of mass, signed
  bool operator==(const Solid&) const = default;
};

/// A body as a scenario gives it.
struct BodySpec {
  double mass_kg = 0;
  std::array<double, 3> center_of_mass_m = {0, 0, 0};
  InertiaAbout inertia_about = InertiaAbout::pivot;
  std::array<std::array<double, 3>, 3> inertia_kg_m2 = {};
  std::vector<Solid> solids;  ///< if not empty, the four members above are computed from the solids
  bool operator==(const BodySpec&) const = default;
};

}  // namespace earthtop
