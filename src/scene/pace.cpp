// SPDX-License-Identifier: GPL-3.0-or-later
// The rates of a scene and how long they last: what turns, what drives the motion, and what brings it to rest.
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "earthtop/model/gyrostat.hpp"
#include "earthtop/model/release.hpp"
#include "earthtop/scenario/support.hpp"
#include "scene/support_laws.hpp"

namespace earthtop {
namespace {

double extent(const std::array<double, 3>& v) { return real::hypot(v[0], v[1], v[2]); }

/// How far a mass is from the pivot at most, how fast it is, and the rate of its motion: of its turn or swing, or of the swing that a
/// way between two points is half of.
struct PathDemand {
  double reach_m = 0, speed_m_s = 0, rate_rad_s = 0;
};
PathDemand demand_of(const MovingMassSpec& mass) {
  PathDemand path;
  const double turning = 2 * std::numbers::pi * std::abs(mass.frequency_hz);
  switch (mass.motion) {
    case MassMotion::fixed: return {extent(mass.center_m), 0, 0};
    case MassMotion::harmonic:
    case MassMotion::circle: {
      const double arm = extent(mass.motion == MassMotion::circle ? mass.start_m : mass.amplitude_m);
      return {extent(mass.center_m) + arm, turning * arm, turning};
    }
    case MassMotion::waypoints: {
      constexpr double kFastest = 1.875;  // the slope of x^3 (10 - 15 x + 6 x^2) at x = 1/2
      for (std::size_t i = 0; i < mass.points_m.size(); ++i) {
        path.reach_m = std::max(path.reach_m, extent(mass.points_m[i]));
        if (i == 0) continue;
        const auto &a = mass.points_m[i - 1], &b = mass.points_m[i];
        const double time = mass.times_s[i] - mass.times_s[i - 1];
        path.speed_m_s = std::max(path.speed_m_s, kFastest * real::hypot(b[0] - a[0], b[1] - a[1], b[2] - a[2]) / time);
        path.rate_rad_s = std::max(path.rate_rad_s, std::numbers::pi / time);
      }
      return path;
    }
    case MassMotion::table:
      for (const FiledTable& table : mass.coordinates) {
        const AngleSpline<double> way(*table.rows);
        double reach = 0;
        for (const double x : table.rows->value) reach = std::max(reach, std::abs(x));
        const double speed = way.largest_rate();
        path.reach_m = real::hypot(path.reach_m, reach), path.speed_m_s = real::hypot(path.speed_m_s, speed);
        if (speed > 0) path.rate_rad_s = std::max(path.rate_rad_s, way.largest_acceleration() / speed);
      }
      return path;
  }
  return path;
}

/// The most that masses which move in a body may add to it.
struct MassesDemand : MassesPace {
  Mat3<double> least_inertia_B;  ///< of the body without them

  explicit MassesDemand(const Scene& scene) : least_inertia_B(scene.body<double>().I_BP_B) {
    std::vector<MovingMassSpec> moving;
    for (const MovingMassSpec& mass : scene.scenario().moving_masses) {
      if (!mass.moves()) continue;
      moving.push_back(mass);
      const PathDemand path = demand_of(mass);
      moment_kg_m += mass.mass_kg * path.reach_m;
      momentum_kg_m2_s += mass.mass_kg * path.reach_m * path.speed_m_s;
      rate_rad_s = std::max(rate_rad_s, path.rate_rad_s);
      joints += static_cast<double>(mass.times_s.size());
    }
    if (!moving.empty()) least_inertia_B = without_masses(scene.body<double>(), moving).I_BP_B;
  }
};

/// The numbers of the released body from which its rates are computed.
struct Released {
  const Body<double>& body;
  const Release<double>& release;
  Vec3<double> moments;  ///< principal moments without the moving masses, ascending (kg m^2)
  int axis;              ///< symmetry axis of the body, or -1
  Vec3<double> inside;   ///< momentum of a rotor (kg m^2/s)
  double momentum;
  bool masses_move;

