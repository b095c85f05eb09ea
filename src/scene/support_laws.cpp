// SPDX-License-Identifier: GPL-3.0-or-later
#include "scene/support_laws.hpp"

#include <array>

#include "earthtop/model/contact_release.hpp"
#include "earthtop/model/gimbal_equations.hpp"
#include "earthtop/model/release.hpp"
#include "earthtop/scenario/support.hpp"
#include "scene/caged_top.hpp"

namespace earthtop {
namespace {

template <class T>
constexpr LawsIn<T> kTable{
    [](const Scene& scene) {
      return make_release_on_table(scene.scenario().release, scene.table<T>().contact, scene.body<T>(), scene.site());
    },
    [](const Scene& scene, DriftProblem<T>& problem) { problem.table = in_units(scene.table<T>(), problem.units); }};

template <class T>
Release<T> release_on_pivot(const Scene& scene) {
  const Scenario& scenario = scene.scenario();
  const T gravity = T(scene.site().gravity_m_s2);
  if (is_caged_top(scenario)) return CagedTop<T>(scenario).release(gravity);
  const Precession precession = scenario.release.precession;
  const bool is_steady = precession == Precession::steady_slow || precession == Precession::steady_fast;
  if (is_steady && masses_move(scenario))
    throw ScenarioError("/release/precession",
                        "no steady precession: masses move in the body; give {\"rate_rad_s\": ...} or \"none\"");
  if (!is_steady || !scenario.rotor) return make_release<T>(scenario.release, scene.body<T>(), gravity);
  if (!has_symmetric_cage(scenario))
    throw ScenarioError("/release/precession",
                        "no steady precession: with a rotor only one on axis 3 of a symmetric cage has it; give "
                        "{\"rate_rad_s\": ...} or \"none\"");
  Release<T> release = CagedTop<T>(scenario).release(gravity);
  release.w_XB_B[2] = T(scenario.release.spin_rad_s);  // of the cage, whose axis the rotor's momentum carries
  return release;
}
template <class T>
constexpr LawsIn<T> kPivot{release_on_pivot<T>, [](const Scene&, DriftProblem<T>&) {}};

/// Both axes turn in the carrier, a platform or the laboratory.
template <class T>
Release<T> release_in_gimbals(const Scene& scene) {
  const Scenario& scenario = scene.scenario();
  const Gimbals<T> gimbals = gimbals_of<T>(scenario);
  const Platform<T> platform = scenario.platform ? platform_of<T>(scene) : Platform<T>();
  const SinCos<T> half = real::sin_cos(T(platform.turn.angle(T(0)) / T(2)));
  const GimbalAngles<T>& angles = gimbals.release;
  Release<T> release;
  release.X = scenario.release.rates_relative_to;
  release.q_LB =
      Quaternion<T>{half.cos, Vec3<T>(half.sin * platform.turn.axis)} * gimbal_attitude(gimbals, angles.outer, angles.inner);
  const GimbalPose<T, T> pose{gimbals, real::sin_cos(angles.outer), real::sin_cos(angles.inner)};
  const Vec3<T> carrier_B = pose.into_body(pose.into_ring(Vec3<T>(platform.turn.angle_rate(T(0)) * platform.turn.axis)));
  release.w_XB_B = carrier_B + angles.outer_rate * pose.outer_axis_B() + Vec3<T>(T(0), angles.inner_rate, T(0));
  return release;
}
template <class T>
constexpr LawsIn<T> kSuspension{release_in_gimbals<T>, [](const Scene&, DriftProblem<T>&) {}};

constinit const TableLaws kTableLaws;
constinit const SuspensionLaws kSuspensionLaws;
constinit const MassLaws kMassLaws;
constinit const RotorLaws kRotorLaws;
constinit const PlatformLaws kPlatformLaws;
constinit const GimbalLaws kGimbalLaws;
constinit const PivotLaws kPivotLaws;

/// Both in the order of SupportKind.
constexpr auto kLaws = std::to_array<const PivotLaws*>(
    {&kTableLaws, &kSuspensionLaws, &kMassLaws, &kRotorLaws, &kPlatformLaws, &kPivotLaws, &kGimbalLaws, &kPivotLaws});
template <class T>
constexpr std::array kLawsIn = {kTable<T>, kSuspension<T>, kPivot<T>, kPivot<T>, kPivot<T>, kPivot<T>, kPivot<T>, kPivot<T>};
static_assert(kLaws.size() == kSupportCount && kLawsIn<double>.size() == kSupportCount);

}  // namespace

const PivotLaws& laws_of(const Scene& scene) { return *kLaws[static_cast<std::size_t>(scene.support().kind)]; }

template <class T>
const LawsIn<T>& laws_in(const Scene& scene) {
  return kLawsIn<T>[static_cast<std::size_t>(scene.support().kind)];
}
template const LawsIn<double>& laws_in(const Scene&);
template const LawsIn<float80>& laws_in(const Scene&);
template const LawsIn<float128>& laws_in(const Scene&);

}  // namespace earthtop
