// SPDX-License-Identifier: GPL-3.0-or-later
#include "budget/journey_effects.hpp"

#include <algorithm>
#include <string>

#include "budget/torque_size.hpp"
#include "earthtop/model/carrier.hpp"
#include "earthtop/model/laboratory_now.hpp"

namespace earthtop {
namespace {

/// The accelerations that a travelling laboratory feels beside gravity, in its own axes (m/s^2).
struct Aboard {
  Vec3<double> coriolis_L, inertial_L;

  Aboard(const Model<double>& model, double t) {
    const LaboratoryNow<double> now(model, t);
    std::array<std::array<double, 3>, 2> rows{};  // the velocity and its derivative, as L sees it
    model.journey.expand(JourneyPart::velocity_in_L, t, rows);
    const Vec3<double> v(rows[0][0], rows[0][1], rows[0][2]), slope(rows[1][0], rows[1][1], rows[1][2]);
    coriolis_L = 2 * v.cross(Vec3<double>(now.w_IL_L - now.w_EL_L));
    inertial_L = v.cross(now.w_EL_L) - slope;
  }
};

/// The size of a torque at the release and the largest, each in the attitude in which it is largest.
/// @param size  of the torque, from what is felt aboard
template <class Size>
std::array<double, 2> torque_on_journey(const Scene& scene, const Size& size) {
  const Model<double>& model = scene.model<double>();
  constexpr int kLooks = 1000;
  double largest = 0;
  for (int i = 0; i <= kLooks; ++i) largest = std::max(largest, size(Aboard(model, scene.scenario().duration_s * i / kLooks)));
  return {size(Aboard(model, 0)), largest};
}

/// The candidate for a part of the field at a travelling pivot, by the part of the journey that makes it.
/// @param field_A  gives it at a time, in the axes A of the integration
template <class Field>
Candidate field_part(const Scene& scene, JourneyPart part, const Field& field_A) {
  Candidate c;
  const Model<double>& model = scene.problem_without_rows<double>().model;
  c.input.journey = model.journey.only(part);
  c.torque = [moment_B = model.mass_moment_B, field_A](const FollowedStep& s) {
    return norm(field_torque(moment_B, seen_from(s, field_A(s.t))));
  };
  return c;
}

}  // namespace

std::array<double, 2> eotvos_torque(const Scene& scene) {
  const double moment = norm(scene.model<double>().mass_moment_B);
  return torque_on_journey(scene, [&](const Aboard& aboard) { return moment * norm(aboard.coriolis_L); });
}
std::array<double, 2> ballistic_torque(const Scene& scene) {
  const double moment = norm(scene.model<double>().mass_moment_B);
  return torque_on_journey(scene, [&](const Aboard& aboard) { return moment * norm(aboard.inertial_L); });
}

std::optional<Candidate> eotvos(const Scene& scene) {
  if (!is_felt(scene)) return std::nullopt;
  const Model<double>& model = scene.problem_without_rows<double>().model;
  Candidate c = field_part(scene, JourneyPart::velocity, [&model](double t) {
    return Vec3<double>(-2 * model.W_IL_L.cross(model.journey.at(JourneyPart::velocity, t)));
  });
  c.in_difference = scene.scenario().travel->eotvos == TravelEotvos::rotating;
  c.reason = std::string(kEotvosReason) + (c.in_difference ? "; the rotating motion alone feels it" : "; both motions feel it");
  return c;
}
std::optional<Candidate> ballistic(const Scene& scene) {
  if (!travels(scene)) return std::nullopt;
  const Model<double>& model = scene.problem_without_rows<double>().model;
  Candidate c = field_part(scene, JourneyPart::field, [&model](double t) { return model.journey.at(JourneyPart::field, t); });
  c.in_difference = false;
  c.reason = std::string(kBallisticReason) + "; it acts in both predictions";
  return c;
}
std::optional<Candidate> transport(const Scene& scene) {
  if (!travels(scene)) return std::nullopt;
  const Model<double>& model = scene.problem_without_rows<double>().model;
  Candidate c;
  c.in_difference = false;
  c.has_responses = false;
  c.reason = std::string(kTransportReason) + "; it acts in both predictions";
  c.torque = [&model](const FollowedStep& in_A) {
    FollowedStep s = in_A;
    see_rotating_from_journey(model, s, s.t);
    return coriolis_size(s, LaboratoryNow<double>(model, s.t).w_EL_L, model.S_BP_B);
  };
  return c;
}

}  // namespace earthtop