  explicit Released(const Scene& scene)
      : body(scene.body<double>()),
        release(scene.release<double>()),
        moments(Eigen::SelfAdjointEigenSolver<Mat3<double>>(MassesDemand(scene).least_inertia_B, Eigen::EigenvaluesOnly)
                    .eigenvalues()),
        axis(scene.symmetry_axis()),
        inside(rotor_momentum(scene)),
        momentum(norm(Vec3<double>(body.I_BP_B * release.w_XB_B + inside)) + MassesDemand(scene).momentum_kg_m2_s),
        masses_move(earthtop::masses_move(scene.scenario())) {}

  double least() const { return moments[0]; }
  double largest() const { return moments[2]; }
  /// Returns the least moment about which gravity can turn the body; on a symmetric body gravity has no torque about the axis.
  double swinging() const { return axis >= 0 ? body.I_BP_B((axis + 1) % 3, (axis + 1) % 3) : least(); }

  /// Returns an upper bound on the rates at which the body turns and its axes circle the angular momentum (rad/s).
  double turning_rate() const {
    const Vec3<double>& w = release.w_XB_B;
    if (axis >= 0) return std::max(norm(w), momentum / swinging());
    if (masses_move || inside != Vec3<double>::Zero()) return norm(w) + momentum / least();
    const double twice_energy = w.dot(Vec3<double>(body.I_BP_B * w));
    return std::min(momentum / least(), std::sqrt(twice_energy / least()));
  }
};

/// Returns the largest rate of a pendulum that falls from upright under this torque (rad/s).
double falling_rate(double torque, double moment) { return 2 * std::sqrt(torque / moment); }

double gradient_torque(const Scene& scene, const Released& top) {
  const auto& given = scene.scenario().effects.applied.gravity_gradient;
  if (!given) return 0;
  double strength = 0;
  for (const GradientTerm<double>& term : gradient_terms(gradient_L(*given, scene.site())))
    strength = std::max(strength, std::abs(term.strength));
  return strength * (top.largest() - top.least());
}

/// What an unequal support and a given torque do at most: the torque that holds the axis (N m), and the rate that a torque
/// gives a body within the run (rad/s) or with which it changes.
struct FurtherDemand {
  double support_N_m = 0, given_rate_rad_s = 0;

  FurtherDemand(const Scene& scene, double least_moment) {
    const AppliedTorquesSpec& spec = scene.scenario().effects.applied;
    if (spec.unequal_support) support_N_m = scene.model<double>().applied.support.largest();
    if (!spec.given_torque) return;
    const auto& [x, y, z] = spec.given_torque->torque_N_m;
    double torque = real::hypot(x, y, z);
    for (const FiledTable& component : spec.given_torque->components)
      if (component.rows)
        for (const double value : component.rows->value) torque += std::abs(value);
    given_rate_rad_s =
        torque * scene.scenario().duration_s / least_moment + 2 * std::numbers::pi * std::abs(spec.given_torque->frequency_hz);
  }
};

/// A rate w that friction of torque c |w|^(n + 1) alone reduces, in a body of moment I: dw/dt = -r w^(n+1), r = c / I.
struct Braking {
  double r, n;

