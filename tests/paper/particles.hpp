// SPDX-License-Identifier: GPL-3.0-or-later
/// Random sets of point masses, with the sums from which [F] (Fariborz, "Non-inertial torques and the Euler equation") starts.
/// Nothing here uses the tensor forms under test.
#pragma once

#include <vector>

#include "earthtop/model/body.hpp"
#include "frames/random_cases.hpp"

namespace earthtop::test {

template <class T>
struct Particle {
  T m;
  Vec3<T> r;     ///< position in the observing frame, origin at the pivot
  Vec3<T> rdot;  ///< velocity in the observing frame
};

template <class T>
using Particles = std::vector<Particle<T>>;

/// 20 to 50 particles with arbitrary velocities.
template <class T>
Particles<T> random_particles(Random& random) {
  Particles<T> particles(static_cast<std::size_t>(random.integer(20, 50)));
  for (Particle<T>& p : particles) {
    p.m = T(random.uniform(0.1, 2));
    p.r = random.vector<T>();
    p.rdot = random.vector<T>(3);
  }
  return particles;
}

/// Gives the particles the velocities of a rigid body that turns at w in the observing frame.
template <class T>
void turn_rigidly(Particles<T>& particles, const Vec3<T>& w) {
  for (Particle<T>& p : particles) p.rdot = w.cross(p.r);
}

/// A sum over particles, and the sum of the sizes of its terms, which measures its round-off.
template <class T>
struct Sum {
  Vec3<T> value = Vec3<T>::Zero();
  T size = T(0);
  Sum& add(const Vec3<T>& term, T term_size) {
    value += term;
    size += term_size;
    return *this;
  }
};

template <class T>
Sum<T> coriolis_sum(const Particles<T>& particles, const Vec3<T>& w) {
  Sum<T> sum;
  for (const Particle<T>& p : particles)
    sum.add(T(-2) * p.m * p.r.cross(w.cross(p.rdot)), T(2) * p.m * norm(p.r) * norm(w) * norm(p.rdot));
  return sum;
}
template <class T>
Sum<T> transverse_sum(const Particles<T>& particles, const Vec3<T>& wdot) {
  Sum<T> sum;
  for (const Particle<T>& p : particles) sum.add(-p.m * p.r.cross(wdot.cross(p.r)), p.m * p.r.squaredNorm() * norm(wdot));
  return sum;
}
template <class T>
Sum<T> centrifugal_sum(const Particles<T>& particles, const Vec3<T>& w) {
  Sum<T> sum;
  for (const Particle<T>& p : particles)
    sum.add(-p.m * p.r.cross(w.cross(w.cross(p.r))), p.m * p.r.squaredNorm() * w.squaredNorm());
  return sum;
}

/// Integral x_m x_n dm.
template <class T>
Mat3<T> second_moment(const Particles<T>& particles) {
  Mat3<T> S = Mat3<T>::Zero();
  for (const Particle<T>& p : particles)
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) S(i, j) += p.m * p.r[i] * p.r[j];
  return S;
}
/// J_mn = integral x_m xdot_n dm.
template <class T>
Mat3<T> general_velocity_moment(const Particles<T>& particles) {
  Mat3<T> J = Mat3<T>::Zero();
  for (const Particle<T>& p : particles)
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) J(i, j) += p.m * p.r[i] * p.rdot[j];
  return J;
}
/// The textbook inertia tensor, integral (r^2 1 - r r^T) dm.
template <class T>
Mat3<T> inertia(const Particles<T>& particles) {
  Mat3<T> I = Mat3<T>::Zero();
  for (const Particle<T>& p : particles) {
    const T x = p.r[0], y = p.r[1], z = p.r[2];
    I(0, 0) += p.m * (y * y + z * z), I(1, 1) += p.m * (z * z + x * x), I(2, 2) += p.m * (x * x + y * y);
    I(0, 1) -= p.m * x * y, I(1, 0) -= p.m * x * y;
    I(1, 2) -= p.m * y * z, I(2, 1) -= p.m * y * z;
    I(2, 0) -= p.m * z * x, I(0, 2) -= p.m * z * x;
  }
  return I;
}
template <class T>
Vec3<T> mass_moment(const Particles<T>& particles) {
  Vec3<T> sum = Vec3<T>::Zero();
  for (const Particle<T>& p : particles) sum += p.m * p.r;
  return sum;
}

/// Round-off of a sum over n particles' terms of total size `size`, in two orders of summation: eps/2 for each of the n
/// additions and for at most 16 operations in a term or in the tensor form, with three components' terms side by side.
template <class T>
T round_off(const Particles<T>& particles, T size) {
  return (T(particles.size()) + T(16)) * T(3) * real::epsilon<T>() * size;
}

/// Particles at rest with a total mass of 128 kg, whose coordinates and masses are multiples of 1/64 and 1/16. All moments up
/// to the second are exact in double, so that a body made from them is the same in every precision.
template <class T>
Particles<T> exact_particles(Random& random) {
  Particles<T> particles;
  int sixteenths = 128 * 16;
  const auto dyadic_point = [&random] {
    Vec3<T> r;
    for (int i = 0; i < 3; ++i) r[i] = T(random.integer(-96, 96)) / T(64);
    return r;
  };
  for (int n = random.integer(20, 50); n > 1; --n) {
    const int mass = random.integer(1, 40);
    sixteenths -= mass;
    const Vec3<T> r = dyadic_point();
    particles.push_back({T(mass) / T(16), r, Vec3<T>::Zero()});
  }
  particles.push_back({T(sixteenths) / T(16), dyadic_point(), Vec3<T>::Zero()});
  return particles;
}

/// The body of `exact_particles`, as a scenario specifies it.
template <class T>
BodySpec body_spec(const Particles<T>& particles) {
  BodySpec spec;
  spec.mass_kg = 128;
  const Vec3<T> moment = mass_moment(particles);
  const Mat3<T> I = inertia(particles);
  for (std::size_t i = 0; i < 3; ++i) {
    spec.center_of_mass_m[i] = static_cast<double>(moment[static_cast<int>(i)] / T(128));
    for (std::size_t j = 0; j < 3; ++j)
      spec.inertia_kg_m2[i][j] = static_cast<double>(I(static_cast<int>(i), static_cast<int>(j)));
  }
  return spec;
}

}  // namespace earthtop::test
