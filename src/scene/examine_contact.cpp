// SPDX-License-Identifier: GPL-3.0-or-later
#include "scene/examine_contact.hpp"

#include <fmt/core.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <utility>

#include "earthtop/model/contact_release.hpp"
#include "earthtop/model/general_contact.hpp"
#include "text/number_words.hpp"

namespace earthtop {
namespace {

using input::Section;

/// The fastest relaxation of a slip (1/s) that steps are allowed to follow. A minute of it is some 1e7 steps.
constexpr double kFastestRelaxation = 1e5;

/// The release of both predictions on the table, in its axes and SI units.
class Touchdown {
 public:
  explicit Touchdown(const Scene& scene)
      : spec_(*scene.scenario().contact),
        release_(scene.release<double>()),
        start_(make_contact_release<double>(spec_, {})),
        R_HB_(rotation_matrix(release_.q_LB)) {
    const EffectsSpec& effects = scene.scenario().effects;
    const TorqueWeights<double> weights{effects.coriolis ? 1.0 : 0.0, effects.transverse ? 1.0 : 0.0,
                                        effects.centrifugal ? 1.0 : 0.0};
    const Model<double> model =
        make_model<double>(scene.body<double>(), scene.site(), scene.rotation_rate_rad_s(), weights, nullptr);
    const Model<double> turned = in_table_axes(model, start_.q_LH);
    gravity_ = turned.apparent_gravity_L, W_ = turned.W_IL_L;
    contact_ = make_contact<double>(spec_, scene.body<double>(), scene.site(), weights, nullptr);
  }

  const ContactSpec& spec() const { return spec_; }
  bool is_symmetric() const { return earthtop::is_symmetric(contact_); }
  Vec3<double> r_c() const { return R_HB_ * contact_.p_OC_B; }
  double tilt_deg() const { return real::atan2(real::hypot(R_HB_(0, 2), R_HB_(1, 2)), R_HB_(2, 2)) * 180 / std::numbers::pi; }
  /// The rate relative to the table (rad/s) on the Earth, or without its rotation.
  Vec3<double> rate(bool on_earth) const {
    const Vec3<double> w = R_HB_ * release_.w_XB_B;
    return on_earth && release_.X == RatesRelativeTo::inertial ? Vec3<double>(w - W_) : w;
  }

  /// The table's reaction. @param without  a coefficient that is left out
  ContactReaction<double> reaction(bool on_earth, double Contact<double>::*without = nullptr) const {
    const Vec3<double> normal = Vec3<double>::UnitZ(), w = rate(on_earth), slip = this->slip(on_earth);
    Contact<double> contact = contact_;
    if (without) contact.*without = 0;
    // The exact law of dry friction holds a tip that does not slip.
    if (contact.law == ContactLaw::coulomb && contact.slip_floor == 0 && is_round_off(norm(slip)))
      contact.law = ContactLaw::rolling;
    const ContactSurroundings<double> around{normal, gravity_, on_earth ? W_ : Vec3<double>::Zero(), Mat3<double>::Zero()};
    const Vec3<double> momentum = turned_tensor(R_HB_, contact.I_BC_B) * w;
    return general_rates(contact, around, {R_HB_, momentum, slip, start_.p_O}).reaction;
  }

  /// The slip at release (m/s).
  Vec3<double> slip(bool on_earth) const { return slip_at_release(start_, contact_, rate(on_earth), r_c()); }
  /// Whether a slip is rounding of its terms.
  bool is_round_off(double slip) const {
    return slip <= 1e-12 * norm(rate(true)) * (norm(contact_.p_OC_B) + spec_.tip_radius_m);
  }
  /// The difference of both predictions' slips over that of their rates (m).
  double slip_apart_m() const {
    if (release_.X != RatesRelativeTo::inertial || !(norm(W_) > 0)) return 0;
    return norm(slip_difference_at_release(start_, contact_, Vec3<double>(W_ / norm(W_)), r_c()));
  }

  /// Below this the normal force is rounding of its terms (N): weight and centripetal force.
  double round_off_N() const {
    const double w = norm(rate(true));
    return 1e-12 * contact_.mass * (norm(gravity_) + w * w * (norm(contact_.p_OC_B) + spec_.tip_radius_m));
  }