  /// Returns a bound on the integral of the rate over the time (rad).
  double turned(double w, double time) const {
    const double rate = r * real::pow(w, n);
    if (!(rate * time > 0)) return w * time;
    if (n == 0) return w * -real::expm1(-rate * time) / rate;
    // w(t) = w0 (1 + n rate t)^(-1/n); for n >= 1 it is bounded by the formula for n = 1.
    return std::min(w * time, w * real::log1p(n * rate * time) / (n * rate) * (n < 1 ? 1 / (1 - n) : 1));
  }
  /// Returns the integral of the damping rate (1): for viscous friction the time over its time constant, otherwise a logarithm.
  double damping(double w, double time) const {
    const double rate = r * real::pow(w, n);
    return n == 0 ? rate * time : (1 + n) / n * real::log1p(n * rate * time);
  }
};

/// The contribution of friction to the pace.
class FrictionPace {
 public:
  FrictionPace(const Scene& scene, const Released& top, double rate, double driven_rate, double torque)
      : top_(top), time_(scene.scenario().duration_s), rate_(rate), driven_(driven_rate), torque_(torque) {
    const AppliedTorquesSpec& applied = scene.scenario().effects.applied;
    turned_ = rate_ * time_;
    swung_s_ = time_;
    if (applied.viscous_N_m_s > 0) viscous(applied.viscous_N_m_s, top.least(), top.largest());
    if (const auto& k = applied.viscous_by_axis_N_m_s) {
      const auto [least, most] = std::ranges::minmax(*k);
      if (most > 0) damp("/effects/viscous_torque_N_m_s", most / top.least() * time_);
      if (least > 0) brake(least, top.largest());
    }
    if (applied.gimbal && applied.gimbal->damping_N_m_s > 0) {
      const double across = std::min(top.body.I_BP_B(0, 0), top.body.I_BP_B(1, 1));
      damp("/effects/gimbal", applied.gimbal->damping_N_m_s / across * time_);
    }
    if (scene.support().has_rotor && scene.scenario().rotor) bearing(*scene.scenario().rotor);
    if (applied.quadratic_N_m_s2 > 0) quadratic(applied.quadratic_N_m_s2);
    if (applied.air_drag) disc(*applied.air_drag, scene.site(), std::abs(scene.rotation_rate_rad_s()));
    if (applied.coulomb_N_m > 0) dry(applied.coulomb_N_m);
  }

  double turned_rad() const { return turned_; }
  /// Returns how long a pendulum swings before friction brings it to rest (s).
  double swung_s() const { return swung_s_; }
  double damping() const { return damping_; }
  double halts() const { return halts_; }
  const StiffFriction& stiffest() const { return stiffest_; }

 private:
  void damp(std::string_view pointer, double damping) {
    damping_ += damping;
    if (damping > stiffest_.damping) stiffest_ = {pointer, damping};
  }

  /// Number of time constants after which an exponentially decaying motion has fallen below the tolerances.
  static constexpr double kSeen = 10;

