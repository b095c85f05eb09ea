// SPDX-License-Identifier: GPL-3.0-or-later
// Checks of a top on a table. Refused is a contact that has no motion, or none that can be followed: a body without extent about its
// centre of mass, a rim that touches at the release, a table that would have to pull, no unique force (Painleve's paradox), a slip that
// dies out too fast. Lengths and coefficients that look like a mistake of unit are warned of.
#include <fmt/core.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <utility>

#include "scene/support_laws.hpp"
#include "scene/touchdown.hpp"
#include "text/number_words.hpp"

namespace earthtop {
namespace {

using input::Section;

/// The fastest relaxation of a slip (1/s) that steps are allowed to follow. A minute of it is some 1e7 steps.
constexpr double kFastestRelaxation = 1e5;

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
  const double rate = touchdown.relaxation_rate_per_s();
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

void TableLaws::check(const Section& root, const Scene& scene) const {
  const Section contact = root.section("contact");
  const ContactSpec& spec = *scene.scenario().contact;
  if (!check_moments(root.section("body"), scene)) return;
  const Touchdown& touchdown = scene.touchdown();
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

void TableLaws::warn(const Section& root, const Scene& scene) const {
  const Section contact = root.section("contact");
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
