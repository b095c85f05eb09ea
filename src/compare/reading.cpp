// SPDX-License-Identifier: GPL-3.0-or-later
#include "compare/reading.hpp"

#include <fmt/core.h>

#include <cmath>

#include "earthtop/elementary.hpp"

namespace earthtop::compare {

Reader::Reader(const Evidence& evidence, const Mapping& mapping, const Eigen::Vector3d& rate_IL_L)
    : evidence_(evidence),
      mapping_(mapping),
      R_LF_(matrix_of(mapping.world)),
      R_BF_(matrix_of(mapping.body)),
      rate_IL_L_(rate_IL_L) {
  mapped_.world_to_body = !mapping.body_to_world;
  mapped_.world = mapping.world, mapped_.body = mapping.body;
  mapped_.world_rates = mapping.rates_in_world_axes;
}

/// The attitude in our axes. What the mapping made of the file's quaternion is undone, and made anew.
Eigen::Quaterniond Reader::attitude(const SeenTop& file, const Reading& reading) const {
  Eigen::Quaterniond q = Eigen::Quaterniond(R_LF_).conjugate() * file.q * Eigen::Quaterniond(R_BF_);
  if (mapped_.world_to_body) q = q.conjugate();
  if (reading.scalar == ScalarPart::last) q = Eigen::Quaterniond(q.z(), q.w(), q.x(), q.y());
  if (reading.scalar == ScalarPart::first) q = Eigen::Quaterniond(q.x(), q.y(), q.z(), q.w());
  if (reading.world_to_body) q = q.conjugate();
  return Eigen::Quaterniond(matrix_of(reading.world)) * q.normalized() *
         Eigen::Quaterniond(matrix_of(reading.body)).conjugate();
}

SeenTop Reader::read(std::size_t sample, const Reading& reading) const {
  const SeenTop& file = evidence_.file[sample];
  SeenTop top;
  Eigen::Quaterniond R_LI = Eigen::Quaterniond::Identity();
  if (reading.inertial_attitude && rate_IL_L_.norm() > 0) {
    const double half = 0.5 * evidence_.t_s[sample] * rate_IL_L_.norm();
    const Eigen::Vector3d along = -real::sin(half) * rate_IL_L_.normalized();
    R_LI = Eigen::Quaterniond(real::cos(half), along.x(), along.y(), along.z());
  }
  if (evidence_.attitude) top.q = R_LI * attitude(file, reading);
  if (evidence_.axis) {
    const Eigen::Vector3d axis = R_LI * (matrix_of(reading.world) * (R_LF_.transpose() * file.axis));
    top.axis = reading.axis_reversed ? Eigen::Vector3d(-axis) : axis;
  }
  if (!evidence_.rates) return top;
  Eigen::Vector3d rates = R_BF_.transpose() * file.rates;
  if (mapped_.world_rates) rates = R_LF_.transpose() * (file.q.normalized() * file.rates);
  rates /= reading.rate_factor;
  rates = reading.world_rates ? Eigen::Vector3d(top.q.conjugate() * (matrix_of(reading.world) * rates))
                              : Eigen::Vector3d(matrix_of(reading.body) * rates);
  top.rates = reading.inertial_rates ? Eigen::Vector3d(rates - top.q.conjugate() * rate_IL_L_) : rates;
  return top;
}

std::vector<std::string> Reader::words(const Reading& reading) const {
  std::vector<std::string> words;
  const Reading& mapped = mapped_;
  if (reading.scalar != mapped.scalar)
    words.push_back(
        fmt::format("its quaternions are read with the scalar part {}", reading.scalar == ScalarPart::last ? "last" : "first"));
  if (reading.world_to_body != mapped.world_to_body)
    words.push_back(fmt::format("its quaternions are taken as {}", reading.world_to_body ? "world-to-body" : "body-to-world"));
  if (reading.world != mapped.world) words.push_back(fmt::format("its world axes are taken as {}", world_words(reading.world)));
  if (reading.body != mapped.body) words.push_back(fmt::format("its body axes are taken as our {}", body_words(reading.body)));
  if (reading.axis_reversed) words.emplace_back("its axis is reversed");
  if (reading.inertial_attitude) words.emplace_back("its attitudes are taken as relative to space, and not to the laboratory");
  if (reading.world_rates != mapped.world_rates)
    words.push_back(fmt::format("its rates are taken along {} axes", reading.world_rates ? "world" : "body"));
  if (reading.inertial_rates) words.emplace_back("its rates are taken as relative to space, with the Earth's rate in them");
  if (reading.rate_factor != 1) {
    const auto unit = rate_unit_for(mapping_.rate_unit_rad_s, reading.rate_factor);
    words.push_back(
        unit ? fmt::format("its rates, {:.6g} times the reference's, are taken as in {}", reading.rate_factor, unit->word)
             : std::string("its rates have the opposite sign"));
  }
  if (reading.later != 0)
    words.push_back(fmt::format("each row is taken as that of the reference one row {}: are the times shifted by a sample?",
                                reading.later > 0 ? "later" : "before"));
  return words;
}

}  // namespace earthtop::compare
