// SPDX-License-Identifier: GPL-3.0-or-later
/// The journey of a laboratory over the Earth: a layer of the frame stack between the Earth and the laboratory L, whose axes East,
/// North, Up are carried along.
///
/// Both motions are followed in axes A in which the reference's equations have no rate of rotation:
///
/// | reference | A                                                          | rate of A in the rotating motion |
/// | same_path | parallel to L at the release, and turning with the Earth   | the Earth's                      |
/// | at_rest   | parallel to L at the release, and at rest in inertial space| none                             |
///
/// so that all equations of a laboratory at rest hold with a pivot that moves in A, and with apparent gravity that turns in A. What is
/// said of L is found from L's motion in A, which this class gives as functions of time: polynomials, one after another.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <memory>
#include <span>
#include <stdexcept>
#include <vector>

#include "earthtop/frames/rotation.hpp"
#include "earthtop/frames/site.hpp"
#include "earthtop/frames/travel_spec.hpp"
#include "earthtop/vectors.hpp"

namespace earthtop {

/// The functions of time that a journey consists of. The changes are those from the reference to the rotating motion, over epsilon; with
/// `same_path` there are none, as all that changes follows from the rate of A.
enum class JourneyPart : std::uint8_t {
  east,        ///< L's axes in A, of the reference
  north,       //
  up,          //
  rate,        ///< w_IL of the reference, in L (rad/s)
  rate_slope,  ///< its derivative as L sees it, in L (rad/s^2)
  velocity,    ///< of the pivot in A, of the rotating motion (m/s); with `at_rest` 0
  field,  ///< of the reference in A, beside apparent gravity at the release along -Up: minus the pivot's acceleration (m/s^2)
  east_change,    //
  north_change,   //
  up_change,      //
  rate_change,    //
  slope_change,   //
  field_change,   //
  place,          ///< latitude, longitude (rad) and height (m), less those at the release
  course,         ///< course less that at the start (rad), speed (m/s), length of the way (m)
  velocity_in_L,  ///< East, North, Up (m/s)
};
inline constexpr std::size_t kJourneyParts = 16;

/// A journey that cannot be made; the message says why, and what to do.
class JourneyError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A place on a journey.
template <class T>
struct JourneyPlace {
  T latitude_deg, longitude_deg, height_m;
  T course_deg;  ///< compass course, 0 to 360
  T speed_m_s;   ///< horizontal
  T length_m;    ///< of the way since the release
};

/// A journey is made from this, beside its specification.
template <class T>
struct JourneySetting {
  Site site;
  T earth_rate = T(0);         ///< rad/s
  double gravity_anomaly = 0;  ///< added to normal gravity (m/s^2)
  double duration_s = 0;
};

/// A turn by the quaternion (w, epsilon v_scaled).
template <class T>
struct SmallTurn {
  T w;
  Vec3<T> v_scaled;
};

/// The functions of time. @tparam T  a number; a scalar that records operations has a class of its own
template <class T>
class Journey {
 public:
  using Polynomial = std::vector<Vec3<T>>;
  struct Piece {
    T start;
    std::array<Polynomial, kJourneyParts> parts;
  };

  Journey() = default;
  /// @throws JourneyError  where it comes too near to a pole
  Journey(const TravelSpec& spec, const JourneySetting<T>& setting);

  bool empty() const { return !data_; }
  /// Whether the reference stays at the place of the release.
  bool has_still_reference() const { return data_ && data_->still_reference; }
  /// Whether the reference, too, feels the Coriolis force on the laboratory; and whether any motion does.
  bool is_felt_by_both() const { return data_->eotvos == TravelEotvos::both; }
  bool is_felt() const { return data_->eotvos != TravelEotvos::off; }
  /// epsilon of a model whose reference stays at rest: the largest speed over the Earth's radius per second, at most 1; it is 1 without
  /// motion.
  T epsilon() const { return data_->epsilon; }