  /// The slip velocity per friction impulse (1/kg) in the direction in which it is largest.
  double mobility() const {
    const Vec3<double> s = -(spec_.tip_radius_m * Vec3<double>::UnitZ() + r_c());
    const Mat3<double> inverse = turned_tensor(R_HB_, contact_.I_BC_B_inverse);
    const Vec3<double> x = s.cross(Vec3<double>::UnitX()), y = s.cross(Vec3<double>::UnitY());
    const double xx = x.dot(inverse * x), yy = y.dot(inverse * y), xy = x.dot(inverse * y);
    return 1 / contact_.mass + (xx + yy) / 2 + real::hypot((xx - yy) / 2, xy);
  }

  double normal_force_N() const { return std::max(0.0, reaction(true).normal_force); }
  double largest_friction_N() const { return spec_.friction_coefficient * normal_force_N(); }

  /// The friction per slip where the slip is small (kg/s).
  double slope() const {
    switch (spec_.law) {
      case ContactLaw::frictionless:
      case ContactLaw::rolling: break;
      case ContactLaw::viscous: return spec_.sliding_viscosity_N_s_m;
      case ContactLaw::viscous_load: return spec_.sliding_viscosity_s_m * normal_force_N();
      case ContactLaw::coulomb:
        if (spec_.regularisation_m_s > 0) return largest_friction_N() / spec_.regularisation_m_s;
        break;  // the exact law's stops are events, which no step has to resolve
      case ContactLaw::contensou:
        if (spec_.friction_coefficient == 0) return 0;
        return largest_friction_N() / (contact_.slip_of_spin * spec_.patch_radius_m * std::abs(rate(true)[2]));
    }
    return 0;
  }

