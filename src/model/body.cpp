// SPDX-License-Identifier: GPL-3.0-or-later
#include "earthtop/model/body.hpp"

#include <fmt/core.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace earthtop {
namespace {

/// Mass and moments of a solid about its own centre of mass, across and along the axis (kg, kg m^2).
template <class T>
struct SolidMoments {
  T mass;
  T across;
  T along;
};

/// Textbook moments of uniform solids, e.g. Goldstein, Classical Mechanics; for shells by subtraction of powers of the radii.
template <class T>
SolidMoments<T> solid_moments(const Solid& solid) {
  const T R = T(solid.radius_m), r = T(solid.inner_radius_m), h = T(solid.length_m), pi = real::pi<T>();
  T volume = T(0), across = T(0), along = T(0);  // moments per unit mass
  switch (solid.shape) {
    case SolidShape::disc:
    case SolidShape::cylinder:
    case SolidShape::ring:
    case SolidShape::rod: {
      const T squares = R * R + r * r;
      volume = pi * (R - r) * (R + r) * h;
      along = squares / T(2);
      across = squares / T(4) + h * h / T(12);
      break;
    }
    case SolidShape::cone:
      volume = pi * R * R * h / T(3);
      along = T(3) * R * R / T(10);
      across = T(3) * R * R / T(20) + T(3) * h * h / T(80);
      break;
    case SolidShape::sphere: {
      // (2/5) (R^5 - r^5)/(R^3 - r^3) with both differences divided by R - r, so that a thin shell keeps its digits.
      const T cubic = R * R + R * r + r * r;
      const T quintic = R * R * R * R + R * R * R * r + R * R * r * r + R * r * r * r + r * r * r * r;
      volume = T(4) * pi * (R - r) * cubic / T(3);
      along = across = T(2) * quintic / (T(5) * cubic);
      break;
    }
  }
  const T mass = solid.mass_kg ? T(*solid.mass_kg) : T(*solid.density_kg_m3) * volume;
  return {mass, mass * across, mass * along};
}

template <class T>
void fill_from_solids(const std::vector<Solid>& solids, Body<T>& body) {
  T first_moment = T(0), across = T(0), along = T(0);
  for (const Solid& solid : solids) {
    const SolidMoments<T> m = solid_moments<T>(solid);
    body.mass += m.mass;
    first_moment += m.mass * T(solid.at_m);
    across += m.across + m.mass * T(solid.at_m) * T(solid.at_m);
    along += m.along;
  }
  body.p_PBcm_B = Vec3<T>(T(0), T(0), first_moment / body.mass);
  body.I_BP_B = Vec3<T>(across, across, along).asDiagonal();
}

}  // namespace

template <class T>
Body<T> make_body(const BodySpec& spec) {
  Body<T> body;
  if (!spec.solids.empty()) {
    fill_from_solids(spec.solids, body);
  } else {
    body.mass = T(spec.mass_kg);
    for (int i = 0; i < 3; ++i) {
      body.p_PBcm_B[i] = T(spec.center_of_mass_m[static_cast<std::size_t>(i)]);
      for (int j = 0; j < 3; ++j)
        body.I_BP_B(i, j) = T(spec.inertia_kg_m2[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)]);
    }
    if (spec.inertia_about == InertiaAbout::center_of_mass) body.I_BP_B += point_mass_inertia(body.mass, body.p_PBcm_B);
  }
  const T trace = body.I_BP_B(0, 0) + body.I_BP_B(1, 1) + body.I_BP_B(2, 2);
  body.S_BP_B = (trace / T(2)) * Mat3<T>::Identity() - body.I_BP_B;
  body.I_BP_B_inverse = symmetric_inverse(body.I_BP_B);
  return body;
}
template Body<double> make_body(const BodySpec&);
template Body<float80> make_body(const BodySpec&);
template Body<float128> make_body(const BodySpec&);

std::string missing_moments(const Mat3<double>& inertia) {
  const double largest = inertia.diagonal().cwiseAbs().maxCoeff(), round_off = 32 * real::epsilon<double>() * largest;
  std::string names;
  int count = 0;
  for (int i = 0; i < 3; ++i)
    if (inertia(i, i) <= round_off) names += fmt::format("{}I{}", count++ > 0 ? " and " : "", i + 1);
  if (inertia(0, 1) != 0 || inertia(0, 2) != 0 || inertia(1, 2) != 0 || count == 0) return "";
  return fmt::format("{} {} 0", names, count > 1 ? "are" : "is");
}

std::vector<Diagnostic> body_violations(const BodySpec& spec, bool has_rotor) {
  using Matrix = Mat3<float80>;
  const auto body = make_body<float80>(spec);
  if (!(body.mass > 0) || !real::isfinite(body.mass) || !real::isfinite(norm(body.p_PBcm_B)))
    return {{0, 0, "/body", "the mass must be positive and the centre of mass finite"}};
  const char* place = spec.solids.empty() ? "/body/inertia" : "/body/solids";
  const Eigen::SelfAdjointEigenSolver<Matrix> at_pivot(body.I_BP_B, Eigen::EigenvaluesOnly);
  const float80 largest = at_pivot.eigenvalues()[2], smallest = at_pivot.eigenvalues()[0];
  const float80 slack = 32 * static_cast<float80>(real::epsilon<double>()) * real::abs(largest);
  if (!real::isfinite(largest) || !(largest > 0 || (has_rotor && largest == 0)))
    return {{0, 0, place, "the inertia tensor is not that of a body; the moments must be positive and finite"}};
  std::vector<Diagnostic> violations;
  if (!has_rotor && !(smallest > 0)) {
    const std::string missing = missing_moments(body.I_BP_B.cast<double>());
    const std::string least = fmt::format("least principal moment {:.6g} kg m^2, largest {:.6g}", static_cast<double>(smallest),
                                          static_cast<double>(largest));
    violations.push_back({0, 0, place,
                          fmt::format("the inertia about the pivot is not positive definite ({}); every principal moment "
                                      "about the pivot must be positive",
                                      missing.empty() ? least : missing)});
  }
  // The triangle inequality I_i <= I_j + I_k says that the second moment about the centre of mass is not negative.
  const Matrix I_cm = body.I_BBcm_B();
  const Eigen::SelfAdjointEigenSolver<Matrix> at_cm(I_cm, Eigen::EigenvaluesOnly);
  const auto& I = at_cm.eigenvalues();
  if (I[0] < -slack)
    violations.push_back({0, 0, place,
                          fmt::format("about the centre of mass a principal moment is negative ({:.6g} kg m^2): the inertia "
                                      "about the pivot is smaller than that of the mass at its centre alone; check `about`, "
                                      "mass_kg and center_of_mass_m",
                                      static_cast<double>(I[0]))});
  else if (I[2] > I[0] + I[1] + slack)
    violations.push_back({0, 0, place,
                          fmt::format("about the centre of mass the principal moments {:.6g}, {:.6g}, {:.6g} kg m^2 break the "
                                      "triangle inequality; no moment may exceed the sum of the two others",
                                      static_cast<double>(I[0]), static_cast<double>(I[1]), static_cast<double>(I[2]))});
  return violations;
}

}  // namespace earthtop
