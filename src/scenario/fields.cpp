// SPDX-License-Identifier: GPL-3.0-or-later
#include "scenario/fields.hpp"

#include <array>
#include <iterator>
#include <limits>

#include "earthtop/integrate/method.hpp"
#include "earthtop/scenario/inputs.hpp"
#include "scenario/rules.hpp"
#include "scenario/wishes.hpp"

namespace earthtop::scenario {
namespace {

using input::Field, input::Range;
using enum input::FieldKind;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kPi = 3.141592653589793;

constexpr Range any() { return {}; }
constexpr Range from(double least, double most) { return {least, most, false}; }
constexpr Range above(double least, double most) { return {least, most, true}; }

// Ranges without a physical reason keep squares and products within a double's range, and exclude mistakes of unit.
constexpr Range kLengths = from(-1e6, 1e6), kRates = from(-1e9, 1e9), kAngles = from(-360, 360);

constexpr bool kRequired = true;

/// Marks a field as one that only describes the scenario, so that no result depends on it.
constexpr Field describing(Field field) {
  field.describes_only = true;
  return field;
}

constexpr Field kOwnFields[] = {
    // pointer, kind, unit, range, words, default, doc
    {"/$schema", word, "", any(), "earthtop-scenario-1.json", "\"earthtop-scenario-1.json\"", "version of this format"},
    {"/name", name, "", any(), "", "", "names the results; default: the file's stem, \"unnamed\" from standard input"},
    describing({"/title", text, "", any(), "", "\"\"", "any text"}),
    describing({"/purpose", text, "", any(), "", "\"\"", "what the scenario is for, and what it shows"}),
    describing({"/headline", object, "", any(), "", "",
                "one figure known from another source, against which the computed one is checked"}),
    {"/headline/quantity", word, "", any(), kFigures, "", "a column of trajectory.csv, or a figure of summary.json", kRequired},
    {"/headline/at_s", number, "s", from(0, 1e9), "", "", "for a column: the time of its row; default: the duration"},
    {"/headline/value", number, "", any(), "", "", "the figure, in the unit that the quantity's name states", kRequired},
    {"/headline/tolerance", number, "", above(0, kInfinity), "", "", "largest difference allowed, in the same unit", kRequired},
    {"/headline/origin", text, "", any(), "", "", "where the figure comes from: closed form, theory, a publication ...",
     kRequired},

    describing({"/criteria", list, "", any(), "", "",
                "what the results must satisfy, known independently of any run; earthtop verify checks it"}),
    {"/criteria/*", object, "", any(), "", "", "one criterion"},
    {"/criteria/*/kind", word, "", any(), WordsOf<kCriterionRules>::text, "", "the kind of knowledge that it rests on",
     kRequired},
    {"/criteria/*/quantity", word, "", any(), kAllQuantities, "",
     "what is judged; for an equivalence, how the two runs are related; each kind has its own quantities"},
    {"/criteria/*/set", changes, "", any(), "", "",
     "changes, as with --set: the scenario so changed is judged; for an equivalence it is the second one"},
    {"/criteria/*/values", numbers, "", any(), "", "",
     "the known value, in the unit that the quantity's name states; for a verdict, the earliest and the latest time from which "
     "it may hold (s)"},
    {"/criteria/*/at_s", number, "s", from(0, 1e9), "", "", "the time of its row; default: the duration"},
    {"/criteria/*/until_s", number, "s", above(0, 1e9), "", "", "later rows are not judged"},
    {"/criteria/*/tolerance", number, "", from(0, kInfinity), "", "", "largest error allowed; 0: every bit must agree"},
    {"/criteria/*/why", text, "", any(), "", "", "where the value and the tolerance come from", kRequired},
    {"/criteria/*/slow", flag, "", any(), "", "false", "whether it takes over a minute, and is judged with --slow only"},

    {"/site", object, "", any(), "", "{}", "where the laboratory stands"},
    {"/site/latitude_deg", number, "deg", from(-90, 90), "", "",
     "geodetic latitude, North positive; required unless the rotation rate is 0 and gravity is given, or a table of travel has "
     "it"},
    {"/site/longitude_deg", number, "deg", kAngles, "", "0", "longitude, East positive"},
    {"/site/height_m", number, "m", from(-12000, 1e6), "", "0", "height above the WGS 84 ellipsoid"},
    {"/site/gravity_m_s2", number, "m/s^2", from(0, kInfinity), "", "",
     "apparent gravity along -Up, as a gravimeter reads it; default: WGS 84 normal gravity at latitude and height"},

    {"/site/gravity_anomaly_m_s2", number, "m/s^2", from(-0.1, 0.1), "", "",
     "gravity anomaly, as a gravity map shows it: added to normal gravity where gravity_m_s2 is not given"},

    {"/earth", object, "", any(), "", "{}", "the rotating planet"},
    {"/earth/rotation_rate_rad_s", number, "rad/s", any(), "", "7.292115e-5", "rotation rate; WGS 84"},

    {"/travel", object, "", any(), "", "",
     "a journey that carries the laboratory over the Earth, from the site on; if left out, the laboratory stays there"},
    {"/travel/path", word, "", any(), WordsOf<kTravelPaths>::text, "",
     "rhumb: constant course; geodesic: the straightest line; table: places at given times", kRequired},
    {"/travel/course_deg", number, "deg", kAngles, "", "", "rhumb, geodesic: compass course at the start"},
    {"/travel/speed_m_s", number, "m/s", from(0, 1e5), "", "",
     "rhumb, geodesic: horizontal speed at the start, of the pivot at its height, relative to the Earth"},
    {"/travel/speed_kn", number, "kn", from(0, 194384), "", "",
     "instead of speed_m_s: the same in knots, 1852/3600 m/s each; at most 1e5 m/s"},
    {"/travel/legs", list, "", any(), "", "",
     "rhumb, geodesic: changes of speed, course and height, one after the other, at most 10,000; after the last one the "
     "journey "
     "goes on as it is then"},
    {"/travel/legs/*", object, "", any(), "", "", "one leg; what is left out stays as it is"},
    {"/travel/legs/*/duration_s", number, "s", above(0, 1e9), "", "", "how long it lasts", kRequired},
    {"/travel/legs/*/speed_m_s", number, "m/s", from(0, 1e5), "", "", "speed at its end"},
    {"/travel/legs/*/speed_kn", number, "kn", from(0, 194384), "", "", "instead of speed_m_s: the same in knots"},
    {"/travel/legs/*/turn_deg", number, "deg", from(-1e6, 1e6), "", "0",
     "turn of the course in it, clockwise positive, in addition to the path's own"},
    {"/travel/legs/*/climb_m", number, "m", kLengths, "", "0", "change of height in it"},
    {"/travel/file", text, "", any(), "", "",
     "table: CSV file with the header t_s,latitude_deg,longitude_deg,height_m, from t = 0 or before to the end of the run; "
     "cubic "
     "splines go through its rows, and a step of longitude by more than 180 deg goes the other way round"},
    {"/travel/file_sha256", text, "", any(), "", "", "table: the SHA-256 that the file must have; not checked if left out"},
    {"/travel/reference", word, "", any(), WordsOf<kTravelReferences>::text, "\"same_path\"",
     "the motion from which the drift is counted: the same journey over an Earth that does not rotate, or the laboratory at "
     "rest at "
     "the site on the Earth that does"},
    {"/travel/eotvos", word, "", any(), WordsOf<kTravelEotvos>::text, "\"rotating\"",
     "which motions feel the Coriolis force on the laboratory, -2 W x v, in apparent gravity"},
    {"/travel/figure", word, "", any(), WordsOf<kTravelFigures>::text, "\"wgs84\"",
     "figure of the Earth on which the path runs"},
    {"/travel/radius_m", number, "m", above(0, 1e9), "", "6371008.7714",
     "sphere: its radius; default: the mean radius of WGS 84"},

    {"/body", object, "", any(), "", "", "the top: mass, centre of mass and inertia, or solids", kRequired},
    {"/body/mass_kg", number, "kg", above(0, 1e6), "", "", "mass"},
    {"/body/center_of_mass_m", vector3, "m", kLengths, "", "", "pivot to centre of mass, body axes"},
    {"/body/inertia", object, "", any(), "", "", "inertia tensor, body axes"},
    {"/body/inertia/about", word, "", any(), WordsOf<kInertiaPoints>::text, "\"pivot\"", "reference point of the tensor"},
    {"/body/inertia/principal_kg_m2", vector3, "kg m^2", from(0, 1e18), "", "", "moments about the body axes"},
    {"/body/inertia/matrix_kg_m2", matrix3, "kg m^2", from(-1e18, 1e18), "", "", "symmetric 3x3 tensor"},
    {"/body/solids", list, "", any(), "", "", "uniform solids of revolution about body axis 3"},
    {"/body/solids/*", object, "", any(), "", "", "one solid"},
    {"/body/solids/*/shape", word, "", any(), WordsOf<kShapeRules>::text, "", "shape; a cone's tip points to -z", kRequired},
    {"/body/solids/*/radius_m", number, "m", above(0, 1e6), "", "", "outer radius; a rod without one is thin"},
    {"/body/solids/*/inner_radius_m", number, "m", from(0, 1e6), "", "0",
     "inner radius of a ring or of a spherical shell; the outer one where it is thin"},
    {"/body/solids/*/length_m", number, "m", from(0, 1e6), "", "0", "length along axis 3; a disc or a ring may have none"},
    {"/body/solids/*/mass_kg", number, "kg", above(0, 1e6), "", "", "mass; give this or the density"},
    {"/body/solids/*/density_kg_m3", number, "kg/m^3", above(0, 1e6), "", "", "density; give this or the mass"},
    {"/body/solids/*/at_m", number, "m", kLengths, "", "0", "signed coordinate of its centre of mass along axis 3"},

    {"/release", object, "", any(), "", "", "attitude and rates at t = 0", kRequired},
    {"/release/tilt_deg", number, "deg", from(0, 180), "", "", "angle of body axis 3 from Up, or from the normal of a table"},
    {"/release/azimuth_deg", number, "deg", kAngles, "", "0", "compass azimuth that the axis leans toward"},
    {"/release/spin_angle_deg", number, "deg", kAngles, "", "0", "turn about body axis 3"},
    {"/release/quaternion_LB", object, "", any(), "", "",
     "attitude, instead of the angles; its norm must be 1 to within 1e-6, and is then made 1"},
    {"/release/quaternion_LB/w", number, "", from(-2, 2), "", "", "scalar part", kRequired},
    {"/release/quaternion_LB/x", number, "", from(-2, 2), "", "", "vector part", kRequired},
    {"/release/quaternion_LB/y", number, "", from(-2, 2), "", "", "vector part", kRequired},
    {"/release/quaternion_LB/z", number, "", from(-2, 2), "", "", "vector part", kRequired},
    {"/release/outer_angle_deg", number, "deg", kAngles, "", "",
     "gimbals: turn of the outer gimbal about its axis; for an upright axis the azimuth, counted anticlockwise from North"},
    {"/release/inner_angle_deg", number, "deg", kAngles, "", "",
     "gimbals: turn of the body about body axis 2; 0 where body axis 3 is along the outer axis, but for the skew"},
    {"/release/outer_rate_rad_s", number, "rad/s", kRates, "", "0", "gimbals: rate of the outer angle"},
    {"/release/inner_rate_rad_s", number, "rad/s", kRates, "", "0", "gimbals: rate of the inner angle"},
    {"/release/rates_relative_to", word, "", any(), WordsOf<kRateFrames>::text, "\"laboratory\"",
     "frame of the rates, and what both predictions have in common at the start"},
    {"/release/angular_velocity_body_rad_s", vector3, "rad/s", kRates, "", "", "rates in body axes"},
    {"/release/spin_rad_s", number, "rad/s", kRates, "", "", "whole rate about body axis 3, precession's share included"},
    {"/release/spin_rpm", number, "rpm", from(-9.5e9, 9.5e9), "", "",
     "instead of spin_rad_s: the same in revolutions per minute, 2 pi/60 rad/s each"},
    {"/release/precession", object_or_word, "", any(), WordsOf<kPrecessions>::text, "\"none\"",
     "precession at the start, or {\"rate_rad_s\": ...}"},
    {"/release/precession/rate_rad_s", number, "rad/s", kRates, "", "", "counterclockwise about Up", kRequired},

    {"/motion", object, "", any(), "", "", "how long the run lasts, and how often it writes a row", kRequired},
    {"/motion/duration_s", number, "s", from(1e-12, 1e9), "", "", "duration", kRequired},
    {"/motion/output_step_s", number, "s", above(0, kInfinity), "", "",
     "time between rows; default: duration/1000; if it is longer than the duration, there are rows at 0 and at the end only"},

    {"/motion/start_utc", text, "", any(), "", "",
     "the instant of release, YYYY-MM-DDThh:mm:ssZ, for which Moon, Sun and pole are looked up"},

    {"/platform", object, "", any(), "", "", "a platform that carries the pivot; none if left out"},
    {"/platform/motion", word, "", any(), WordsOf<kMotionRules>::text, "",
     "kind of motion; course: a vehicle that turns with the course of /travel", kRequired},
    {"/platform/axis", vector3, "", kLengths, "", "[0, 0, 1]", "axis of rotation, in laboratory axes; any length but 0"},
    {"/platform/rate_rad_s", number, "rad/s", kRates, "", "0", "constant, ramp: rate at t = 0"},
    {"/platform/acceleration_rad_s2", number, "rad/s^2", kRates, "", "0", "ramp: angular acceleration"},
    {"/platform/amplitude_rad", number, "rad", from(-1e6, 1e6), "", "0", "harmonic: amplitude"},
    {"/platform/frequency_hz", number, "Hz", from(0, 1e6), "", "0", "harmonic: frequency"},
    {"/platform/phase_deg", number, "deg", kAngles, "", "0", "harmonic: phase at t = 0"},
    {"/platform/pivot_offset_m", vector3, "m", kLengths, "", "[0, 0, 0]", "pivot from the centre, in platform axes"},
    {"/platform/file", text, "", any(), "", "",
     "table: a CSV file, its path relative to the scenario file; header t_s,angle_rad; rows from 0 or earlier to the duration "
     "or later, joined by a cubic spline"},
    {"/platform/file_sha256", text, "", any(), "", "", "table: the SHA-256 that the file must have; not checked if left out"},

    {"/rotor", object, "", any(), "", "",
     "a symmetric rotor that turns in the body, which is then its cage: a gyrostat. The body does not contain it; if left out, "
     "the body "
     "is rigid"},
    {"/rotor/mass_kg", number, "kg", above(0, 1e6), "", "", "mass", kRequired},
    {"/rotor/axial_kg_m2", number, "kg m^2", above(0, 1e9), "", "", "moment of inertia about its axis", kRequired},
    {"/rotor/transverse_kg_m2", number, "kg m^2", above(0, 1e9), "", "",
     "moment across its axis, about its own centre; at least half the axial one", kRequired},
    {"/rotor/axis", vector3, "", kLengths, "", "[0, 0, 1]", "its axis, in body axes; any length but 0"},
    {"/rotor/center_m", vector3, "m", kLengths, "", "[0, 0, 0]", "its centre from the pivot, in body axes"},
    {"/rotor/spin_rad_s", number, "rad/s", kRates, "", "", "rate about its axis, relative to the body, at t = 0"},
    {"/rotor/spin_rpm", number, "rpm", from(-9.5e9, 9.5e9), "", "",
     "instead of spin_rad_s: the same in revolutions per minute, 2 pi/60 rad/s each"},
    {"/rotor/drive", word, "", any(), WordsOf<kDriveRules>::text, "\"none\"",
     "none: free but for its bearing; else a motor keeps it at this rate relative to the body"},
    {"/rotor/acceleration_rad_s2", number, "rad/s^2", kRates, "", "0", "ramp: angular acceleration"},
    {"/rotor/amplitude_rad_s", number, "rad/s", kRates, "", "0", "harmonic: amplitude of the rate, which is added to the spin"},
    {"/rotor/frequency_hz", number, "Hz", from(0, 1e6), "", "0", "harmonic: frequency"},
    {"/rotor/phase_deg", number, "deg", kAngles, "", "0", "harmonic: phase at t = 0"},
    {"/rotor/file", text, "", any(), "", "",
     "table: CSV file of rates with the header t_s,rate_rad_s; its times reach from 0 to the duration"},
    {"/rotor/file_sha256", text, "", any(), "", "", "table: the SHA-256 that the file must have; not checked if left out"},
    {"/rotor/viscous_torque_N_m_s", number, "N m s", from(0, 1e9), "", "0",
     "k in the bearing's torque -k s, where s is the rotor's rate relative to the body"},
    {"/rotor/coulomb_torque_N_m", number, "N m", from(0, 1e9), "", "0",
     "T in the bearing's dry friction -T s/sqrt(s^2 + d^2), where d is the next key"},
    {"/rotor/regularisation_rad_s", number, "rad/s", above(0, 1e9), "", "",
     "rate below which the bearing's dry friction is proportional to it; required with it"},

    {"/gimbals", object, "", any(), "", "",
     "a Cardan suspension; the body is its inner gimbal, and turns about body axis 2 in the outer one. If left out, the body "
     "turns "
     "about a pivot"},
    {"/gimbals/outer", object, "", any(), "", "{}",
     "the outer gimbal; its axis 3 is the outer axis, its axis 1 is normal to both axes"},
    {"/gimbals/outer/axis_tilt_deg", number, "deg", from(0, 180), "", "0",
     "angle of the outer axis from Up, or from axis 3 of a platform"},
    {"/gimbals/outer/axis_azimuth_deg", number, "deg", kAngles, "", "0", "compass azimuth that the outer axis leans toward"},
    {"/gimbals/outer/mass_kg", number, "kg", above(0, 1e6), "", "", "mass of the outer gimbal; massless if left out"},
    {"/gimbals/outer/center_of_mass_m", vector3, "m", kLengths, "", "[0, 0, 0]",
     "its centre of mass from the point where the axes meet, in its own axes"},
    {"/gimbals/outer/inertia", object, "", any(), "", "", "its inertia tensor, in its own axes"},
    {"/gimbals/outer/inertia/about", word, "", any(), WordsOf<kInertiaPoints>::text, "\"pivot\"",
     "reference point of the tensor"},
    {"/gimbals/outer/inertia/principal_kg_m2", vector3, "kg m^2", from(0, 1e18), "", "", "moments about its axes"},
    {"/gimbals/outer/inertia/matrix_kg_m2", matrix3, "kg m^2", from(-1e18, 1e18), "", "", "symmetric 3x3 tensor"},
    {"/gimbals/outer/locked", flag, "", any(), "", "false", "whether the outer gimbal is held at its angle"},
    {"/gimbals/outer/viscous_torque_N_m_s", number, "N m s", from(0, 1e9), "", "0",
     "k in the bearing's torque -k r, where r is the rate of the outer angle"},
    {"/gimbals/outer/coulomb_torque_N_m", number, "N m", from(0, 1e9), "", "0",
     "T in the bearing's dry friction -T r/sqrt(r^2 + d^2), where d is the next key"},
    {"/gimbals/outer/regularisation_rad_s", number, "rad/s", above(0, 1e9), "", "",
     "rate below which the bearing's dry friction is proportional to it; required with it"},
    {"/gimbals/outer/torsion_N_m_rad", number, "N m/rad", from(0, 1e9), "", "0",
     "stiffness of a tape or a spring that turns the outer gimbal back to its rest"},
    {"/gimbals/outer/torsion_rest_deg", number, "deg", kAngles, "", "0", "outer angle at which it exerts no torque"},
    {"/gimbals/inner", object, "", any(), "", "{}", "the inner axis, body axis 2, on which the body turns in the outer gimbal"},
    {"/gimbals/inner/axis_skew_deg", number, "deg", from(-89.9, 89.9), "", "0",
     "angle of the inner axis from the perpendicular to the outer one, toward the outer axis"},
    {"/gimbals/inner/locked", flag, "", any(), "", "false", "whether the body is held at its angle"},
    {"/gimbals/inner/viscous_torque_N_m_s", number, "N m s", from(0, 1e9), "", "0",
     "k in the bearing's torque -k r, where r is the rate of the inner angle"},
    {"/gimbals/inner/coulomb_torque_N_m", number, "N m", from(0, 1e9), "", "0",
     "T in the bearing's dry friction -T r/sqrt(r^2 + d^2), where d is the next key"},
    {"/gimbals/inner/regularisation_rad_s", number, "rad/s", above(0, 1e9), "", "",
     "rate below which the bearing's dry friction is proportional to it; required with it"},
    {"/gimbals/inner/torsion_N_m_rad", number, "N m/rad", from(0, 1e9), "", "0",
     "stiffness of a spring that turns the body back to its rest"},
    {"/gimbals/inner/torsion_rest_deg", number, "deg", kAngles, "", "0", "inner angle at which it exerts no torque"},
    {"/moving_masses", list, "", any(), "", "",
     "masses, at most 64, that motors move on given paths in the body, which does not contain them; none if left out"},
    {"/moving_masses/*", object, "", any(), "", "", "one mass, a point"},
    {"/moving_masses/*/mass_kg", number, "kg", above(0, 1e6), "", "", "mass", kRequired},
    {"/moving_masses/*/carrier", word, "", any(), WordsOf<kMassCarriers>::text, "\"body\"",
     "what it rides on, and in whose axes its path is given"},
    {"/moving_masses/*/motion", word, "", any(), WordsOf<kMassMotionRules>::text, "",
     "kind of path; waypoints: straight lines on which it starts and stops smoothly", kRequired},
    {"/moving_masses/*/center_m", vector3, "m", kLengths, "", "",
     "fixed: its place; harmonic, circle: the middle, from the pivot"},
    {"/moving_masses/*/amplitude_m", vector3, "m", kLengths, "", "", "harmonic: a in center + a sin(2 pi f t + phase)"},
    {"/moving_masses/*/start_m", vector3, "m", kLengths, "", "",
     "circle: s in center + s cos(2 pi f t + phase) + (axis x s) sin(2 pi f t + phase); perpendicular to the axis"},
    {"/moving_masses/*/axis", vector3, "", kLengths, "", "", "circle: the axis about which it turns; any length but 0"},
    {"/moving_masses/*/frequency_hz", number, "Hz", from(-1e6, 1e6), "", "",
     "harmonic, circle: frequency; of a circle with its sign"},
    {"/moving_masses/*/phase_deg", number, "deg", kAngles, "", "0", "harmonic, circle: phase at t = 0"},
    {"/moving_masses/*/times_s", series, "s", from(0, 1e9), "", "",
     "waypoints: the times at which it rests at the points, ascending; it rests at the first one before, and at the last one "
     "after"},
    {"/moving_masses/*/points_m", points, "m", kLengths, "", "", "waypoints: as many points as times, from the pivot"},
    {"/moving_masses/*/file", text, "", any(), "", "",
     "table: CSV file of places with the header t_s,x_m,y_m,z_m, joined by cubic splines; its times reach from 0 to the "
     "duration"},
    {"/moving_masses/*/file_sha256", text, "", any(), "", "",
     "table: the SHA-256 that the file must have; not checked if left out"},

    {"/contact", object, "", any(), "", "",
     "a top whose tip stands on a table; the body's pivot is then the centre of the tip's sphere. If left out, the pivot is "
     "fixed"},
    {"/contact/tip_radius_m", number, "m", from(0, 1e3), "", "", "radius of the spherical tip; 0: a point", kRequired},
    {"/contact/law", word, "", any(), WordsOf<kContactLaws>::text, "",
     "law of sliding friction; contensou is the one for real tops, rolling the constraint of no slip", kRequired},
    {"/contact/sliding_viscosity_N_s_m", number, "N s/m", from(0, 1e9), "", "",
     "viscous: k in the friction -k v, where v is the slip velocity"},
    {"/contact/sliding_viscosity_s_m", number, "s/m", from(0, 1e9), "", "",
     "viscous_load: mu_v in the friction -mu_v N v, where N is the normal force"},
    {"/contact/friction_coefficient", number, "", from(0, 1e6), "", "",
     "coulomb, contensou: ratio of the friction to the normal force"},
    {"/contact/regularisation_m_s", number, "m/s", from(0, 1e9), "", "0",
     "coulomb: slip velocity below which friction is proportional to it; 0: the exact law, under which slip can stop"},
    {"/contact/patch_radius_m", number, "m", above(0, 1e3), "", "",
     "contensou: radius of the contact patch; about 0.03 mm for a steel tip of 2 mm on glass"},
    {"/contact/static_coefficient", number, "", above(0, 1e6), "", "",
     "rolling: the largest ratio of friction to normal force that rolling may need; needing more is reported, and changes "
     "nothing"},
    {"/contact/spinning_friction_m", number, "m", from(0, 1e3), "", "0",
     "moment of friction about the normal, divided by the normal force; acts beside any law"},
    {"/contact/rolling_resistance_m", number, "m", from(0, 1e3), "", "0",
     "moment of friction about horizontal axes, divided by the normal force; acts beside any law"},
    {"/contact/regularisation_rad_s", number, "rad/s", above(0, 1e9), "", "",
     "rate below which spinning friction and rolling resistance are proportional to it; required with either"},
    {"/contact/start", word, "", any(), WordsOf<kContactStarts>::text, "",
     "what is at rest on the table at release; default: rolling for the law rolling, otherwise tip_at_rest"},
    {"/contact/tip_velocity_m_s", vector2, "m/s", from(-1e6, 1e6), "", "",
     "instead of start: velocity of the centre of the tip's sphere along the table's axes, East and North if it is level"},
    {"/contact/tip_position_m", vector2, "m", kLengths, "", "[0, 0]", "position of the tip at release, along the table's axes"},
    {"/contact/max_tilt_deg", number, "deg", from(0, 180), "", "",
     "tilt at which the rim or the stem touches the table, which ends the run; must be above the tilt at release"},
    {"/contact/table", object, "", any(), "", "{}", "how the table stands, in both predictions"},
    {"/contact/table/tilt_deg", number, "deg", from(0, 80), "", "0",
     "angle of the table's normal from Up; tilt, azimuth and precession of the release are then about the normal"},
    {"/contact/table/tilt_azimuth_deg", number, "deg", kAngles, "", "0", "compass direction of steepest descent"},

    {"/effects", object_or_word, "", any(), "auto", "{}",
     "which torques act; \"auto\": of those that have no parameter of their own, the ones that accuracy.drift_rad needs",
     !kRequired, "", "this effect is not available"},
    {"/effects/coriolis", flag, "", any(), "", "true", "Coriolis torque"},
    {"/effects/centrifugal", flag, "", any(), "", "true", "centrifugal torque"},
    {"/effects/transverse", flag, "", any(), "", "true", "transverse torque"},
    {"/effects/select", word, "", any(), "auto", "",
     "\"auto\" as for the whole object; effects that are given with parameters are kept"},
    {"/effects/gravity_gradient", flag_or_object, "", any(), "normal", "false",
     "the Earth's gravity gradient: true, its radial term about the geocentric vertical; \"normal\", the whole tensor of the "
     "normal field; or a radial term of given strength about Up"},
    {"/effects/gravity_gradient/gm_over_r3_s2", number, "1/s^2", from(-1e9, 1e9), "", "", "GM/r^3", kRequired},
    {"/effects/tide", flag_or_object, "", any(), "", "false",
     "luni-solar tide in apparent gravity: true, that of Moon and Sun on a rigid Earth from start_utc; or with the factors of "
     "an elastic Earth; or a harmonic one of given amplitude"},
    {"/effects/tide/gravimetric_factor", number, "", from(0, 10), "", "1", "factor of the vertical part; about 1.16"},
    {"/effects/tide/tilt_factor", number, "", from(0, 10), "", "1", "factor of the horizontal part; about 0.69"},
    {"/effects/tide/amplitude_m_s2", vector3, "m/s^2", from(-1e3, 1e3), "", "",
     "harmonic: a in a sin(2 pi f t + phase), in laboratory axes"},
    {"/effects/tide/frequency_hz", number, "Hz", from(0, 1e6), "", "", "harmonic: frequency"},
    {"/effects/tide/phase_deg", number, "deg", kAngles, "", "0", "harmonic: phase at t = 0"},
    {"/effects/polar_motion", flag_or_object, "", any(), "", "false",
     "the Earth's pole: true, the secular pole of the IERS conventions at start_utc; or as measured"},
    {"/effects/polar_motion/x_arcsec", number, "arcsec", from(-10, 10), "", "", "toward Greenwich", kRequired},
    {"/effects/polar_motion/y_arcsec", number, "arcsec", from(-10, 10), "", "", "toward 90 deg West", kRequired},
    {"/effects/excess_length_of_day_ms", number, "ms", from(-1000, 1000), "", "0",
     "excess of a day over 86400 s: the rotation rate is less by this fraction of itself"},
    {"/effects/deflection_of_vertical", object, "", any(), "", "",
     "the plumb line's zenith minus the ellipsoid's normal; latitude and azimuths remain those of the ellipsoid"},
    {"/effects/deflection_of_vertical/north_arcsec", number, "arcsec", from(-3600, 3600), "", "0", "xi"},
    {"/effects/deflection_of_vertical/east_arcsec", number, "arcsec", from(-3600, 3600), "", "0", "eta"},
    {"/effects/viscous_torque_N_m_s", number_or_vector3, "N m s", from(0, 1e9), "", "0",
     "k in the torque -k w, where w is the rate relative to the platform, or else to the laboratory; three numbers: of the "
     "body "
     "axes"},
    {"/effects/quadratic_torque_N_m_s2", number, "N m s^2", from(0, 1e9), "", "0", "c in the torque -c |w| w"},
    {"/effects/coulomb_torque_N_m", number, "N m", from(0, 1e9), "", "0",
     "T in the pivot's dry friction -T w/|w|, which at rest withstands torques up to T"},
    {"/effects/air_drag", object, "", any(), "", "",
     "drag on a disc that spins about body axis 3 in still air, after von Karman"},
    {"/effects/air_drag/disc_radius_m", number, "m", above(0, 1e3), "", "", "radius of the disc", kRequired},
    {"/effects/air_drag/density_kg_m3", number, "kg/m^3", above(0, 1e5), "", "1.204",
     "density of the air; default: at 20 deg C"},
    {"/effects/air_drag/kinematic_viscosity_m2_s", number, "m^2/s", above(0, 1e3), "", "1.516e-5",
     "kinematic viscosity of the air; default: at 20 deg C"},
    {"/effects/air_drag/flow", word, "", any(), WordsOf<kDiscFlows>::text, "\"auto\"",
     "boundary layer; auto: turbulent where the Reynolds number of the spin at release is above 3e5"},
    {"/effects/gimbal", flag_or_object, "", any(), "", "false",
     "holds body axis 3 level: it turns about Up only, as in a gyrocompass"},
    {"/effects/gimbal/damping_N_m_s", number, "N m s", from(0, 1e9), "", "0", "damping of its turn about Up"},
    {"/effects/unequal_support", object, "", any(), "", "",
     "a pivot that is not equally stiff: an energy kappa (n.e)^2/2 of the body axis 3, n, and of a horizontal direction e"},
    {"/effects/unequal_support/kappa_N_m", number, "N m", from(-1e9, 1e9), "", "", "kappa; below 0: softer along e"},
    {"/effects/unequal_support/periods_s", vector2, "s", above(0, 1e9), "", "",
     "instead of kappa, the periods of a pendulum's small swings along e and across it, of which the ratio counts"},
    {"/effects/unequal_support/azimuth_deg", number, "deg", kAngles, "", "0", "compass direction of e"},
    {"/effects/given_torque", object, "", any(), "", "", "a torque that is given as a function of time, about the pivot"},
    {"/effects/given_torque/axes", word, "", any(), WordsOf<kTorqueAxes>::text, "",
     "the axes of its components: they turn with the body, or rest in the laboratory", kRequired},
    {"/effects/given_torque/course", word, "", any(), WordsOf<kTorqueCourses>::text, "\"constant\"", "its course in time"},
    {"/effects/given_torque/torque_N_m", vector3, "N m", from(-1e9, 1e9), "", "",
     "constant: the torque; harmonic: a in a sin(2 pi f t + phase)"},
    {"/effects/given_torque/frequency_hz", number, "Hz", from(0, 1e6), "", "", "harmonic: frequency"},
    {"/effects/given_torque/phase_deg", number, "deg", kAngles, "", "0", "harmonic: phase at t = 0"},
    {"/effects/given_torque/file", text, "", any(), "", "",
     "table: CSV file with the header t_s,x_N_m,y_N_m,z_N_m, from t = 0 or before to the end of the run; a cubic spline goes "
     "through its rows"},
    {"/effects/given_torque/file_sha256", text, "", any(), "", "",
     "table: the SHA-256 that the file must have; not checked if left out"},
    {"/effects/air_force", object, "", any(), "", "",
     "force of the air on a top that stands on a table: -(b + c |v|) v at the centre of mass, for its velocity v"},
    {"/effects/air_force/linear_N_s_m", number, "N s/m", from(0, 1e9), "", "0", "b"},
    {"/effects/air_force/quadratic_N_s2_m2", number, "N s^2/m^2", from(0, 1e9), "", "0", "c"},

    {"/numerics", object, "", any(), "", "{}", "how to integrate"},
    {"/numerics/method", word, "", any(), kMethodWords, "\"auto\"",
     "integration method; closed_form: no integration, for scenarios that have a closed form"},
    {"/numerics/observer", word, "", any(), "laboratory|body|inertial", "\"laboratory\"",
     "observer whose equations are integrated"},
    {"/numerics/model", word, "", any(), "auto|general", "\"auto\"",
     "auto: a symmetric top in the laboratory is integrated without its spin; general: attitude and rates of any body"},
    {"/numerics/precision", word, "", any(), "double|long_double|float128", "\"double\"",
     "scalar type: 53, 64 or 113 bits; the last prints 34 digits"},
    // The decoder checks the limits for each precision: least_tolerance, default_tolerance.
    {"/numerics/relative_tolerance", number, "", from(1e-32, 1e-1), "", "1e-12",
     "local error of a step, for methods that control it; at least 1e-14 in double, 5e-18 in long_double; default: 1e-16 in "
     "long_double, 1e-28 in float128",
     !kRequired, "and at least 1e-14 in double, 5e-18 in long_double"},
    {"/numerics/step_s", number, "s", above(0, 1e9), "", "",
     "step of the fixed-step methods; abm8 requires it, gauss and splitting find it from relative_tolerance where it is not "
     "given; the step taken divides output_step_s"},
    {"/numerics/composition", word, "", any(), "auto|aba82|aba84|aba864|aba1064|rkn6|kahan_li8", "\"auto\"",
     "for splitting: how the exact flows follow one another; auto is rkn6"},
    {"/numerics/ledger", word, "", any(), "inertial|laboratory|platform|body", "",
     "observer of the torque ledger torques.csv; it is not written if left out"},

    {"/accuracy", object, "", any(), "", "{}", "required accuracy"},
    {"/accuracy/drift_rad", number, "rad", above(0, kPi), "", "",
     "largest error accepted in the axis drift: sets the tolerance of method \"auto\"; a bound above it ends the run with "
     "status 3"},

    {"/report", object, "", any(), "", "{}", "what else to report"},
    {"/report/threshold_rad", number, "rad", above(0, kPi), "", "",
     "the time at which the axis drift first passes it is reported"},
    {"/report/until_spin_rad_s", number, "rad/s", kRates, "", "",
     "the time at which the spin first comes to it is reported, e.g. when it has fallen to it"},
    {"/report/until_tilt_deg", number, "deg", from(0, 180), "", "",
     "the time at which the tilt first comes to it is reported, e.g. when the top has fallen"},
    {"/report/sensitivities", flag, "", any(), "", "false",
     "whether to report the derivatives of the last reliable drift with respect to the inputs"},

    describing({"/instrument", object, "", any(), "", "",
                "what lies between the motion and measured numbers: a mount, zeros and senses of scales, a clock; for compare "
                "and plan"}),

    {"/uncertainty", object, "", any(), "", "",
     "standard errors of the inputs, from which that of the drift is computed and reported"},
};

/// All fields: those above and, at their end, the numbers of an instrument and the standard errors of the inputs.
constexpr auto kFields = [] {
  std::array<Field, std::size(kOwnFields) + 2 * kInstrumentInputs + kInstrumentScales + kInputCount> all{};
  std::size_t end = 0;
  for (const Field& field : kOwnFields) all[end++] = field;
  for (const InstrumentRow& row : kInstrument) {
    all[end++] = {row.pointer, number, row.unit, from(row.least, row.most), "", row.fallback, row.doc};
    all[end++] = {row.standard_error,
                  number,
                  row.unit,
                  from(0, row.most),
                  "",
                  "0",
                  "standard error of the number above, as it is known beforehand; 0: not stated"};
  }
  for (const InstrumentScale& scale : kReadScales) all[end++] = {scale.reversed, flag, "", any(), "", "false", scale.doc};
  for (const InputRow& row : kInputs) all[end++] = {row.pointer, number, row.unit, from(0, row.most), "", "0", row.doc};
  return all;
}();

constexpr FieldTable kTable = {"scenario", "scenario", kFields, kWishes};

}  // namespace

const FieldTable& fields() { return kTable; }

}  // namespace earthtop::scenario