 private:
  const ContactSpec& spec_;
  const Release<double>& release_;
  ContactRelease<double> start_;
  Mat3<double> R_HB_;
  Contact<double> contact_;
  Vec3<double> gravity_, W_;
};

/// The equations divide by the moments about the centre of mass; those of a point or of a thin rod are 0.
bool check_moments(const Section& body, const Scene& scene) {
  const Body<double>& top = scene.body<double>();
  const auto moments = [](const Mat3<double>& m) {
    return Eigen::SelfAdjointEigenSolver<Mat3<double>>(m, Eigen::EigenvaluesOnly).eigenvalues();
  };
  const double smallest = moments(top.I_BBcm_B())[0], largest = moments(top.I_BP_B)[2];
  if (smallest > 32 * real::epsilon<double>() * largest) return true;
  const std::string missing = missing_moments(top.I_BBcm_B());
  body.refuse(body.has("solids") ? "solids" : "inertia",
              fmt::format("{}; on a table, where the body turns about its centre of mass, all three moments must be above 0",
                          missing.empty() ? fmt::format("a principal moment about the centre of mass is {:.3g} kg m^2",
                                                        std::max(0.0, smallest))
                                          : "about the centre of mass " + missing));
  return false;
}

/// The coefficients to which friction and its moment are proportional, by their keys.
constexpr std::pair<const char*, double Contact<double>::*> kCoefficients[] = {
    {"friction_coefficient", &Contact<double>::coefficient},
    {"sliding_viscosity_s_m", &Contact<double>::viscosity},
    {"spinning_friction_m", &Contact<double>::spinning_length},
    {"rolling_resistance_m", &Contact<double>::rolling_length}};

/// Refuses a release without a unique force of the table. The denominator of the force is linear in each coefficient: the one
/// whose absence leaves most of it has a limit.
void refuse_paradox(const Section& root, const Touchdown& touchdown, bool on_earth) {
  const Section contact = root.section("contact");
  const double found = touchdown.reaction(on_earth).denominator;
  double most = std::max(0.0, found);
  const char* key = nullptr;
  for (const auto& [name, member] : kCoefficients)
    if (const double without = touchdown.reaction(on_earth, member).denominator; contact.has(name) && without > most)
      key = name, most = without;
  const auto given = key ? contact.number(key) : std::nullopt;
  constexpr double kRoundedDown = 0.9995;  // so that the number given is allowed
  const std::string remedy =
      given ? fmt::format("{} must be below {:.4g} in this release", key, kRoundedDown * *given * most / (most - found))
            : "give less friction and less resistance";
  const std::string message = fmt::format(
      "no unique force of the table exists at the release (Painleve's paradox: friction presses the tip into the "
      "table more than the table can push); {}, or another tilt or direction of slip",
      remedy);
  given ? contact.refuse(key, message) : root.refuse("contact", message);
}

/// Checks that the table pushes, and that there is one force with which it does.
bool check_reaction(const Section& root, const Touchdown& touchdown) {
  for (const bool on_earth : {true, false}) {
    const ContactReaction<double> reaction = touchdown.reaction(on_earth);
    if (!std::isfinite(reaction.denominator) || !std::isfinite(reaction.normal_force * touchdown.mobility())) {
      root.refuse("contact", "the forces at the release are too large for a double; give a body and rates of everyday size");
      return false;
    }
    if (!(reaction.denominator > 0)) {
      refuse_paradox(root, touchdown, on_earth);
      return false;
    }
    if (!(reaction.normal_force > touchdown.round_off_N())) {
      const double N = std::abs(reaction.normal_force) < touchdown.round_off_N() ? 0 : reaction.normal_force;
      root.refuse("contact",
                  fmt::format("the tip leaves the table at once: the normal force at the release would be {:.3g} N, and a "
                              "table only pushes; release the top more slowly, give it weight, or leave the contact out",
                              N));
      return false;
    }
  }
  return true;
}

/// Checks that a tip which the exact law of dry friction finds without slip rolls on in both predictions.
bool check_hold(const Section& contact, const Touchdown& touchdown) {
  const ContactSpec& spec = touchdown.spec();
  if (spec.law != ContactLaw::coulomb || spec.regularisation_m_s > 0 || !touchdown.is_round_off(norm(touchdown.slip(false))))
    return true;
  if (touchdown.slip_apart_m() > 1e-12 * (norm(touchdown.r_c()) + spec.tip_radius_m)) {
    contact.refuse(
        "start",
        "the tip is released without slip in the non-rotating prediction, and with a little in the rotating one, whose "
        "rates relative to the table differ by the Earth's: dry friction would stop it with a jump; take \"rolling\", "
        "or release it with a velocity");
    return false;
  }
  for (const bool on_earth : {true, false}) {
    const ContactReaction<double> reaction = touchdown.reaction(on_earth);
    const double needed = norm(reaction.friction) / reaction.normal_force;
    if (needed < spec.friction_coefficient) continue;
    contact.refuse(
        "friction_coefficient",
        fmt::format("the tip is released without slip, and to roll it needs a friction of {:.4g} times the normal force: it "
                    "slips at once, and how the slip begins is not computed; release it with a velocity, or take "
                    "\"contensou\"",
                    needed));
    return false;
  }
  return true;
}

/// Returns a limit as a message gives it, rounded up to three digits, so that the number given is allowed.
std::string rounded_up(double x) { return fmt::format("{:.3g}", 1.005 * x); }

/// Checks that steps can follow the slip as it dies out. Only the regularisation of dry friction is without meaning for the top
/// itself and is refused; the others are warned of.
void check_relaxation(const Section& contact, const Touchdown& touchdown) {
  const ContactSpec& spec = touchdown.spec();
  const double rate = touchdown.slope() * touchdown.mobility();
  if (!(rate > kFastestRelaxation)) return;
  const std::string followed = "which every step of an explicit method has to follow";
  // A quotient by the regularisation can be too large for a double, and its least value is found without it.
  constexpr double kLargestShown = 1e300;
  if (spec.law == ContactLaw::coulomb)
    contact.refuse(
        "regularisation_m_s",
        fmt::format("{} m/s makes a slip die out at {:.3g} per second, {}; at least {} m/s, for {:g} per second, or 0 for "
                    "the exact law, whose stops are events",
                    spec.regularisation_m_s, std::min(rate, kLargestShown), followed,
                    rounded_up(touchdown.largest_friction_N() * touchdown.mobility() / kFastestRelaxation),
                    kFastestRelaxation));
  else if (spec.law == ContactLaw::contensou && std::isinf(rate))
    contact.warn("law",
                 "a top that does not turn about the normal of the table is held by dry friction, and \"contensou\" has a "
                 "corner where its slip ends; give it a spin, or take \"coulomb\"");
  else
    contact.warn(spec.law == ContactLaw::contensou      ? "patch_radius_m"
                 : spec.law == ContactLaw::viscous_load ? "sliding_viscosity_s_m"
                                                        : "sliding_viscosity_N_s_m",
                 fmt::format("a slip dies out at {:.3g} per second, {}: the run takes a long time; is the unit right?",
                             std::min(rate, kLargestShown), followed));
}

}  // namespace

double slip_relaxation_rate_per_s(const Scene& scene) {
  const Touchdown touchdown(scene);
  return touchdown.slope() * touchdown.mobility();
}

void check_contact(const Section& root, const Scene& scene) {
  const Section contact = root.section("contact");
  const ContactSpec& spec = *scene.scenario().contact;
  if (!check_moments(root.section("body"), scene)) return;
  const Touchdown touchdown(scene);
  if (spec.max_tilt_deg && !(*spec.max_tilt_deg > touchdown.tilt_deg()))
    contact.refuse(
        "max_tilt_deg",
        fmt::format("{} deg is not above the tilt of the release, {} deg: the rim would touch at once; give a larger "
                    "angle, or leave it out",
                    *spec.max_tilt_deg, told_apart(touchdown.tilt_deg(), *spec.max_tilt_deg, 6).first));
  if (const double height = spec.tip_radius_m + touchdown.r_c()[2]; height < 0)
    root.warn("contact", fmt::format("the centre of mass lies {:.3g} m below the table at the release; is the sign of "
                                     "/body/center_of_mass_m right, and the tilt at most 90 deg?",
                                     -height));
  if (!check_reaction(root, touchdown)) return;
  if (spec.law == ContactLaw::coulomb && spec.regularisation_m_s == 0 && !touchdown.is_symmetric())
    contact.refuse("regularisation_m_s",
                   "the exact law, whose slip stops, is integrated for bodies that are symmetric about axis 3 only; give a "
                   "regularisation above 0, or take \"contensou\"");
  if (!check_hold(contact, touchdown)) return;
  check_relaxation(contact, touchdown);
}

void warn_of_contact(const Section& contact, const Scene& scene) {
  const ContactSpec& spec = *scene.scenario().contact;
  const Body<double>& body = scene.body<double>();
  const double gyration = std::sqrt(std::max(0.0, body.I_BBcm_B().trace() / 2 / body.mass));
  const double size = 2 * (gyration + norm(body.p_PBcm_B));  // a ball has 1.3 times its radius of gyration
  const double r = spec.tip_radius_m;
  if (!std::isfinite(gyration)) return;
  if (r > 1 || r > size)
    contact.warn("tip_radius_m", fmt::format("{} m is larger than the body, whose radius of gyration is {:.2g} m; are these "
                                             "millimetres (write {:.6g})?",
                                             r, gyration, r / 1000));
  if (spec.patch_radius_m > r && spec.law == ContactLaw::contensou)
    contact.warn("patch_radius_m",
                 fmt::format("{} m is larger than the radius of the tip, {} m, and a tip touches only with a small part of it, "
                             "about 3e-5 m for steel on glass; are these millimetres (write {:.6g})?",
                             spec.patch_radius_m, r, spec.patch_radius_m / 1000));
  constexpr double kRoughest = 2;
  if (spec.friction_coefficient > kRoughest)
    contact.warn("friction_coefficient",
                 fmt::format("{} is more than rubber on dry asphalt has; is it in percent (write {:.6g})?",
                             spec.friction_coefficient, spec.friction_coefficient / 100));
  if (spec.static_coefficient && *spec.static_coefficient > kRoughest)
    contact.warn("static_coefficient",
                 fmt::format("{} is more than rubber on dry asphalt has; is it in percent (write {:.6g})?",
                             *spec.static_coefficient, *spec.static_coefficient / 100));
  for (const auto& [key, length] : {std::pair("spinning_friction_m", spec.spinning_friction_m),
                                    std::pair("rolling_resistance_m", spec.rolling_resistance_m)})
    if (length > std::max(r, 1e-3))
      contact.warn(
          key,
          fmt::format("{} m is a lever arm longer than the tip's radius; is it a dimensionless coefficient, or in millimetres?",
                      length));
}

}  // namespace earthtop