  void viscous(double k, double least, double largest) {
    damp("/effects/viscous_torque_N_m_s", k / least * time_);
    brake(k, largest);
  }
  void brake(double k, double largest) {
    turned_ = std::min(turned_, Braking{k / largest, 0}.turned(rate_, time_));
    // An overdamped pendulum creeps and does not swing.
    swung_s_ = std::min(swung_s_, kSeen * largest / k);
  }
  /// A bearing turns rotor and body against each other. Regularised dry friction is steepest where the rotor stands still.
  void bearing(const RotorSpec& rotor) {
    const double across = 1 / rotor.axial_kg_m2 + 1 / top_.least();
    damp("/rotor/viscous_torque_N_m_s", rotor.viscous_torque_N_m_s * across * time_);
    if (rotor.coulomb_torque_N_m > 0)
      damp("/rotor/coulomb_torque_N_m", rotor.coulomb_torque_N_m / rotor.regularisation_rad_s * across * time_);
  }
  void quadratic(double c) {
    // The Jacobian is largest for the least moment. A falling body reaches, once, the rate at which drag balances the torque.
    const double falling = std::sqrt(torque_ / c), of_fall = 2 * c / top_.least();
    damp("/effects/quadratic_torque_N_m_s2",
         top_.largest() / top_.least() * Braking{c / top_.largest(), 1}.damping(rate_, time_) +
             of_fall * std::min(3.0, falling * time_) + of_fall * driven_ * time_);
    turned_ = std::min(turned_, Braking{c / top_.largest(), 1}.turned(rate_, time_));
  }
  void disc(const AirDragSpec& drag, const Site& site, double earth_rate) {
    const double w3 = std::abs(top_.release.w_XB_B[2]), I3 = top_.body.I_BP_B(2, 2);
    AppliedTorquesSpec spec;
    spec.air_drag = drag;
    const auto applied = make_applied_torques<double>(spec, site, w3, 0, 0);
    const bool turbulent = applied.disc_turbulent > 0;
    const Braking braking{std::max(applied.disc_turbulent, applied.disc_laminar) / I3, turbulent ? 0.8 : 0.5};
    damp("/effects/air_drag", braking.damping(w3, time_) + (1 + braking.n) * braking.r * real::pow(driven_, braking.n) * time_);
    // The disc's drag brakes only the spin.
    const double rest = std::max(0.0, rate_ - w3);
    constexpr double kSigns = 4 / std::numbers::pi;
    // After the spin has ended, the Earth's rotation drives it back and forth with each swing of the axis, against the drag.
    // If the damping is faster than the swing, the drag has a corner at each reversal.
    const double swing = torque_ > 0 ? falling_rate(torque_, top_.swinging()) : 0;
    const double held = real::pow(earth_rate * swing / braking.r, 1 / (1 + braking.n)),
                 stiff = braking.r * real::pow(held, braking.n);
    damp("/effects/air_drag", (1 + braking.n) * stiff * time_);
    if (stiff > 0) halts_ += kSigns * swing * time_ * std::min(1.0, stiff / swing);
    // For a body that is not symmetric about axis 3 the rate about it changes sign; there the drag has no higher derivatives.
    if (top_.axis != 2 && stiffest_.damping > 1) halts_ += kSigns * rest * time_;
    turned_ = std::min(turned_, rest * time_ + braking.turned(w3, time_));
  }
  void dry(double torque) {
    const double spinning_s = top_.momentum / torque;
    const double swing_s = torque_ > 0 ? std::numbers::pi / falling_rate(torque_, top_.swinging()) : time_;
    const double swings = torque_ > 0 ? std::min(time_ / swing_s, 2 * torque_ / torque) : 0;
    halts_ += 4 + swings;
    swung_s_ = std::min({swung_s_, time_, spinning_s + swings * swing_s});
    turned_ = std::min(turned_, rate_ * std::min(time_, spinning_s));
  }

  const Released& top_;
  double time_, rate_, driven_, torque_;
  double turned_ = 0, swung_s_ = 0, damping_ = 0, halts_ = 0;
  StiffFriction stiffest_;
};

/// The torques and the platform that act on a body, and how fast they move it.
struct Driven {
  Released top;
  PlatformDemand platform;
  double gravity_torque, gradient;  ///< largest torques (N m); an unequal support's is counted with gravity's
  double given_rate;                ///< by a given torque (rad/s)

