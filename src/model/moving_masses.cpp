// SPDX-License-Identifier: GPL-3.0-or-later
#include "earthtop/model/moving_masses.hpp"

#include <stdexcept>
#include <utility>

#include "earthtop/frames/angle_spline.hpp"
#include "earthtop/model/moving_masses_spec.hpp"

namespace earthtop {
namespace {

template <class T>
using Piece = typename PiecewisePath<T>::Piece;

template <class T>
Vec3<T> from_numbers(const std::array<double, 3>& v) {
  return {T(v[0]), T(v[1]), T(v[2])};
}

template <class T>
Piece<T> resting_piece(T start, const Vec3<T>& place) {
  Piece<T> piece;
  piece.start = start;
  piece.coefficients.fill(Vec3<T>::Zero());
  piece.coefficients[0] = place;
  return piece;
}

/// Straight lines, at rest at every point: the share of the way is x^3 (10 - 15 x + 6 x^2) after the share x of the time.
template <class T>
std::vector<Piece<T>> waypoint_pieces(const MovingMassSpec& spec) {
  const std::size_t size = spec.times_s.size();
  if (size < 2 || spec.points_m.size() != size)
    throw std::invalid_argument("waypoints: at least two times, and a point for each");
  std::vector<Piece<T>> pieces{resting_piece<T>(T(0), from_numbers<T>(spec.points_m[0]))};
  for (std::size_t i = 0; i + 1 < size; ++i) {
    const Vec3<T> from = from_numbers<T>(spec.points_m[i]), way = from_numbers<T>(spec.points_m[i + 1]) - from;
    const T start = T(spec.times_s[i]), length = T(spec.times_s[i + 1]) - start, cube = length * length * length;
    Piece<T> piece = resting_piece<T>(start, from);
    piece.coefficients[3] = (T(10) / cube) * way;
    piece.coefficients[4] = (T(-15) / (cube * length)) * way;
    piece.coefficients[5] = (T(6) / (cube * length * length)) * way;
    pieces.push_back(piece);
  }
  pieces.push_back(resting_piece<T>(T(spec.times_s.back()), from_numbers<T>(spec.points_m.back())));
  if (pieces[1].start <= T(0)) pieces.erase(pieces.begin());
  return pieces;
}

template <class T>
MassOnPath<T> on_path(const MovingMassSpec& spec) {
  MassOnPath<T> one;
  one.mass = T(spec.mass_kg);
  one.center = from_numbers<T>(spec.center_m);
  one.frequency = T(spec.frequency_hz);
  one.phase = T(spec.phase_deg) * real::pi<T>() / T(180);
  switch (spec.motion) {
    case MassMotion::fixed: break;
    case MassMotion::harmonic: one.sine = from_numbers<T>(spec.amplitude_m); break;
    case MassMotion::circle: {
      const Vec3<T> axis = from_numbers<T>(spec.axis), unit = axis / norm(axis);
      one.cosine = from_numbers<T>(spec.start_m);
      one.sine = unit.cross(one.cosine);
      break;
    }
    case MassMotion::waypoints: one.pieces = std::make_shared<const PiecewisePath<T>>(waypoint_pieces<T>(spec)); break;
    case MassMotion::table: {
      std::array<std::shared_ptr<const AngleTable>, 3> rows;
      for (std::size_t i = 0; i < 3; ++i) rows[i] = spec.coordinates[i].rows;
      one.pieces = std::make_shared<const PiecewisePath<T>>(path_of_tables<T>(rows));
      break;
    }
  }
  return one;
}

}  // namespace

template <class T>
PiecewisePath<T> path_of_tables(const std::array<std::shared_ptr<const AngleTable>, 3>& tables) {
  for (const auto& table : tables)
    if (!table) throw std::invalid_argument("\"table\": there is no table");
  const std::vector<double>& times = tables[0]->t_s;
  std::vector<Piece<T>> pieces(times.size() - 1);
  for (std::size_t i = 0; i + 1 < times.size(); ++i) pieces[i] = resting_piece<T>(T(times[i]), Vec3<T>::Zero());
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const AngleSpline<T> spline(*tables[axis]);
    for (Piece<T>& piece : pieces) {
      const std::array<T, 4> cubic = spline.cubic_from(piece.start);
      for (std::size_t k = 0; k < cubic.size(); ++k) piece.coefficients[k][static_cast<int>(axis)] = cubic[k];
    }
  }
  return PiecewisePath<T>(std::move(pieces));
}

template <class T>
MovingMasses<T> make_masses(const std::vector<MovingMassSpec>& specs, MassCarrier carrier, bool only_moving) {
  MovingMasses<T> made;
  for (const MovingMassSpec& spec : specs)
    if (spec.carrier == carrier && (spec.moves() || !only_moving)) made.masses.push_back(on_path<T>(spec));
  made.at_release = made.sums(T(0));
  return made;
}

template <class T>
MovingMasses<T> in_units(MovingMasses<T> masses, int mass_exponent, int time_exponent) {
  for (MassOnPath<T>& one : masses.masses) {
    one.mass = real::scale(one.mass, -mass_exponent);
    one.frequency = real::scale(one.frequency, time_exponent);
    if (one.pieces) one.pieces = std::make_shared<const PiecewisePath<T>>(one.pieces->in_time_units(time_exponent));
  }
  masses.at_release = masses.sums(T(0));
  return masses;
}

#define EARTHTOP_MASSES(T)                                                                                  \
  template PiecewisePath<T> path_of_tables(const std::array<std::shared_ptr<const AngleTable>, 3>& tables); \
  template MovingMasses<T> make_masses(const std::vector<MovingMassSpec>& specs, MassCarrier, bool);        \
  template MovingMasses<T> in_units(MovingMasses<T>, int, int);
EARTHTOP_MASSES(double)
EARTHTOP_MASSES(float80)
EARTHTOP_MASSES(float128)
#undef EARTHTOP_MASSES

}  // namespace earthtop
