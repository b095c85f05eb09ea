// SPDX-License-Identifier: GPL-3.0-or-later
/// Reference values of symmetric tops on a table: computed in 113 bits by extrapolation of order 24 at a tolerance of 1e-30 and of
/// order 18 at 1e-27 in the same printed digits, most of them confirmed to 20 digits by a formulation in inertial axes in 150
/// bits. Latitude 45 degrees, the axis leans toward the East, matched in the laboratory.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "support/contact_runs.hpp"

namespace earthtop::testing {

/// A decimal number in any precision.
template <class T>
T parsed(const std::string& text) {
  T digits = T(0);
  int scale = 0;
  bool negative = false, after_point = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (c == '-') {
      negative = true;
    } else if (c == '.') {
      after_point = true;
    } else if (c == 'e') {
      scale += std::stoi(text.substr(i + 1));
      break;
    } else {
      digits = T(10) * digits + T(c - '0');
      scale -= after_point ? 1 : 0;
    }
  }
  T power = T(1);
  for (int i = 0; i < std::abs(scale); ++i) power *= T(10);
  const T size = scale < 0 ? T(digits / power) : T(digits * power);
  return negative ? T(-size) : size;
}

/// A motion: axis, tip and inertial spin; empty for a row of another kind.
struct MotionReference {
  double t_s;
  bool on_earth;
  const char* n[3];
  const char* p[2];
  const char* w3;
  bool in_inversion = false;  ///< where a change of the start has grown by a large factor
};
/// The drift: angle between the axes, tip, spin.
struct DriftReference {
  double t_s;
  const char* angle;
  const char* p[2];
  const char* w3;
  bool in_inversion = false;
};
struct ContactReference {
  const char* name;
  ContactScene scene;
  std::vector<MotionReference> motions;
  std::vector<DriftReference> drifts;
};

inline ContactScene toy_on_table(const ContactSpec& contact) { return {0.1, 0.03, 3e-5, 4e-5, 9.80665, 200, 20, contact}; }
/// Rutstam's tippe top.
inline ContactScene tippe_top(const ContactSpec& contact) {
  return {0.02, -0.006, 2.994285714285714e-6, 3.2e-6, 9.82, 155, 5.729577951308232, contact};
}
/// Leine and Glocker's tippe top without its stem.
inline ContactScene leine_glocker_top(const ContactSpec& contact) {
  return {0.006, -0.003, 8e-7, 7e-7, 9.81, 180, 5.729577951308232, contact};
}

