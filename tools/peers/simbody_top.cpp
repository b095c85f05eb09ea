// SPDX-License-Identifier: GPL-3.0-or-later
// Two of earthtop's scenarios computed by another multibody program, Simbody 3.7, as an example of another simulator's output.
// Ground does not rotate. A laboratory turns on it steadily about the Earth's axis through the pivot and carries the top on a
// ball joint. Simbody's own kinematics thus produce all effects of the Earth's rotation: no non-inertial torque is written
// here.
// Axes and units are what a user of Simbody would choose, not earthtop's: world x = East, y = Up, z = South; the quaternion
// rotates body to world, w first; the angular velocity is relative to the laboratory, in body axes, in degrees per second.
// This file is not part of the CMake build. Simbody's headers compile up to C++17, so -std has to follow pkg-config's flags:
//     g++ -O2 $(pkg-config --cflags simbody) -std=c++17 -o simbody_top tools/peers/simbody_top.cpp
//         -DSIMBODY="\"$(dpkg-query -Wf '${Version}' libsimbody-dev)\"" $(pkg-config --libs simbody)
//     ./simbody_top toy-top > tests/data/simbody/toy-top.csv # or heavy-top-benchmark; takes minutes
#include <Simbody.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

namespace {

using SimTK::Real, SimTK::Rotation, SimTK::Vec3;

constexpr Real deg = SimTK_DEGREE_TO_RADIAN;

struct Scenario {              // values from the scenario files; their keys:
  Real gravity;                // site/gravity_m_s2
  Real mass;                   // body/mass_kg
  Vec3 center;                 // body/center_of_mass_m
  SimTK::Inertia inertia;      // body/inertia, here about the pivot
  Vec3 rate;                   // release/spin_rad_s about z, or angular_velocity_body_rad_s; relative to the laboratory
  Real output_step;            // motion/output_step_s
  int stride;                  // every stride-th of earthtop's rows is written, 101 in all
  Real latitude = 0;           // site/latitude_deg
  Real earth_rate = 0;         // earth/rotation_rate_rad_s
  Rotation R_LB = Rotation();  // release/tilt_deg and azimuth_deg, or quaternion_LB; L: East, North, Up
};

Scenario heavy_top_benchmark() {
  const Vec3 center(0, 1, 0);
  const SimTK::Inertia about_center(0.234375, 0.46875, 0.234375);
  return {9.81, 15, center, about_center.shiftFromMassCenter(center, 15), Vec3(0, 150, -4.61538), 0.01, 10};
}

Scenario toy_top() {
  const SimTK::Inertia about_pivot(1.2e-4, 1.2e-4, 4e-5);
  const Real azimuth = 90 * deg, tilt = 20 * deg;  // the spin angle is 0 by default; the Earth's rate is that of WGS 84
  const Rotation R_LB = Rotation(90 * deg - azimuth, SimTK::ZAxis) * Rotation(tilt, SimTK::YAxis);
  return {9.80665, 0.1, Vec3(0, 0, 0.03), about_pivot, Vec3(0, 0, 200), 0.1, 6, 45 * deg, 7.292115e-5, R_LB};
}

// Simbody's own gravity is fixed in Ground; the gravity that a plumb line shows turns with the laboratory.
class ApparentGravity : public SimTK::Force::Custom::Implementation {
 public:
  ApparentGravity(const SimTK::MobilizedBody& lab, const SimTK::MobilizedBody& top, Real g) : lab_(lab), top_(top), g_(g) {}

  void calcForce(const SimTK::State& state, SimTK::Vector_<SimTK::SpatialVec>& body_forces, SimTK::Vector_<Vec3>&,
                 SimTK::Vector&) const override {
    const SimTK::MassProperties& body = top_.getBodyMassProperties(state);
    const Vec3 weight = lab_.expressVectorInGroundFrame(state, Vec3(0, -body.getMass() * g_, 0));
    top_.applyForceToBodyPoint(state, body.getMassCenter(), weight, body_forces);
  }

  Real calcPotentialEnergy(const SimTK::State&) const override { return 0; }  // never needed

