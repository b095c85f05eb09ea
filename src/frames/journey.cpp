// SPDX-License-Identifier: GPL-3.0-or-later
#include "earthtop/frames/journey.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "earthtop/frames/rotation.hpp"
#include "frames/journey_path.hpp"

namespace earthtop {
namespace {

template <class T>
using SeriesVector = std::array<PowerSeries<T>, 3>;

template <class T>
SeriesVector<T> operator+(const SeriesVector<T>& a, const SeriesVector<T>& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}
template <class T>
SeriesVector<T> operator-(const SeriesVector<T>& a, const SeriesVector<T>& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
template <class T>
SeriesVector<T> operator*(const PowerSeries<T>& s, const SeriesVector<T>& a) {
  return {s * a[0], s * a[1], s * a[2]};
}
template <class T>
SeriesVector<T> cross(const Vec3<T>& a, const SeriesVector<T>& b) {
  using S = PowerSeries<T>;
  return {S(a[1]) * b[2] - S(a[2]) * b[1], S(a[2]) * b[0] - S(a[0]) * b[2], S(a[0]) * b[1] - S(a[1]) * b[0]};
}
template <class T>
SeriesVector<T> rate_of(const SeriesVector<T>& a) {
  return {derivative(a[0]), derivative(a[1]), derivative(a[2])};
}
template <class T>
SeriesVector<T> constant(const Vec3<T>& a) {
  return {PowerSeries<T>(a[0]), PowerSeries<T>(a[1]), PowerSeries<T>(a[2])};
}
/// A rotation about an axis, and what it makes of a vector.
template <class T>
struct SeriesTurn {
  PowerSeries<T> sine, cosine;
  Vec3<T> axis;
  SeriesVector<T> operator()(const SeriesVector<T>& v) const {
    const PowerSeries<T> along =
        PowerSeries<T>(axis[0]) * v[0] + PowerSeries<T>(axis[1]) * v[1] + PowerSeries<T>(axis[2]) * v[2];
    return cosine * v + sine * cross(axis, v) + ((PowerSeries<T>(T(1)) - cosine) * along) * constant(axis);
  }
};

/// What a unit of each component counts beside the others of its part: a place is two angles and a height, a course an angle, a speed and
/// a length. Without it the terms of an angle would be dropped that are below the rounding of a height in metres.
constexpr std::array<double, 3> weights_of(std::size_t part) {
  constexpr double kMetre = 1 / kEquatorialRadiusWgs84, kSpeed = 1e-3;
  if (part == static_cast<std::size_t>(JourneyPart::place)) return {1, 1, kMetre};
  if (part == static_cast<std::size_t>(JourneyPart::course)) return {1, kSpeed, kMetre};
  return {1, 1, 1};
}

/// The number of terms that are left of a part's polynomial on [0, length] once those are dropped that are below rounding.
template <class T>
int terms_that_count(const SeriesVector<T>& v, std::size_t part, int terms, const T& length) {
  const std::array<double, 3> weights = weights_of(part);
  T power = T(1), largest = T(0);
  std::array<T, PowerSeries<T>::kMost> size{};
  for (int k = 0; k < terms; ++k, power *= length) {
    T& most = size[static_cast<std::size_t>(k)];
    for (std::size_t i = 0; i < 3; ++i) most = std::max(most, T(T(weights[i]) * power * real::abs(v[i][k])));
    largest = std::max(largest, most);
  }
  while (terms > 0 && !(size[static_cast<std::size_t>(terms - 1)] > real::epsilon<T>() / T(8) * largest)) --terms;
  return terms;
}

/// Makes the pieces of a journey.
template <class T>
class JourneyMaker {
 public:
  using Series = PowerSeries<T>;
  using Parts = std::array<SeriesVector<T>, kJourneyParts>;
  using Piece = typename Journey<T>::Piece;

  JourneyMaker(const TravelSpec& spec, const JourneySetting<T>& setting)
      : spec_(spec),
        setting_(setting),
        path_(spec, setting.site.latitude_deg, setting.site.height_m),
        pole_(T(0), path_.at_start().cos, path_.at_start().sin) {
    const T speed = path_.largest_speed();
    still_reference_ = spec.reference == TravelReference::at_rest;
    if (still_reference_ && speed > T(0)) epsilon_ = std::min(T(1), T(speed / T(kEquatorialRadiusWgs84)));
    if (!spec.has_normal_gravity) return;
    const auto& start = path_.at_start();
    const Series height((T(setting.site.height_m)));
    const T exact = normal_gravity_of<T, Series>(Series(start.sin), Series(start.cos), height)[0];
    const T rest = exact + T(setting.gravity_anomaly) - T(setting.site.gravity_m_s2);
    // Gravity that is moved for a derivative stays as it is moved.
    if (real::abs(rest) < T(kRounding) * exact) gravity_rest_ = rest;
  }

  T epsilon() const { return epsilon_; }

  std::vector<Piece> pieces() {
    const T end = T(setting_.duration_s);
    std::vector<T> corners = path_.corners();
    std::erase_if(corners, [&](const T& t) { return !(t < end); });
    corners.push_back(end);
    std::vector<Piece> made;
    T t = T(0), guess = end;
    std::size_t corner = 0;
    while (t < end || made.empty()) {
      while (corner + 1 < corners.size() && !(t < corners[corner])) ++corner;
      const T rest = corners[corner] - t;
      const WayFrom<T> way = path_.from(t, place_);
      const Parts parts = parts_of(way, t);
      T length = std::min(guess, rest);
      while (length > T(1e-9) * rest && !ends_in_time(parts, length)) length *= T(0.7);
      if (length > T(0.6) * rest && length < rest)
        length = T(0.5) * rest;  // the rest of a part is not cut into a long and a short one
      made.push_back(piece_of(parts, t, length));
      if (made.size() > kMostPieces)
        throw JourneyError(
            fmt::format("has more than {} stretches that differ, up to t = {:.6g} s; take a shorter run or a lower speed",
                        kMostPieces, static_cast<double>(t)));
      refuse_pole(way, t, length);
      place_ = {way.latitude.at(length), way.longitude.at(length), way.height.at(length), way.course.at(length)};
      length_ += parts[static_cast<std::size_t>(JourneyPart::course)][2].change_at(length);
      gravity_change_ += gravity_.change_at(length);
      guess = T(2) * length;
      t = length < rest ? T(t + length) : corners[corner];
    }
    return made;
  }

 private:
  static constexpr int kTerms = Series::kMost - 2;  // two derivatives are taken
  static constexpr std::size_t kMostPieces = 1'000'000;
  static constexpr double kRounding = 1e-14;  // of the site's gravity, which is a double

  /// Whether the last two terms of each part are below the rounding of the largest.
  static bool ends_in_time(const Parts& parts, const T& length) {
    for (std::size_t i = 0; i < kJourneyParts; ++i)
      if (terms_that_count(parts[i], i, kTerms, length) > kTerms - 2) return false;
    return true;
  }
  static Piece piece_of(const Parts& parts, const T& start, const T& length) {
    Piece piece;
    piece.start = start;
    for (std::size_t i = 0; i < kJourneyParts; ++i) {
      const int terms = terms_that_count(parts[i], i, kTerms, length);
      for (int k = 0; k < terms; ++k) piece.parts[i].push_back(Vec3<T>(parts[i][0][k], parts[i][1][k], parts[i][2][k]));
    }
    return piece;
  }
  void refuse_pole(const WayFrom<T>& way, const T& t, const T& length) const {
    const T nearest = sin_cos_degrees(T(90) - T(kLargestLatitudeDeg)).sin;
    const auto is_near = [&](const T& u) { return !(way.cos_latitude.at(u) > nearest); };
    if (!is_near(length)) return;
    T before = T(0), after = length;
    for (int i = 0; i < 60; ++i) {
      const T middle = (before + after) / T(2);
      (is_near(middle) ? after : before) = middle;
    }
    throw JourneyError(
        fmt::format("comes nearer than {:g} deg to a pole at t = {:.6g} s, where East and North lose their meaning; take a "
                    "shorter run or another course",
                    90 - kLargestLatitudeDeg, static_cast<double>(T(t + after))));
  }

  Parts parts_of(const WayFrom<T>& way, const T& t) {
    Parts parts;
    const auto part = [&](JourneyPart name) -> SeriesVector<T>& { return parts[static_cast<std::size_t>(name)]; };
    const Series zero((T(0))), one((T(1)));
    const SeriesVector<T> nothing{zero, zero, zero};
    parts.fill(nothing);

    // L's axes less those of the release, in the axes that turn with the Earth, over epsilon with a reference at rest.
    const T scale = still_reference_ ? T(1) / epsilon_ : T(1);
    const Series s0((pole_[2])), c0((pole_[1])), over((scale));
    const SinCos<Series> d = sin_cos(way.latitude), l = sin_cos(way.longitude);
    const SinCos<Series> half_d = sin_cos(Series(T(1) / T(2)) * way.latitude),
                         half_l = sin_cos(Series(T(1) / T(2)) * way.longitude);
    const Series sd = over * d.sin, sl = over * l.sin, two((T(2)));
    const Series vd = two * half_d.sin * (over * half_d.sin), vl = two * half_l.sin * (over * half_l.sin);  // versines
    const Series &s = way.sin_latitude, &c = way.cos_latitude;
    const SeriesVector<T> east{zero - vl, s0 * sl, zero - c0 * sl};
    const SeriesVector<T> north{zero - s * sl, zero - vd - s * s0 * vl, s * c0 * vl - sd};
    const SeriesVector<T> up{c * sl, sd + c * s0 * vl, zero - vd - c * c0 * vl};
    const Series back((still_reference_ ? epsilon_ : T(1)));
    const SeriesVector<T> x{one, zero, zero}, y{zero, one, zero}, z{zero, zero, one};
    const SeriesVector<T> east_E = x + back * east, north_E = y + back * north, up_E = z + back * up;

    const SeriesVector<T> transport{zero - derivative(way.latitude), derivative(way.longitude) * c,
                                    derivative(way.longitude) * s};
    const SeriesVector<T> velocity_E = way.east * east_E + way.north * north_E + way.up * up_E;
    gravity_ = zero;
    if (spec_.has_normal_gravity) gravity_ = normal_gravity_of<T, Series>(s, c, Series(T(setting_.site.height_m)) + way.height);
    Series gravity_change(gravity_change_);  // since the release
    for (int k = 1; k < Series::kMost; ++k) gravity_change[k] = gravity_[k];
    gravity_change.terms = std::min(Series::kMost, gravity_.terms);

    if (!still_reference_) {
      part(JourneyPart::east) = east_E, part(JourneyPart::north) = north_E, part(JourneyPart::up) = up_E;
      part(JourneyPart::rate) = transport, part(JourneyPart::rate_slope) = rate_of(transport);
      part(JourneyPart::velocity) = velocity_E;
      part(JourneyPart::field) = (zero - gravity_change - Series(gravity_rest_)) * up_E - rate_of(velocity_E);
    } else {
      const T rate = setting_.earth_rate;
      const Vec3<T> W = rate * pole_;
      Series angle((T(rate * t)));
      angle[1] = rate;
      const SinCos<Series> both = sin_cos(angle);
      const SeriesTurn<T> into_A{both.sin, both.cos, pole_};
      part(JourneyPart::east) = into_A(x), part(JourneyPart::north) = into_A(y), part(JourneyPart::up) = into_A(z);
      part(JourneyPart::rate) = constant(W);
      part(JourneyPart::field) = (zero - Series(gravity_rest_)) * into_A(z);
      part(JourneyPart::east_change) = into_A(east), part(JourneyPart::north_change) = into_A(north);
      part(JourneyPart::up_change) = into_A(up);
      // The celestial axis in L less that at the release: (0, cos phi - cos phi0, sin phi - sin phi0).
      const SeriesVector<T> axis_change{zero, zero - c0 * vd - s0 * sd, c0 * sd - s0 * vd};
      part(JourneyPart::rate_change) = over * transport + Series(rate) * axis_change;
      part(JourneyPart::slope_change) = rate_of(part(JourneyPart::rate_change));
      const SeriesVector<T> scaled = over * velocity_E;
      SeriesVector<T> change = (zero - over * gravity_change) * up_E - Series(gravity_rest_) * up - rate_of(scaled);
      if (spec_.eotvos != TravelEotvos::off) change = change - Series(T(2)) * cross(W, scaled);
      part(JourneyPart::field_change) = into_A(change);
    }
    part(JourneyPart::place) = {way.latitude, way.longitude, way.height};
    part(JourneyPart::course) = {way.course, way.speed, integral(way.speed, length_)};
    if (spec_.path == TravelPath::table) {
      const Series square = way.east * way.east + way.north * way.north;
      const Series speed = square[0] > T(0) ? sqrt(square) : zero;
      part(JourneyPart::course) = {zero, speed, integral(speed, length_)};
    }
    part(JourneyPart::velocity_in_L) = {way.east, way.north, way.up};
    return parts;
  }

  const TravelSpec& spec_;
  const JourneySetting<T>& setting_;
  JourneyPath<T> path_;
  Vec3<T> pole_;  ///< the celestial axis at the release
  bool still_reference_ = false;
  T epsilon_ = T(1);
  T gravity_rest_ = T(0);    ///< what gravity at the release is more than the site's, which is a double
  T gravity_change_ = T(0);  ///< since the release
  Series gravity_;
  T length_ = T(0);
  typename JourneyPath<T>::Place place_;
};

}  // namespace

template <class T>
Journey<T>::Journey(const TravelSpec& spec, const JourneySetting<T>& setting) {
  JourneyMaker<T> maker(spec, setting);
  const SinCos<T> phi = sin_cos_degrees(T(setting.site.latitude_deg));
  Data made;
  made.pieces = maker.pieces();
  made.still_reference = spec.reference == TravelReference::at_rest;
  made.eotvos = spec.eotvos;
  made.epsilon = maker.epsilon(), made.earth_rate = setting.earth_rate;
  made.site = setting.site;
  made.pole = Vec3<T>(T(0), phi.cos, phi.sin);
  made.course_deg = spec.course_deg;
  made.from_table = spec.path == TravelPath::table;
  data_ = std::make_shared<const Data>(std::move(made));
}

template <class T>
void Journey<T>::expand(JourneyPart part, const T& t, std::span<std::array<T, 3>> rows) const {
  const Piece& p = piece(t + T(64) * real::epsilon<T>() * (real::abs(t) + T(1)));
  Polynomial shifted = p.parts[static_cast<std::size_t>(part)];
  const T u = t - p.start;
  // Horner's scheme again and again: after the k-th pass the k-th coefficient is that at u.
  for (std::size_t k = 0; k + 1 < shifted.size(); ++k)
    for (std::size_t i = shifted.size() - 1; i-- > k;) shifted[i] += u * shifted[i + 1];
  for (std::size_t k = 0; k < rows.size(); ++k)
    for (std::size_t i = 0; i < 3; ++i) rows[k][i] = k < shifted.size() ? shifted[k][static_cast<int>(i)] : T(0);
}

template <class T>
T Journey<T>::largest_turning(const T& end) const {
  T largest = T(0);
  const std::vector<Piece>& pieces = data_->pieces;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const T length = std::max(T(0), T((i + 1 < pieces.size() ? pieces[i + 1].start : end) - pieces[i].start));
    const Polynomial& c = pieces[i].parts[static_cast<std::size_t>(JourneyPart::course)];
    T bound = T(0);
    for (std::size_t k = c.size(); k-- > 1;) bound = length * bound + T(static_cast<int>(k)) * real::abs(c[k][0]);
    largest = std::max(largest, bound);
  }
  return largest;
}

template <class T>
std::vector<T> Journey<T>::joints() const {
  std::vector<T> times;
  for (std::size_t i = 1; i < data_->pieces.size(); ++i) times.push_back(data_->pieces[i].start);
  return times;
}

template <class T>
Journey<T> Journey<T>::only(JourneyPart part) const {
  Data alone = *data_;
  for (Piece& p : alone.pieces)
    for (std::size_t i = 0; i < kJourneyParts; ++i)
      if (i != static_cast<std::size_t>(part)) p.parts[i].clear();
  Journey made;
  made.data_ = std::make_shared<const Data>(std::move(alone));
  return made;
}

namespace {

/// The power of the unit of time in a part.
int power_of_time(JourneyPart part) {
  switch (part) {
    case JourneyPart::rate:
    case JourneyPart::rate_change:
    case JourneyPart::velocity:
    case JourneyPart::velocity_in_L: return 1;
    case JourneyPart::rate_slope:
    case JourneyPart::slope_change:
    case JourneyPart::field:
    case JourneyPart::field_change: return 2;
    default: return 0;
  }
}

}  // namespace

template <class T>
Journey<T> Journey<T>::in_time_units(int time_exponent) const {
  Data scaled = *data_;
  scaled.earth_rate = real::scale(scaled.earth_rate, time_exponent);
  for (Piece& p : scaled.pieces) {
    p.start = real::scale(p.start, -time_exponent);
    for (std::size_t i = 0; i < kJourneyParts; ++i) {
      int exponent = power_of_time(static_cast<JourneyPart>(i)) * time_exponent;
      for (Vec3<T>& c : p.parts[i]) {
        for (int j = 0; j < 3; ++j) c[j] = real::scale(c[j], exponent);
        exponent += time_exponent;
      }
    }
  }
  Journey made;
  made.data_ = std::make_shared<const Data>(std::move(scaled));
  return made;
}

template <class T>
JourneyPlace<T> Journey<T>::place(const T& t) const {
  const Vec3<T> moved = at(JourneyPart::place, t), course = at(JourneyPart::course, t), v = at(JourneyPart::velocity_in_L, t);
  const T radian = real::pi<T>() / T(180);
  JourneyPlace<T> place{};
  place.latitude_deg = T(data_->site.latitude_deg) + moved[0] * T(180) / real::pi<T>();
  place.longitude_deg = T(data_->site.longitude_deg) + moved[1] * T(180) / real::pi<T>();
  place.height_m = T(data_->site.height_m) + moved[2];
  place.course_deg = data_->from_table ? real::atan2(v[0], v[1]) / radian : T(data_->course_deg) + course[0] / radian;
  place.course_deg = real::fmod(place.course_deg, T(360));
  if (place.course_deg < T(0)) place.course_deg += T(360);
  place.speed_m_s = course[1], place.length_m = course[2];
  return place;
}

template class Journey<double>;
template class Journey<float80>;
template class Journey<float128>;

}  // namespace earthtop