inline std::vector<ContactReference> contact_references() {
  using Law = ContactLaw;
  ContactSpec k1{.tip_radius_m = 0.002, .law = Law::frictionless};
  ContactSpec k2{.tip_radius_m = 0, .law = Law::viscous, .sliding_viscosity_N_s_m = 0.05};
  ContactSpec k3{.tip_radius_m = 0.002, .law = Law::viscous, .sliding_viscosity_N_s_m = 0.05};
  ContactSpec k4{.tip_radius_m = 0.002, .law = Law::contensou, .friction_coefficient = 0.2, .patch_radius_m = 1e-4};
  ContactSpec k5{.tip_radius_m = 0.02, .law = Law::viscous_load, .sliding_viscosity_s_m = 0.3, .start = ContactStart::rolling};
  ContactSpec k6{.tip_radius_m = 0.015, .law = Law::contensou, .friction_coefficient = 0.3, .patch_radius_m = 5e-4};
  ContactSpec k7{.tip_radius_m = 0.015, .law = Law::coulomb, .friction_coefficient = 0.3, .regularisation_m_s = 0.02};
  ContactSpec k8{.tip_radius_m = 0.02, .law = Law::rolling, .start = ContactStart::rolling};
  ContactScene k8_scene = tippe_top(k8);
  k8_scene.tilt_deg = 60, k8_scene.spin_rad_s = 50;
  return {
      {"K1 frictionless",
       toy_on_table(k1),
       {{1,
         false,
         {"-0.29259454102938662530", "-0.19358774417365630573", "0.93643591337878407202"},
         {"0.019038440530651660046", "0.0058076323252096889571"},
         "200"},
        {1,
         true,
         {"-0.29259554479793472268", "-0.19360300920708698141", "0.93643244390097909953"},
         {"0.019038475926381143406", "0.0058080902358733301322"},
         "200.00004845340787090"}},
       {{1, "1.5686493336053086e-5", {"3.5395729483360753e-8", "4.5791066364117511e-7"}, "4.8453407870900205e-5"},
        {5, "9.1293937845106291e-5", {"4.5439820722225059e-7", "2.7039011694304016e-6"}, "4.8453407870900205e-5"}}},
      {"K2 point tip, viscous",
       toy_on_table(k2),
       {{1,
         true,
         {"-0.29499335656410811921", "-0.19558900809048239533", "0.93526673173871750912"},
         {"0.014023282985527489440", "0.0077471056911805665577"},
         "200.00004845340787090"}},
       {{1, "1.1474225647340635e-5", {"1.8416063806164267e-7", "3.5081008864852612e-7"}, "4.8453407870900205e-5"},
        {5, "9.8245545916214922e-5", {"3.1489754468638058e-7", "4.0977759634048911e-6"}, "4.8453407870900205e-5"}}},
      {"K3 viscous",
       toy_on_table(k3),
       {{1,
         false,
         {"-0.27540858030218869438", "-0.18234159642476731841", "0.94387586901520062315"},
         {"0.031190088192687690577", "6.2891173278656051861e-4"},
         "199.92556342690963216"},
        {1,
         true,
         {"-0.27540995875739182409", "-0.18235103385922410651", "0.94387364359204555446"},
         {"0.031189047413036477007", "6.2903870306206277713e-4"},
         "199.92561419937820553"}},
       {{5, "7.2695868869458749e-5", {"-1.5556488184937511e-5", "-6.9465619823794395e-7"}, "4.6960039309369933e-5"}}},
      {"K4 contensou",
       toy_on_table(k4),
       {{0.1,
         true,
         {"0.28981129762726313843", "0.10312418876075808854", "0.95151185671017123607"},
         {"0.0020065313485299748729", "-0.0098709044007271567052"},
         "199.82734871617236139"},
        {5,
         false,
         {"-0.13647749454629110773", "-0.26400538220409656203", "0.95481676338951861495"},
         {"0.053086648976650737004", "0.031862306330006978156"},
         "198.51864589438077970"}},
       {{1, "8.1669447104137145e-6", {"-3.8123594788840117e-6", "1.1063595821019370e-6"}, "4.6864500708268518e-5"},
        {5, "7.1011318385252389e-5", {"-1.7436182050211749e-5", "-2.2020004246140575e-6"}, "4.4053083562634257e-5"}}},
      {"K5 tippe top, viscous_load",
       tippe_top(k5),
       {{2,
         true,
         {"-0.034229346677330344494", "-0.060607317699985757752", "0.99757461117815950919"},
         {"-0.31512422432234318747", "-0.37061209977245185774"},
         "154.48176114375684813"},
        {5,
         false,
         {"-0.52299700936486917059", "-0.21915931225379348730", "0.82367671088106357414"},
         {"-0.51140790573985182500", "0.029525194613602570194"},
         "123.84910215801937198",
         true},
        {8,
         false,
         {"0.0035725375287671591017", "-0.0066758248968541339515", "-0.99997133475792799484"},
         {"-0.49437670070649513019", "0.087968574270732727742"},
         "-82.866408564255894528",
         true}},
       {{2, "4.0981250027352685e-5", {"2.8442680952682685e-5", "1.0128951142172542e-4"}, "6.9154269348309394e-4"},
        {5, "5.5776162319439052e-4", {"4.3532806816421122e-4", "1.9940053857293289e-4"}, "4.6260723679254525e-4", true},
        {8, "3.0594030827418837e-5", {"4.7974638798876449e-4", "2.3917114388376535e-4"}, "4.7637633380228429e-4", true}}},
      {"K6 tippe top, contensou",
       leine_glocker_top(k6),
       {{0.5,
         true,
         {"-0.42576339716463446437", "0.14816245808586654317", "0.89262165313686154896"},
         {"-0.0086963353203045678708", "-0.048300951228134909658"},
         "148.99133165072155551"},
        {2,
         false,
         {"-0.027330151542204875130", "0.29979827072571012082", "-0.95361106311040348504"},
         {"0.028916464384472790535", "-0.094337313657157500128"},
         "-109.14899189996685422",
         true}},
       {{0.5, "2.1364711805050360e-5", {"-4.3125271603978846e-7", "5.8341579549233909e-6"}, "-5.5822204390962365e-4"},
        {1, "2.4630755888710889e-4", {"-2.1154128999311351e-7", "1.5338474300789954e-5"}, "-5.3467965854746451e-3", true},
        {2, "2.1783409052346443e-4", {"-3.1180136485347134e-5", "2.7939213914363324e-5"}, "-6.3268275866219226e-4", true}}},
      {"K7 tippe top, coulomb",
       leine_glocker_top(k7),
       {{0.5,
         true,
         {"0.49591399195056353585", "-0.26270963072507239161", "0.82767926306749555086"},
         {"-0.0058418207863036633363", "-0.049356438770186732811"},
         "146.87342772532554491"},
        {4,
         false,
         {"0.16388637538568276611", "0.11962464027601334469", "-0.97919926542138371843"},
         {"0.096467136556575657485", "-0.0022337848726826698354"},
         "-117.87639404615559219",
         true}},
       {{1, "6.4804200073048305e-4", {"1.5167445216429674e-6", "1.2907207046485904e-5"}, "-8.0835221020393831e-3", true},
        {4, "1.0362029982846489e-4", {"-1.0890636316149813e-4", "3.1485505289448492e-5"}, "-3.0335340352238850e-4", true}}},
      {"K8 rolling Routh sphere",
       k8_scene,
       {{1,
         true,
         {"-0.55848210257339073881", "-0.64839014927084587663", "0.51738569310885942571"},
         {"-0.63458634252065034981", "-0.27677505171630035119"},
         "50.209652643652015685"},
        {5,
         false,
         {"0.50129925889808133629", "0.70413832702994786344", "0.50287997517867085404"},
         {"-0.16404727711151481679", "0.31145110245760271441"},
         "50.034583606126586287"}},
       {{1, "8.2110663500824735e-5", {"1.7574045446698763e-6", "3.6509353792169208e-5"}, "5.0865735063478340e-4"},
        {5, "3.5442911796503860e-4", {"1.6491500013160132e-4", "-1.0119089712396048e-4"}, "-3.6028802572156237e-4"}}},
  };
}