  Vec3<T> at(JourneyPart part, const T& t) const {
    const Piece& p = piece(t);
    const T u = t - p.start;
    Vec3<T> sum = Vec3<T>::Zero();
    const Polynomial& c = p.parts[static_cast<std::size_t>(part)];
    for (std::size_t k = c.size(); k-- > 0;) sum = u * sum + c[k];
    return sum;
  }
  /// The course less that at the start (rad), or its derivative of an order up to 2. A journey by a table has no such turn: a vehicle that
  /// stands has no course.
  T turned(const T& t, int order) const {
    const Piece& p = piece(t);
    const T u = t - p.start;
    T sum = T(0);
    const Polynomial& c = p.parts[static_cast<std::size_t>(JourneyPart::course)];
    for (int k = static_cast<int>(c.size()) - 1; k >= order; --k)
      sum = u * sum + T(order == 0 ? 1 : order == 1 ? k : k * (k - 1)) * c[static_cast<std::size_t>(k)][0];
    return sum;
  }
  /// An upper bound of the size of the first derivative from 0 to `end`.
  T largest_turning(const T& end) const;
  /// Puts the coefficients of the powers of (t' - t) into rows, one for each order starting at 0, just after t. A t that is earlier than a
  /// joint only by rounding counts as the joint.
  void expand(JourneyPart part, const T& t, std::span<std::array<T, 3>> rows) const;
  /// The times at which one polynomial follows another; steps end there.
  std::vector<T> joints() const;
  /// The same journey with one part alone; the others are zero.
  Journey only(JourneyPart part) const;
  /// The same with times in units of 2^time_exponent s: t, rates and accelerations are in the new unit. Exact, no digit changes.
  Journey in_time_units(int time_exponent) const;
  /// Where the laboratory is. Only where the unit of time is the second.
  JourneyPlace<T> place(const T& t) const;
  /// The attitude q_AL of the laboratory in A.
  /// @param rotating  of the rotating motion, else of the reference
  Quaternion<T> attitude(const T& t, bool rotating) const {
    if (data_->still_reference && !rotating) return turn_of_earth(t);
    const SmallTurn<T> over_earth = turn_over_earth(t);
    const Quaternion<T> q{over_earth.w, Vec3<T>(data_->epsilon * over_earth.v_scaled)};
    return data_->still_reference ? turn_of_earth(t) * q : q;
  }
  /// The turn R_AL(rotating) R_AL(reference)^T, in A.
  SmallTurn<T> attitude_change(const T& t) const {
    if (!data_->still_reference) return {T(1), Vec3<T>::Zero()};
    const SmallTurn<T> over_earth = turn_over_earth(t);
    return {over_earth.w, times(rotation_matrix(turn_of_earth(t)), over_earth.v_scaled)};
  }

 private:
  struct Data {
    std::vector<Piece> pieces;
    bool still_reference = false;
    TravelEotvos eotvos = TravelEotvos::rotating;
    T epsilon = T(1), earth_rate = T(0);
    Site site;
    Vec3<T> pole;  ///< the celestial axis in L at the release
    double course_deg = 0;
    bool from_table = false;
  };
  const Piece& piece(const T& t) const {
    const std::vector<Piece>& pieces = data_->pieces;
    const auto later = [](const T& at, const Piece& p) { return at < p.start; };
    return *(std::upper_bound(pieces.begin() + 1, pieces.end(), t, later) - 1);
  }
  Quaternion<T> turn_of_earth(const T& t) const {
    const SinCos<T> half = real::sin_cos(T(data_->earth_rate * t / T(2)));
    return {half.cos, Vec3<T>(half.sin * data_->pole)};
  }
  /// The turn from L at the release to L, in the former's axes, which turn with the Earth.
  SmallTurn<T> turn_over_earth(const T& t) const {
    const Vec3<T> moved = at(JourneyPart::place, t);
    const T& epsilon = data_->epsilon;
    const SinCos<T> l = real::sin_cos(T(moved[1] / T(2))), d = real::sin_cos(T(moved[0] / T(2)));
    // About the pole by the change of longitude, then about East by minus the change of latitude.
    const Vec3<T> about_pole = T(l.sin / epsilon) * data_->pole, about_east(T(-d.sin / epsilon), T(0), T(0));
    return {T(l.cos * d.cos - epsilon * epsilon * about_pole.dot(about_east)),
            Vec3<T>(l.cos * about_east + d.cos * about_pole + epsilon * about_pole.cross(about_east))};
  }
  std::shared_ptr<const Data> data_;
};
extern template class Journey<double>;
extern template class Journey<float80>;
extern template class Journey<float128>;

}  // namespace earthtop
