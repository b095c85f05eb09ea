// SPDX-License-Identifier: GPL-3.0-or-later
#include "measure/features.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <span>

#include "earthtop/scene/top_figures.hpp"
#include "measure/quantities.hpp"

namespace earthtop::measure {
namespace {

constexpr double kLooksATurn = 32, kLooksATurningPoint = 16;  // between a feature and the next
constexpr double kMostLooks = 100'000;
constexpr int kLooksInside = 24;     // between two looks that have a feature between them
constexpr double kFarthest = 16;     // times the measured time after which a turn is not looked for any longer
constexpr double kRounding = 1e-11;  // of the body's rate: an angle that changes more slowly does not turn
constexpr double kFollowed = 2.5;    // of an azimuth from one look to the next (rad): more may be less, the other way round

bool is_turning(const MeasuredValue& value) { return row_of(value.quantity).feature == Feature::turning; }
bool is_passage(const MeasuredValue& value) { return row_of(value.quantity).feature == Feature::passage; }
bool is_period(const MeasuredValue& value) { return row_of(value.quantity).feature == Feature::period; }

/// The time of a turn that is known before any motion (s): that of the mean precession, where there is one.
double likely_turn_s(const Scene& scene) {
  const std::optional<double> period_s = earthtop::period_of(scene.top().mean_precession_rad_s);
  return period_s ? *period_s : scene.scenario().duration_s;
}

/// The least time between two different ones of ascending times (s); the last of them where there is no other.
double least_gap(const std::vector<double>& times_s) {
  double gap = HUGE_VAL;
  for (std::size_t k = 1; k < times_s.size(); ++k)
    if (times_s[k] > times_s[k - 1]) gap = std::min(gap, times_s[k] - times_s[k - 1]);
  return std::isfinite(gap) ? gap : times_s.empty() ? 0 : times_s.back();
}

/// How far and how closely a motion is looked at.
struct Span {
  double end_s = 0, step_s = HUGE_VAL;
  void need(double to_s, double every_s) {
    end_s = std::max(end_s, to_s);
    if (every_s > 0) step_s = std::min(step_s, every_s);
  }
};

Span span_of(const Scene& scene, const Measurement& measurement) {
  Span span;
  std::vector<double> turnings_s, passages_s;
  for (const MeasuredValue& value : measurement.values) {
    if (is_turning(value)) turnings_s.push_back(value.t_s);
    if (is_passage(value)) passages_s.push_back(value.value > 0 ? value.value : value.t_s);
    if (is_period(value)) {
      const double turn_s = value.value > 0 ? value.value : likely_turn_s(scene);
      span.need(value.t_s + 1.25 * turn_s, turn_s / kLooksATurn);
    }
    if (is_passage(value) && value.turns > 0)
      span.need(1.25 * passages_s.back(), passages_s.back() / value.turns / kLooksATurn);
    if (is_passage(value) && value.turns == 0) {
      const double turn_s = likely_turn_s(scene);
      span.need(passages_s.back() + turn_s, turn_s / kLooksATurn);
    }
  }
  if (!turnings_s.empty()) {
    double gap_s = least_gap(turnings_s);
    if (!(gap_s > 0)) gap_s = scene.scenario().duration_s;
    span.need(turnings_s.back() + gap_s, gap_s / kLooksATurningPoint);
  }
  if (!(span.end_s > 0)) span.end_s = scene.scenario().duration_s;
  span.step_s = std::max(std::min(span.step_s, span.end_s / kLooksATurn), span.end_s / kMostLooks);
  return span;
}

/// Ascending times with each one once: those given, and even ones.
std::vector<double> with_even_times(std::vector<double> times_s, const Span& span) {
  const double count = std::ceil(span.end_s / span.step_s);
  for (double k = 1; k <= count; ++k) times_s.push_back(span.end_s * (k / count));
  std::ranges::sort(times_s);
  times_s.erase(std::unique(times_s.begin(), times_s.end()), times_s.end());
  return times_s;
}

/// An angle at a time, and its rate.
struct Look {
  double t_s, angle, rate;
};

/// A polynomial of third degree through two looks.
class Between {
 public:
  Between(const Look& a, const Look& b) : a_(a), length_(b.t_s - a.t_s) {
    const double rise = (b.angle - a.angle) / length_;
    square_ = (3 * rise - 2 * a.rate - b.rate) / length_;
    cube_ = (a.rate + b.rate - 2 * rise) / (length_ * length_);
  }
  double angle(double s) const { return a_.angle + s * (a_.rate + s * (square_ + s * cube_)); }
  double rate(double s) const { return a_.rate + s * (2 * square_ + 3 * s * cube_); }
  /// The place where a function of the polynomial, which has other signs at both ends, is 0, from the first look on (s).
  template <class Function>
  double root(const Function& at) const {
    double low = 0, high = length_;
    const bool rises = at(high) > 0;
    for (int k = 0; k < 200 && low < high; ++k) {
      const double middle = low + (high - low) / 2;
      if (middle == low || middle == high) break;
      ((at(middle) > 0) == rises ? high : low) = middle;
    }
    return low + (high - low) / 2;
  }
  PredictedFeature turning_point() const {
    const double s = root([this](double at) { return rate(at); });
    return {angle(s), a_.t_s + s, 0, a_.rate > 0 ? Extreme::maximum : Extreme::minimum};
  }
  double time_at(double wanted) const {
    return a_.t_s + root([&](double s) { return angle(s) - wanted; });
  }