 private:
  SimTK::MobilizedBody lab_, top_;
  Real g_;
};

struct Row {
  Real time;
  SimTK::Vec4 q;
  Vec3 w;  // deg/s
};

std::vector<Row> simulate(const Scenario& s, Real accuracy) {
  SimTK::MultibodySystem system;
  SimTK::SimbodyMatterSubsystem matter(system);
  SimTK::GeneralForceSubsystem forces(system);

  // A pin turns about the z of its two frames: here North cos(latitude) + Up sin(latitude). At t = 0 the laboratory's axes
  // are Ground's. Its motion is prescribed, so its mass does not matter.
  const SimTK::UnitVec3 celestial_pole(Vec3(0, std::sin(s.latitude), -std::cos(s.latitude)));
  const SimTK::Transform hinge(Rotation(celestial_pole, SimTK::ZAxis));
  const SimTK::Body::Rigid any(SimTK::MassProperties(1, Vec3(0), SimTK::Inertia(1)));
  SimTK::MobilizedBody::Pin lab(matter.Ground(), hinge, any, hinge);
  SimTK::Motion::Steady(lab, s.earth_rate);

  const SimTK::Body::Rigid body(SimTK::MassProperties(s.mass, s.center, s.inertia));
  SimTK::MobilizedBody::Ball top(lab, Vec3(0), body, Vec3(0));
  SimTK::Force::Custom(forces, new ApparentGravity(lab, top, s.gravity));  // Simbody deletes it

  SimTK::State state = system.realizeTopology();
  const Rotation attitude = Rotation(-90 * deg, SimTK::XAxis) * s.R_LB;  // East, North, Up to East, Up, South
  top.setQToFitRotation(state, attitude);
  top.setUToFitAngularVelocity(state, attitude * s.rate);  // relative to the laboratory, in its axes

  SimTK::RungeKuttaMersonIntegrator integrator(system);
  integrator.setAccuracy(accuracy);
  integrator.setAllowInterpolation(false);  // steps end at the rows: an interpolated row would be less exact
  integrator.initialize(state);
  std::vector<Row> rows;
  for (int k = 0; k <= 100; ++k) {
    const Real time = k * s.stride * s.output_step;
    while (integrator.getTime() < time) integrator.stepTo(time);
    const SimTK::State& now = integrator.getState();
    system.realize(now, SimTK::Stage::Velocity);
    const SimTK::Vector q = top.getQAsVector(now);
    const Vec3 w_lab = top.findBodyAngularVelocityInAnotherBody(now, lab);
    const Vec3 w_body = ~top.findBodyRotationInAnotherBody(now, lab) * w_lab;
    rows.push_back({now.getTime(), SimTK::Vec4(q[0], q[1], q[2], q[3]), w_body / deg});
  }
  return rows;
}

}  // namespace

int main(int argc, char** argv) {
  const std::string name = argc == 2 ? argv[1] : "";
  if (name != "heavy-top-benchmark" && name != "toy-top") {
    std::fprintf(stderr, "usage: simbody_top heavy-top-benchmark|toy-top\n");
    return 2;
  }
  const Scenario s = name == "toy-top" ? toy_top() : heavy_top_benchmark();
  const Real accuracy = 1e-14;  // the tightest power of ten: at 1e-15 the steps shrink to nothing
  const std::vector<Row> rows = simulate(s, accuracy), looser = simulate(s, 10 * accuracy);
  Real dq = 0, dw = 0;
  for (std::size_t k = 0; k < rows.size(); ++k) {
    dq = std::max(dq, (rows[k].q - looser[k].q).norm());
    dw = std::max(dw, (rows[k].w - looser[k].w).norm());
  }
  std::printf("# generator: tools/peers/simbody_top.cpp, scenario %s, Simbody %s\n", name.c_str(), SIMBODY);
  std::printf("# precision: double, RungeKuttaMerson, accuracy %g\n", accuracy);
  std::printf("# digits: q to %.1e, w to %.1e deg/s: their largest changes when the accuracy is %g\n", dq, dw, 10 * accuracy);
  std::printf("# axes: world x = East, y = Up, z = South; q body to world; w relative to the laboratory, in body axes\n");
  std::printf("time,q0,q1,q2,q3,wx_deg_s,wy_deg_s,wz_deg_s\n");
  for (const Row& r : rows) {
    std::printf("%.17g,%.17g,%.17g,%.17g,%.17g,%.17g,%.17g,%.17g\n", r.time, r.q[0], r.q[1], r.q[2], r.q[3], r.w[0], r.w[1],
                r.w[2]);
  }
}