  explicit Driven(const Scene& scene) : top(scene) {
    // A platform affects the body only if the pivot is off the platform's centre, or through friction or a gimbal.
    const auto& carrier = scene.scenario().platform;
    const AppliedTorquesSpec& applied = scene.scenario().effects.applied;
    const bool felt = scene.scenario().travel ||
                      (carrier && (carrier->pivot_offset_m != std::array<double, 3>{} || applied.friction() || applied.gimbal));
    if (felt) platform = scene.platform_demand();
    const FurtherDemand further(scene, top.least());
    gravity_torque = scene.gravity_torque_N_m(platform.acceleration_m_s2) + further.support_N_m;
    given_rate = further.given_rate_rad_s;
    gradient = gradient_torque(scene, top);
  }
  double swinging_rate() const { return falling_rate(gravity_torque, top.swinging()) + falling_rate(gradient, top.swinging()); }
  FrictionPace friction(const Scene& scene) const {
    return {scene, top, top.turning_rate() + given_rate, platform.rate_rad_s, gravity_torque + gradient};
  }
};

/// Returns the angle through which a symmetric top turns without its spin (rad), for a top with symmetry axis 3. Its nutation
/// slows down with its spin.
double turned_without_spin(const Scene& scene, const Driven& driven, const FrictionPace& friction) {
  const double time = scene.scenario().duration_s, unbraked = driven.top.turning_rate() * time;
  const double braked_s = unbraked > 0 ? std::min(1.0, friction.turned_rad() / unbraked) * time : time;
  return driven.given_rate * time + driven.top.momentum / driven.top.body.I_BP_B(0, 0) * braked_s +
         driven.swinging_rate() * friction.swung_s() +
         (std::abs(scene.rotation_rate_rad_s()) + driven.platform.rate_rad_s) * time;
}
/// Returns the rate of a wheel whose axis a gimbal keeps level (rad/s): that of its turn about Up, driven by the Earth.
double compass_rate(const Scene& scene, const Driven& driven) {
  const Mat3<double> R_LB = rotation_matrix(driven.top.release.q_LB);
  const double turning = std::abs(R_LB.row(2).dot(driven.top.release.w_XB_B)), W = std::abs(scene.rotation_rate_rad_s());
  return turning + W + driven.swinging_rate() + std::sqrt(driven.top.momentum * W / driven.top.body.I_BP_B(0, 0));
}

/// Returns the extra sampling caused by rounding for a wheel in a gimbal, in radians per radian of the motion, as measured.
/// Where such a wheel hardly drifts, as at a pole or with its axis in the meridian, the Earth's rate about the vertical leaves
/// only rounding errors, and a fine error control takes these for step errors and shortens its steps.
double looks_at_rounding(const Scene& scene) {
  if (!scene.scenario().effects.applied.gimbal || scene.rotation_rate_rad_s() == 0) return 0;
  constexpr double kDegree = std::numbers::pi / 180, kFelt = 1e-4, kFew = 6, kMost = 1000;
  const double latitude = scene.site().latitude_deg * kDegree;
  const double driving = std::abs(real::cos(latitude) * real::sin(scene.scenario().release.azimuth_deg * kDegree));
  const double felt = kFelt * std::abs(real::sin(latitude));
  return felt > driving ? std::min(kMost, kFew * real::pow(felt / std::max(driving, 1e-30), 0.6)) : 0;
}

}  // namespace

/// How fast a journey turns the laboratory, and how it accelerates it.
PlatformDemand demand_of(const TravelSpec& travel, double earth_rate_rad_s) {
  constexpr double kFastest = 1.875, kSteepest = 5.7735;  // the largest slopes of x^3 (10 - 15 x + 6 x^2)
  constexpr double kRadius_m = 6.35e6, kDegree = std::numbers::pi / 180;
  double speed = travel.speed_m_s, largest = speed, turning = 0, acceleration = 0;
  for (const TravelLeg& leg : travel.legs) {
    const double after = leg.speed_m_s.value_or(speed), turn = kFastest * std::abs(leg.turn_deg) * kDegree / leg.duration_s;
    const double climb = std::abs(leg.climb_m) / leg.duration_s;
    largest = std::max({largest, after, kFastest * climb});
    turning = std::max({turning, turn, kFastest / leg.duration_s});
    acceleration = std::max(acceleration, real::hypot(kFastest * std::abs(after - speed) / leg.duration_s,
                                                      turn * std::max(speed, after), kSteepest * climb / leg.duration_s));
    speed = after;
  }
  if (travel.path == TravelPath::table) {
    const AngleSpline<double> north(*travel.table[0].rows), east(*travel.table[1].rows), up(*travel.table[2].rows);
    const double metres = kRadius_m * kDegree;
    largest = real::hypot(metres * north.largest_rate(), metres * east.largest_rate(), up.largest_rate());
    acceleration =
        real::hypot(metres * north.largest_acceleration(), metres * east.largest_acceleration(), up.largest_acceleration());
    if (largest > 0) turning = acceleration / largest;
  }
  const double transport = largest / kRadius_m;
  return {transport + turning, acceleration + (2 * std::abs(earth_rate_rad_s) + transport) * largest};
}

PlatformDemand demand_of(const Scene& scene) {
  const auto& given = scene.scenario().platform;
  PlatformDemand journey;
  if (const auto& travel = scene.scenario().travel) journey = demand_of(*travel, scene.rotation_rate_rad_s());
  if (!given) return journey;
  const double amplitude = std::abs(given->amplitude_rad);
  double omega = 2 * std::numbers::pi * std::abs(given->frequency_hz);
  double rate =
      std::abs(given->rate_rad_s) + std::abs(given->acceleration_rad_s2) * scene.scenario().duration_s + amplitude * omega;
  double alpha = std::abs(given->acceleration_rad_s2) + amplitude * omega * omega;
  if (given->table.rows) {
    const AngleSpline<double> turn(*given->table.rows);
    rate = turn.largest_rate();
    alpha = turn.largest_acceleration();
    if (rate > 0) omega = alpha / rate;  // exact for a harmonic turn
  }
  if (given->motion == PlatformMotion::course) rate = omega = journey.rate_rad_s, alpha = rate * rate;
  const auto& d = given->pivot_offset_m;
  const double offset = real::hypot(d[0], d[1], d[2]), turning = rate + std::abs(scene.rotation_rate_rad_s());
  return {std::max(rate, omega) + journey.rate_rad_s, (turning * turning + alpha) * offset + journey.acceleration_m_s2};
}

MassesPace masses_pace(const Scene& scene) { return MassesDemand(scene); }

bool has_axial_moment(const Scene& scene) {
  const auto& rotor = scene.scenario().rotor;
  return rotor && (!scene.support().has_moving_parts() || rotor->drive != RotorDrive::none);
}

Vec3<double> rotor_momentum(const Scene& scene) {
  const auto& given = scene.scenario().rotor;
  if (!given || !scene.support().has_moving_parts()) return Vec3<double>::Zero();
  const Rotor<double> rotor = make_rotor<double>(*given);
  const double carried = rotor.driven ? 0 : rotor.axis_B.dot(scene.release<double>().w_XB_B);
  double rate = std::abs(rotor.spin + carried) + std::abs(given->acceleration_rad_s2) * scene.scenario().duration_s +
                std::abs(given->amplitude_rad_s);
  if (const auto& table = given->table.rows)
    for (const double value : table->value) rate = std::max(rate, std::abs(value));
  return rotor.axial * rate * rotor.axis_B;
}

double PivotLaws::fastest_rate(const Scene& scene) const {
  const Mat3<double>& inertia = scene.body<double>().I_BP_B;
  const Eigen::SelfAdjointEigenSolver<Mat3<double>> moments(inertia, Eigen::EigenvaluesOnly);
  const double least_moment = moments.eigenvalues()[0];
  const PlatformDemand& platform = scene.platform_demand();
  const FurtherDemand further(scene, least_moment);
  const double torque = scene.gravity_torque_N_m(platform.acceleration_m_s2) + further.support_N_m;
  const double rate = norm(Vec3<double>(inertia * scene.release<double>().w_XB_B + rotor_momentum(scene))) / least_moment +
                      further.given_rate_rad_s + 2 * std::sqrt(torque / least_moment) + std::abs(scene.rotation_rate_rad_s()) +
                      platform.rate_rad_s;
  return std::max(rate, 1 / scene.scenario().duration_s);
}

double MassLaws::fastest_rate(const Scene& scene) const {
  const MassesDemand masses(scene);
  const Eigen::SelfAdjointEigenSolver<Mat3<double>> moments(masses.least_inertia_B, Eigen::EigenvaluesOnly);
  const double least_moment = moments.eigenvalues()[0];
  const PlatformDemand& platform = scene.platform_demand();
  const double torque = scene.gravity_torque_N_m(platform.acceleration_m_s2) +
                        masses.moment_kg_m * (std::abs(scene.site().gravity_m_s2) + platform.acceleration_m_s2) +
                        FurtherDemand(scene, least_moment).support_N_m;
  const Vec3<double> momentum = scene.body<double>().I_BP_B * scene.release<double>().w_XB_B + rotor_momentum(scene);
  const double rate = (norm(momentum) + masses.momentum_kg_m2_s) / least_moment + 2 * std::sqrt(torque / least_moment) +
                      masses.rate_rad_s + FurtherDemand(scene, least_moment).given_rate_rad_s +
                      std::abs(scene.rotation_rate_rad_s()) + platform.rate_rad_s;
  return std::max(rate, 1 / scene.scenario().duration_s);
}

double MassLaws::evaluation_seconds(const Scene& scene, const IntegrationOptions& options) const {
  constexpr double kSums = 3e-7, kMass = 1.2e-7;  // of an order with one harmonic path, and with 64
  const auto moving = std::ranges::count_if(scene.scenario().moving_masses, &MovingMassSpec::moves);
  return RotorLaws::evaluation_seconds(scene, options) + kSums + kMass * static_cast<double>(moving);
}

Paced MassLaws::paced(const Scene& scene) const {
  Paced paced = RotorLaws::paced(scene);
  const MassesDemand masses(scene);
  const double moved = masses.rate_rad_s * scene.scenario().duration_s;
  Pace& pace = paced.pace;
  pace.joints += masses.joints;
  pace.turning_rad += moved, pace.reduced_turning_rad += moved;
  return paced;
}

Paced PivotLaws::paced(const Scene& scene) const {
  const Scenario& scenario = scene.scenario();
  const Driven driven(scene);
  const FrictionPace friction = driven.friction(scene);
  const double time = scenario.duration_s, swinging = driven.swinging_rate();
  const double carried = std::abs(scene.rotation_rate_rad_s()) + driven.platform.rate_rad_s;

  Pace pace;
  pace.duration_s = time;
  pace.rows = scene.rows();
  pace.judgement_looks = kJudgementLooks;
  pace.axis_rate_rad_s = scene.fastest_rate_rad_s();
  for (const FiledTable* table : tables_of(scenario)) pace.joints += static_cast<double>(table->rows->t_s.size());
  pace.turning_rad = std::max(1.0, friction.turned_rad() + swinging * friction.swung_s() + carried * time);
  pace.undamped_rest_rad = swinging * (time - friction.swung_s());
  // The limit keeps a scene from being refused only because of the sampling that rounding causes.
  constexpr double kMostLooks = 1e9;
  pace.watched_angle_rad =
      std::max(scene.fastest_rate_rad_s() * time, std::min(kMostLooks, looks_at_rounding(scene) * pace.turning_rad));
  pace.damping = friction.damping();
  pace.halts = friction.halts();
  pace.reduced_turning_rad = pace.turning_rad, pace.reduced_damping = pace.damping;
  if (driven.top.axis == 2) {
    const bool level = scenario.effects.applied.gimbal.has_value();
    const double turned = level ? compass_rate(scene, driven) * time : turned_without_spin(scene, driven, friction);
    pace.reduced_turning_rad = std::min(pace.turning_rad, std::max(1.0, turned));
    const double unbraked = level ? compass_rate(scene, driven)
                                  : driven.top.momentum / driven.top.body.I_BP_B(0, 0) + swinging + carried + driven.given_rate;
    pace.axis_rate_rad_s = std::min(pace.axis_rate_rad_s, std::max(unbraked, 1 / time));
  }
  return {pace, friction.stiffest()};
}

}  // namespace earthtop
