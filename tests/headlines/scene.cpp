// SPDX-License-Identifier: GPL-3.0-or-later
#include "scene.hpp"

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>

namespace headlines {
namespace {

using Json = nlohmann::json;

Vec vector(const Json& list) { return {list.at(0).get<double>(), list.at(1).get<double>(), list.at(2).get<double>()}; }

void read_site(const Json& json, Scene& scene) {
  const Json& site = json.at("site");
  const SinCos latitude = sin_cos_degrees(site.value("latitude_deg", 0.0));
  scene.celestial_axis = {0, latitude.cos, latitude.sin};
  scene.rotation_rate = json.value("earth", Json::object()).value("rotation_rate_rad_s", 7.292115e-5);
  scene.gravity = site.at("gravity_m_s2").get<double>();
}

/// The inertia is that about the centre of mass for a top on a table, else about the pivot.
void read_body(const Json& body, Scene& scene) {
  const Json& inertia = body.at("inertia");
  if (inertia.contains("principal_kg_m2")) {
    const Vec moments = vector(inertia.at("principal_kg_m2"));
    scene.inertia = {{moments.x, 0, 0}, {0, moments.y, 0}, {0, 0, moments.z}};
  } else {
    const Json& rows = inertia.at("matrix_kg_m2");
    scene.inertia = {vector(rows.at(0)), vector(rows.at(1)), vector(rows.at(2))};
  }
  scene.mass = body.at("mass_kg").get<double>();
  scene.centre = vector(body.at("center_of_mass_m"));
  scene.mass_moment = scene.mass * scene.centre;
  const bool about_centre = inertia.value("about", "pivot") == "center_of_mass";
  if (about_centre != scene.contact.has_value())
    add_point_mass(about_centre ? scene.mass : -scene.mass, scene.centre, scene.inertia);
}

/// A key of a bearing. @returns whether it is one
bool read_bearing(const std::string& key, const Json& value, Bearing& bearing) {
  if (key == "viscous_torque_N_m_s")
    bearing.viscous = value.get<double>();
  else if (key == "coulomb_torque_N_m")
    bearing.coulomb = value.get<double>();
  else if (key == "regularisation_rad_s")
    bearing.regularisation = value.get<double>();
  else if (key == "torsion_N_m_rad")
    bearing.torsion = value.get<double>();
  else if (key == "torsion_rest_deg")
    bearing.rest = Real(value.get<double>()) * pi() / 180;
  else if (key == "locked")
    bearing.locked = value.get<bool>();
  else
    return false;
  return true;
}

/// Adds the rotor's mass and transverse moment to the body's.
void read_rotor(const Json& json, const std::string& file, Scene& scene) {
  Rotor rotor;
  Vec axis{0, 0, 1}, centre;
  Real mass = 0, transverse = 0;
  for (const auto& [key, value] : json.items()) {
    if (key == "mass_kg")
      mass = value.get<double>();
    else if (key == "axial_kg_m2")
      rotor.axial = value.get<double>();
    else if (key == "transverse_kg_m2")
      transverse = value.get<double>();
    else if (key == "axis")
      axis = vector(value);
    else if (key == "center_m")
      centre = vector(value);
    else if (key == "spin_rad_s")
      rotor.spin = value.get<double>();
    else if (key == "drive" && (value == "none" || scene.gimbals))
      rotor.driven = value != "none";
    else if (key == "acceleration_rad_s2")
      rotor.acceleration = value.get<double>();
    else if (key == "amplitude_rad_s")
      rotor.amplitude = value.get<double>();
    else if (key == "frequency_hz")
      rotor.frequency = value.get<double>();
    else if (key == "phase_deg")
      rotor.phase = Real(value.get<double>()) * pi() / 180;
    else if (!read_bearing(key, value, rotor.bearing))
      throw std::runtime_error(file + ": the rotor's " + key + " is beyond this program");
  }
  rotor.axis = (1 / norm(axis)) * axis;
  const Vec& c = rotor.axis;
  scene.inertia.a += transverse * (Vec{1, 0, 0} - c.x * c);
  scene.inertia.b += transverse * (Vec{0, 1, 0} - c.y * c);
  scene.inertia.c += transverse * (Vec{0, 0, 1} - c.z * c);
  add_point_mass(mass, centre, scene.inertia);
  scene.mass += mass;
  scene.mass_moment += mass * centre;
  scene.rotor = rotor;
}

/// The outer gimbal's own tensor and mass moment; it may be massless.
void read_ring(const Json& outer, Gimbals& gimbals) {
  if (!outer.contains("mass_kg")) return;
  Scene ring;
  Json body = outer;
  if (!body.contains("center_of_mass_m")) body["center_of_mass_m"] = {0, 0, 0};
  read_body(body, ring);
  gimbals.ring_inertia = ring.inertia, gimbals.ring_mass_moment = ring.mass_moment;
}

void read_gimbals(const Json& json, const Json& release, const std::string& file, Scene& scene) {
  Gimbals gimbals;
  const Json outer = json.value("outer", Json::object()), inner = json.value("inner", Json::object());
  const auto unknown = [&](const std::string& key) {
    throw std::runtime_error(file + ": the gimbals' " + key + " is beyond this program");
  };
  for (const auto& [key, value] : outer.items())
    if (!read_bearing(key, value, gimbals.outer) && key != "axis_tilt_deg" && key != "axis_azimuth_deg" && key != "mass_kg" &&
        key != "center_of_mass_m" && key != "inertia")
      unknown(key);
  for (const auto& [key, value] : inner.items())
    if (!read_bearing(key, value, gimbals.inner) && key != "axis_skew_deg") unknown(key);
  read_ring(outer, gimbals);
  // The axis leans by the tilt toward the compass azimuth; axis 2 of the outer gimbal is then level.
  const SinCos azimuth = sin_cos_degrees((90 - Real(outer.value("axis_azimuth_deg", 0.0))) / 2);
  const SinCos tilt = sin_cos_degrees(Real(outer.value("axis_tilt_deg", 0.0)) / 2);
  const SinCos skew = sin_cos_degrees(Real(inner.value("axis_skew_deg", 0.0)) / 2);
  gimbals.q_P0 = Quat{azimuth.cos, {0, 0, azimuth.sin}} * Quat{tilt.cos, {0, tilt.sin, 0}};
  gimbals.q_skew = {skew.cos, {skew.sin, 0, 0}};
  gimbals.outer_angle = Real(release.at("outer_angle_deg").get<double>()) * pi() / 180;
  gimbals.inner_angle = Real(release.at("inner_angle_deg").get<double>()) * pi() / 180;
  gimbals.outer_rate = release.value("outer_rate_rad_s", 0.0);
  gimbals.inner_rate = release.value("inner_rate_rad_s", 0.0);
  const Quat released =
      gimbals.q_P0 * turn({0, 0, 1}, gimbals.outer_angle) * gimbals.q_skew * turn({0, 1, 0}, gimbals.inner_angle);
  if (released.w < 0) gimbals.q_P0 = {-gimbals.q_P0.w, Real(-1) * gimbals.q_P0.v};
  scene.gimbals = gimbals;
}

Quat release_attitude(const Json& release) {
  if (release.contains("quaternion_LB")) {
    const Json& q = release.at("quaternion_LB");
    return normalized({q.at("w").get<double>(), {q.at("x").get<double>(), q.at("y").get<double>(), q.at("z").get<double>()}});
  }
  // The axis leans by the tilt toward the compass azimuth, and the body is turned about it by the spin angle.
  const SinCos azimuth = sin_cos_degrees((90 - Real(release.value("azimuth_deg", 0.0))) / 2);
  const SinCos tilt = sin_cos_degrees(Real(release.at("tilt_deg").get<double>()) / 2);
  const SinCos spin = sin_cos_degrees(Real(release.value("spin_angle_deg", 0.0)) / 2);
  return Quat{azimuth.cos, {0, 0, azimuth.sin}} * Quat{tilt.cos, {0, tilt.sin, 0}} * Quat{spin.cos, {0, 0, spin.sin}};
}

/// Steady precession rate v of the symmetric top without Earth rotation: I1 cos(tilt) v^2 - I3 w3 v + m g l = 0.
Real steady_rate(const Scene& scene, Real spin, Real cosine, bool fast) {
  const Real momentum = scene.inertia.c.z * spin, mgl = scene.mass_moment.z * scene.gravity, a = scene.inertia.a.x * cosine;
  const Real root = sqrtq(momentum * momentum - 4 * a * mgl);
  const Real sum = momentum < 0 ? momentum - root : momentum + root;
  return fast ? sum / (2 * a) : 2 * mgl / sum;
}

void read_release(const Json& release, Scene& scene) {
  scene.inertial_rates = release.value("rates_relative_to", "laboratory") == "inertial";
  if (scene.gimbals) return;
  scene.q_LB = release_attitude(release);
  if (scene.q_LB.w < 0) scene.q_LB = {-scene.q_LB.w, Real(-1) * scene.q_LB.v};
  if (release.contains("angular_velocity_body_rad_s")) {
    scene.w_XB_B = vector(release.at("angular_velocity_body_rad_s"));
    return;
  }
  const Real spin =
      scene.rotor || !scene.masses.empty() ? release.value("spin_rad_s", 0.0) : release.at("spin_rad_s").get<double>();
  const Vec up_B = matrix(scene.q_LB).c;
  const Json precession = release.value("precession", Json("none"));
  Real rate = 0;
  if (precession.is_object())
    rate = precession.at("rate_rad_s").get<double>();
  else if (precession != "none" && (scene.contact || scene.rotor || !scene.masses.empty()))
    throw std::runtime_error("steady precession on a table, with a rotor or with masses is beyond this program");
  else if (precession != "none")
    rate = steady_rate(scene, spin, up_B.z, precession == "steady_fast");
  scene.w_XB_B = {rate * up_B.x, rate * up_B.y, spin};  // spin_rad_s is the whole component along axis 3
}

void read_mass(const Json& json, const std::string& file, Scene& scene) {
  MovingMass mass;
  const std::string motion = json.at("motion");
  mass.mass = json.at("mass_kg").get<double>();
  mass.on_ring = json.value("carrier", "body") == "outer";
  if (json.contains("center_m")) mass.centre = vector(json.at("center_m"));
  mass.frequency = json.value("frequency_hz", 0.0);
  mass.phase = Real(json.value("phase_deg", 0.0)) * pi() / 180;
  if (motion == "harmonic") {
    mass.along_sin = vector(json.at("amplitude_m"));
  } else if (motion == "circle") {
    const Vec axis = vector(json.at("axis"));
    mass.along_cos = vector(json.at("start_m"));
    mass.along_sin = (1 / norm(axis)) * cross(axis, mass.along_cos);
  } else if (motion == "waypoints") {
    for (const Json& time : json.at("times_s")) mass.times.push_back(time.get<double>());
    for (const Json& point : json.at("points_m")) mass.points.push_back(vector(point));
  } else if (motion != "fixed") {
    throw std::runtime_error(file + ": a mass's motion " + motion + " is beyond this program");
  }
  scene.masses.push_back(mass);
}

void read_platform(const Json& json, Scene& scene) {
  Platform platform;
  const Vec axis = json.contains("axis") ? vector(json.at("axis")) : Vec{0, 0, 1};
  platform.axis = (1 / norm(axis)) * axis;
  if (json.contains("pivot_offset_m")) platform.offset = vector(json.at("pivot_offset_m"));
  platform.rate = json.value("rate_rad_s", 0.0);
  platform.acceleration = json.value("acceleration_rad_s2", 0.0);
  platform.amplitude = json.value("amplitude_rad", 0.0);
  platform.frequency = json.value("frequency_hz", 0.0);
  platform.phase = json.value("phase_deg", 0.0) * pi() / 180;
  scene.platform = platform;
}

void read_contact(const Json& json, const std::string& file, Scene& scene) {
  Contact contact;
  for (const auto& [key, value] : json.items()) {
    if (key == "tip_radius_m")
      contact.tip_radius = value.get<double>();
    else if (key == "law" && (value == "rolling" || value == "contensou"))
      contact.rolling = contact.released_rolling = value == "rolling";
    else if (key == "friction_coefficient")
      contact.friction = value.get<double>();
    else if (key == "patch_radius_m")
      contact.patch_radius = value.get<double>();
    else
      throw std::runtime_error(file + ": the contact's " + key + " is beyond this program");
  }
  scene.contact = contact;
}

void read_effects(const Json& json, const std::string& file, Scene& scene) {
  Acting& acting = scene.acting;
  for (const auto& [effect, value] : json.items()) {
    const auto only = [&, name = effect](const Json& object, const std::string& keys) {
      for (const auto& [key, ignored] : object.items())
        if (keys.find('|' + key + '|') == std::string::npos)
          throw std::runtime_error(file + ": " + name + "/" + key + " is beyond this program");
    };
    if (effect == "viscous_torque_N_m_s") {
      const Real one = value.is_number() ? value.get<double>() : 0.0;
      acting.friction = value.is_number() ? Vec{one, one, one} : vector(value);
    } else if (effect == "unequal_support") {
      only(value, "|kappa_N_m|azimuth_deg|");
      const SinCos azimuth = sin_cos_degrees(value.value("azimuth_deg", 0.0));
      acting.stiffness = value.at("kappa_N_m").get<double>(), acting.stiff_direction = {azimuth.sin, azimuth.cos, 0};
    } else if (effect == "given_torque") {
      only(value, "|axes|course|torque_N_m|frequency_hz|phase_deg|");
      acting.torque = vector(value.at("torque_N_m")), acting.torque_of_body = value.at("axes") == "body";
      acting.torque_oscillates = value.value("course", "constant") == "harmonic";
      acting.frequency = value.value("frequency_hz", 0.0), acting.phase = value.value("phase_deg", 0.0) * pi() / 180;
    } else if (effect == "air_force") {
      acting.drag = value.value("linear_N_s_m", 0.0), acting.drag_by_speed = value.value("quadratic_N_s2_m2", 0.0);
    } else if (value != true) {
      throw std::runtime_error(file + ": the effect " + effect + " is beyond this program");
    }
  }
}

void read_travel(const Json& json, const std::string& file, const Json& site, Scene& scene) {
  Travel travel;
  const auto speed_of = [](const Json& moving, Real otherwise) {
    if (moving.contains("speed_kn")) return Real(static_cast<double>(Real(moving.at("speed_kn").get<double>()) * 1852 / 3600));
    return moving.contains("speed_m_s") ? Real(moving.at("speed_m_s").get<double>()) : otherwise;
  };
  const std::string path = json.at("path");
  if (path == "table" || scene.platform || scene.contact || norm(scene.acting.friction) > 0 ||
      json.value("eotvos", "rotating") != "rotating")
    throw std::runtime_error(file + ": this journey is beyond this program");
  travel.geodesic = path == "geodesic";
  travel.latitude = sin_cos_degrees(site.at("latitude_deg").get<double>());
  travel.course = sin_cos_degrees(json.at("course_deg").get<double>());
  travel.height = site.value("height_m", 0.0);
  travel.still_reference = json.value("reference", "same_path") == "at_rest";
  if (json.value("figure", "wgs84") == "sphere") {
    travel.radius = json.value("radius_m", 6371008.7714);
  } else {
    const Real flattening = Real(1'000'000'000) / Real(298'257'223'563LL);
    travel.e2 = flattening * (2 - flattening);
  }
  Leg leg;
  leg.speed_before = leg.speed_after = speed_of(json, 0);
  for (const Json& given : json.value("legs", Json::array())) {
    leg.duration = given.at("duration_s").get<double>();
    leg.speed_before = leg.speed_after, leg.speed_after = speed_of(given, leg.speed_before);
    leg.turned_before += leg.turn, leg.turn = Real(given.value("turn_deg", 0.0)) * pi() / 180;
    leg.climbed_before += leg.climb, leg.climb = given.value("climb_m", 0.0);
    travel.legs.push_back(leg);
    leg.start += leg.duration;
  }
  leg.duration = 0, leg.speed_before = leg.speed_after;
  leg.turned_before += leg.turn, leg.turn = 0, leg.climbed_before += leg.climb, leg.climb = 0;
  travel.legs.push_back(leg);
  scene.travel = travel;
}

}  // namespace

Scene read_scene(const std::string& file) {
  std::ifstream stream(file);
  const Json json = Json::parse(stream);
  Scene scene;
  scene.name = json.value("name", std::filesystem::path(file).stem().string());
  read_effects(json.value("effects", Json::object()), file, scene);
  if (json.at("body").contains("solids")) throw std::runtime_error(file + ": solids are beyond this program");
  read_site(json, scene);
  if (json.contains("contact")) read_contact(json.at("contact"), file, scene);
  read_body(json.at("body"), scene);
  if (json.contains("gimbals")) read_gimbals(json.at("gimbals"), json.at("release"), file, scene);
  if (json.contains("rotor")) read_rotor(json.at("rotor"), file, scene);
  for (const Json& mass : json.value("moving_masses", Json::array())) read_mass(mass, file, scene);
  if (scene.contact && !scene.masses.empty()) throw std::runtime_error(file + ": masses on a table are beyond this program");
  if (!scene.gimbals) scene.inverse_inertia = inverse(scene.inertia);
  read_release(json.at("release"), scene);
  if (json.contains("platform")) read_platform(json.at("platform"), scene);
  if (json.contains("travel")) read_travel(json.at("travel"), file, json.at("site"), scene);
  scene.duration = json.at("motion").at("duration_s").get<double>();
  scene.headline_time = json.value("headline", Json::object()).value("at_s", scene.duration);
  return scene;
}

}  // namespace headlines