 private:
  Look a_;
  double length_, square_, cube_;
};

/// The looks at an angle of a motion; an azimuth is counted on over whole turns.
std::vector<Look> looks_at(std::span<const PredictedAxis> axes, MeasuredQuantity quantity) {
  std::vector<Look> looks;
  looks.reserve(axes.size());
  for (const PredictedAxis& axis : axes) {
    double angle = axis[quantity];
    if (quantity == MeasuredQuantity::azimuth && !looks.empty())
      angle = looks.back().angle + std::remainder(angle - looks.back().angle, kWholeTurn);
    looks.push_back({axis.t_s, angle, axis.rate_of(quantity)});
  }
  return looks;
}

/// Where a feature is: between a look and the next.
using Place = std::optional<std::size_t>;

bool turns_between(const Look& a, const Look& b, Extreme wanted) {
  const bool is_top = a.rate > 0 && b.rate <= 0, is_bottom = a.rate < 0 && b.rate >= 0;
  return (is_top && wanted != Extreme::minimum) || (is_bottom && wanted != Extreme::maximum);
}

/// A turning point between two looks, or at the release.
struct Turning {
  double t_s;         // nearly
  std::size_t place;  // of the look before it
  bool is_top, is_release;
};

/// The turning points of an angle, ascending in time; a release at rest is one.   @param rounding_rad_s  rates below this are none
std::vector<Turning> turnings_of(const std::vector<Look>& looks, double rounding_rad_s) {
  std::vector<Turning> turnings;
  if (looks.size() > 1 && std::abs(looks[0].rate) <= rounding_rad_s && std::abs(looks[1].rate) > rounding_rad_s)
    turnings.push_back({looks[0].t_s, 0, looks[1].rate < 0, true});
  for (std::size_t k = 0; k + 1 < looks.size(); ++k) {
    const Look &a = looks[k], &b = looks[k + 1];
    if (!turns_between(a, b, Extreme::either) || std::max(std::abs(a.rate), std::abs(b.rate)) <= rounding_rad_s) continue;
    turnings.push_back({a.t_s + (b.t_s - a.t_s) * a.rate / (a.rate - b.rate), k, a.rate > 0, false});
  }
  return turnings;
}

/// The turning point of the wanted kind next to a time; null where there is none.
const Turning* nearest_turning(const std::vector<Turning>& turnings, const MeasuredValue& value) {
  const auto is_wanted = [&](const Turning& one) {
    return value.extreme == Extreme::either || one.is_top == (value.extreme == Extreme::maximum);
  };
  const auto later = std::ranges::lower_bound(turnings, value.t_s, {}, &Turning::t_s);
  const auto after = std::find_if(later, turnings.end(), is_wanted);
  const auto before = std::find_if(std::make_reverse_iterator(later), turnings.rend(), is_wanted);
  if (before == turnings.rend()) return after == turnings.end() ? nullptr : &*after;
  return after == turnings.end() || value.t_s - before->t_s <= after->t_s - value.t_s ? &*before : &*after;
}

/// The first two looks between which an angle passes a level, from a look on.
Place passing_place(const std::vector<Look>& looks, std::size_t from, double level, double sense) {
  for (std::size_t k = from; k + 1 < looks.size(); ++k)
    if (sense * (looks[k + 1].angle - level) >= 0) return k;
  return std::nullopt;
}

bool is_counted(const std::vector<Look>& looks) {
  for (std::size_t k = 1; k < looks.size(); ++k)
    if (!(std::abs(looks[k].angle - looks[k - 1].angle) < kFollowed)) return false;
  return true;
}

/// One feature that is looked for.
struct Wanted {
  std::size_t value;  // its number in the measurement
  Place place;        // among the first looks
  bool is_release = false;
  double level = 0;    // the angle that is passed
  double begin_s = 0;  // from which the time of a period counts
  double turns = 1;
};

class FeatureSearch {
 public:
  FeatureSearch(const Scene& scene, const Measurement& measurement, const Watch& watch, std::optional<Method> method)
      : scene_(scene), measurement_(measurement), watch_(watch), method_(method), sought_(sought_of(measurement)) {}