/// Error of a vector relative to its size.
template <class T, std::size_t N>
double relative_error(const std::array<T, N>& found, const std::array<T, N>& known) {
  T error = T(0), size = T(0);
  for (std::size_t i = 0; i < N; ++i) {
    error += (found[i] - known[i]) * (found[i] - known[i]);
    size += known[i] * known[i];
  }
  return static_cast<double>(real::sqrt(T(error / size)));
}

/// The largest errors of a reference's rows, each relative to the size of its column.
struct Errors {
  double motion = 0, motion_in_inversion = 0, drift = 0, drift_in_inversion = 0;
};

template <class T, Observer O>
Errors errors_of(const ContactReference& reference, double tolerance) {
  std::vector<double> times;
  for (const MotionReference& row : reference.motions) times.push_back(row.t_s);
  for (const DriftReference& row : reference.drifts) times.push_back(row.t_s);
  std::sort(times.begin(), times.end());
  times.erase(std::unique(times.begin(), times.end()), times.end());
  const auto rows = testing::contact_rows<T, O>(reference.scene, times, tolerance);
  const auto row_at = [&](double t_s) -> const ContactRow<T>& {
    return rows[static_cast<std::size_t>(std::lower_bound(times.begin(), times.end(), t_s) - times.begin())];
  };
  Errors errors;
  for (const MotionReference& known : reference.motions) {
    const ContactRow<T>& row = row_at(known.t_s);
    const auto member = known.on_earth ? &Paired<T>::rot : &Paired<T>::ref;
    const Vec3<Paired<T>>&n = row.contact.axis_L, &p = row.contact.tip_L;
    double& worst = known.in_inversion ? errors.motion_in_inversion : errors.motion;
    worst = std::max({worst,
                      relative_error<T, 3>({n[0].*member, n[1].*member, n[2].*member},
                                           {parsed<T>(known.n[0]), parsed<T>(known.n[1]), parsed<T>(known.n[2])}),
                      relative_error<T, 2>({p[0].*member, p[1].*member}, {parsed<T>(known.p[0]), parsed<T>(known.p[1])}),
                      relative_error<T, 1>({row.spin_rad_s.*member}, {parsed<T>(known.w3)})});
  }
  for (const DriftReference& known : reference.drifts) {
    const ContactRow<T>& row = row_at(known.t_s);
    const T epsilon = row.epsilon;
    const Vec3<Paired<T>>& p = row.contact.tip_L;
    double& worst = known.in_inversion ? errors.drift_in_inversion : errors.drift;
    worst = std::max(
        {worst, relative_error<T, 1>({row.measures.axis}, {parsed<T>(known.angle)}),
         relative_error<T, 2>({epsilon * p[0].diff, epsilon * p[1].diff}, {parsed<T>(known.p[0]), parsed<T>(known.p[1])}),
         relative_error<T, 1>({epsilon * row.spin_rad_s.diff}, {parsed<T>(known.w3)})});
  }
  return errors;
}

}  // namespace earthtop::testing