  PredictedMotion find() {
    Span span = span_of(scene_, measurement_);
    const double farthest_s = kFarthest * span.end_s;
    for (;;) {
      const std::vector<double> times_s = with_even_times(measured_times(measurement_), span);
      first_ = predict(scene_, times_s, sought_, watch_, method_);
      if (first_.status != RunStatus::completed) return at_measured_times();
      place_all();
      const bool is_missing = std::ranges::any_of(
          wanted_, [&](const Wanted& one) { return !one.place && !is_turning(measurement_.values[one.value]); });
      if (!is_missing || span.end_s >= farthest_s || first_.end || !is_countable_) break;
      span.end_s *= 2;
      if (span.end_s / span.step_s > kMostLooks) break;
    }
    PredictedMotion found = at_measured_times();
    look_inside(found);
    return found;
  }

 private:
  MeasuredQuantity quantity_of(const Wanted& one) const {
    const QuantityRow& row = row_of(measurement_.values[one.value].quantity);
    return row.feature == Feature::turning ? row.of : MeasuredQuantity::azimuth;
  }

  void place_all() {
    wanted_.clear();
    const std::vector<Look> azimuths = looks_at(first_.axes, MeasuredQuantity::azimuth);
    is_countable_ = is_counted(azimuths);
    const double sense = azimuths.back().angle < azimuths.front().angle ? -1 : 1;
    double passed = 0;  // turns, of the passage before
    std::map<MeasuredQuantity, std::vector<Turning>> turnings;
    double fastest_rad_s = 0;
    for (const PredictedAxis& axis : first_.axes) fastest_rad_s = std::max(fastest_rad_s, norm(axis.w_LB_B));
    for (std::size_t i = 0; i < measurement_.values.size(); ++i) {
      const MeasuredValue& value = measurement_.values[i];
      const QuantityRow& row = row_of(value.quantity);
      if (row.feature == Feature::value) continue;
      Wanted& one = wanted_.emplace_back(Wanted{i, std::nullopt});
      if (row.feature == Feature::turning) {
        const auto [known, is_new] = turnings.try_emplace(row.of);
        if (is_new) known->second = turnings_of(looks_at(first_.axes, row.of), kRounding * fastest_rad_s);
        if (const Turning* turning = nearest_turning(known->second, value))
          one.place = turning->place, one.is_release = turning->is_release;
        continue;
      }
      if (!is_countable_) continue;
      const auto look_at = [&](double t_s) {
        const auto look = std::ranges::lower_bound(azimuths, t_s, {}, &Look::t_s);
        return static_cast<std::size_t>(std::min(look, azimuths.end() - 1) - azimuths.begin());
      };
      const std::size_t from = is_period(value) ? look_at(value.t_s) : 0;
      if (is_passage(value)) {
        const double made =
            sense * (azimuths[look_at(value.value > 0 ? value.value : value.t_s)].angle - azimuths[0].angle) / kWholeTurn;
        one.turns = value.turns > 0 ? value.turns : std::max(passed + 1, std::round(made));
        passed = std::floor(one.turns);
      }
      one.level = azimuths[from].angle + sense * one.turns * kWholeTurn;
      one.begin_s = is_period(value) ? value.t_s : 0;
      one.place = passing_place(azimuths, from, one.level, sense);
    }
    sense_ = sense;
  }

  /// The motion at the measured times alone.
  PredictedMotion at_measured_times() const {
    PredictedMotion motion{first_.status, {}, first_.end, std::vector<PredictedFeature>(measurement_.values.size())};
    std::size_t at = 0;
    for (const double t_s : measured_times(measurement_)) {
      while (at < first_.axes.size() && first_.axes[at].t_s < t_s) ++at;
      if (at == first_.axes.size()) break;
      motion.axes.push_back(first_.axes[at]);
    }
    return motion;
  }

  void look_inside(PredictedMotion& found) {
    std::vector<double> times_s = {0};
    const auto time_inside = [&](std::size_t place, int k) {
      const double begin_s = first_.axes[place].t_s, end_s = first_.axes[place + 1].t_s;
      return k == kLooksInside ? end_s : begin_s + (end_s - begin_s) * (static_cast<double>(k) / kLooksInside);
    };
    for (const Wanted& one : wanted_)
      for (int k = 0; one.place && !one.is_release && k <= kLooksInside; ++k) times_s.push_back(time_inside(*one.place, k));
    std::ranges::sort(times_s);
    times_s.erase(std::unique(times_s.begin(), times_s.end()), times_s.end());
    Sought angles = sought_;
    angles.drift = angles.swing = angles.tip = false;
    const PredictedMotion second = times_s.size() > 1 ? predict(scene_, times_s, angles, watch_, method_) : PredictedMotion{};
    if (second.status != RunStatus::completed) {
      found.status = second.status;
      return;
    }
    const std::vector<Look> first_azimuths = looks_at(first_.axes, MeasuredQuantity::azimuth);
    for (const Wanted& one : wanted_) {
      if (!one.place) continue;
      const MeasuredQuantity quantity = quantity_of(one);
      if (one.is_release) {
        const bool is_top = first_.axes[1].rate_of(quantity) < 0;
        found.features[one.value] = {first_.axes.front()[quantity], 0, 0, is_top ? Extreme::maximum : Extreme::minimum};
        continue;
      }
      const auto begin = std::ranges::lower_bound(second.axes, time_inside(*one.place, 0), {}, &PredictedAxis::t_s);
      const auto end = std::ranges::upper_bound(second.axes, time_inside(*one.place, kLooksInside), {}, &PredictedAxis::t_s);
      std::vector<Look> looks = looks_at({begin, end}, quantity);
      found.features[one.value] =
          is_turning(measurement_.values[one.value]) ? turning_point(looks, one) : passing_time(looks, one, first_azimuths);
    }
  }

  PredictedFeature turning_point(const std::vector<Look>& looks, const Wanted& one) const {
    for (std::size_t k = 0; k + 1 < looks.size(); ++k)
      if (turns_between(looks[k], looks[k + 1], measurement_.values[one.value].extreme))
        return Between(looks[k], looks[k + 1]).turning_point();
    return {};
  }

  PredictedFeature passing_time(std::vector<Look>& looks, const Wanted& one, const std::vector<Look>& first_azimuths) const {
    if (looks.empty()) return {};
    // As many turns as the first looks have counted.
    const double shift = std::round((first_azimuths[*one.place].angle - looks[0].angle) / kWholeTurn) * kWholeTurn;
    for (Look& look : looks) look.angle += shift;
    const Place place = passing_place(looks, 0, one.level, sense_);
    if (!place) return {};
    const double t_s = Between(looks[*place], looks[*place + 1]).time_at(one.level);
    return {t_s - one.begin_s, t_s, one.turns};
  }

  const Scene& scene_;
  const Measurement& measurement_;
  const Watch& watch_;
  std::optional<Method> method_;
  Sought sought_;
  PredictedMotion first_;
  std::vector<Wanted> wanted_;
  bool is_countable_ = false;
  double sense_ = 1;
};

}  // namespace

bool has_features(const Measurement& measurement) {
  return std::ranges::any_of(measurement.values,
                             [](const MeasuredValue& value) { return row_of(value.quantity).feature != Feature::value; });
}

PredictedMotion predict_features(const Scene& scene, const Measurement& measurement, const Watch& watch,
                                 std::optional<Method> method) {
  return FeatureSearch(scene, measurement, watch, method).find();
}

}  // namespace earthtop::measure
