// SPDX-License-Identifier: GPL-3.0-or-later
/// The times at which a run looks at its motions. Besides the output rows, which the user asks for, these are times of the run's own:
/// all that is said of the whole motion (bounds, verdict, trend, largest drift, pictures) comes from them, so that it does not depend on
/// the rows.
#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "drift/motion_way.hpp"
#include "earthtop/drift/drift_integration.hpp"
#include "earthtop/scene/scene.hpp"
#include "run/trend.hpp"

namespace earthtop {

/// The purpose of a look.
enum class LookFor : std::uint8_t { row = 1, judgement = 2, trend = 4, picture = 8 };

/// Times of looks, ascending, and what each of them is for.
struct Looks {
  std::vector<double> times_s;
  std::vector<std::uint8_t> purposes;

  std::size_t size() const { return times_s.size(); }
  bool serves(std::size_t look, LookFor purpose) const { return (purposes[look] & static_cast<std::uint8_t>(purpose)) != 0; }
  /// Adds times; one that is there already gets the purpose as well. @param times_s  ascending
  void add(std::span<const double> added_s, LookFor purpose);
  /// The looks for rows and judgement, up to the one with a given number.
  Looks compared(std::size_t count) const;
};

/// When to look at the axes for pictures and for the largest drift: often enough for their fastest motion. A run with many periods of
/// it is looked at in windows, each as long as one period, evenly spread over the run.
struct PicturePlan {
  double step_s = 0;               ///< between two looks
  std::vector<double> times_s;     ///< ascending, from the release to the end of the run
  std::size_t looks_a_window = 0;  ///< 0: the looks are evenly spaced from the release to the end
};

/// The times at which a run looks besides its rows.
struct LookPlan {
  TrendPlan trend;
  PicturePlan picture;
  std::vector<double> judged_s;  ///< none where steps end at the looks, as fixed steps do
};

/// The errors of a run at a look for judgement.
struct JudgedLook {
  double t_s = 0;
  double axis_rad = 0, attitude_rad = 0;              ///< drifts
  double axis_bound_rad = 0, attitude_bound_rad = 0;  ///< bounds on their errors
  double tip_bound_m = 0;                             ///< of a top on a table
  /// Of the rotor of a gyrostat: the drift of its axis, and bounds on the errors of the drifts of axis, rate and angle.
  struct OfRotor {
    double axis_rad = 0, axis_bound_rad = 0, rate_bound_rad_s = 0, angle_bound_rad = 0;
  };
  std::optional<OfRotor> rotor = {};

  /// Of the gimbals of a Cardan suspension: sizes of the drifts of both angles, and bounds on their errors.
  struct OfGimbals {
    double outer_rad = 0, outer_bound_rad = 0, inner_rad = 0, inner_bound_rad = 0;
    GimbalHeadline headline = GimbalHeadline::axis;
  };
  std::optional<OfGimbals> gimbals = {};

  GimbalHeadline headline() const { return gimbals ? gimbals->headline : GimbalHeadline::axis; }
  double watched_axis_rad() const {
    if (headline() != GimbalHeadline::axis)
      return headline() == GimbalHeadline::outer ? gimbals->outer_rad : gimbals->inner_rad;
    return rotor ? rotor->axis_rad : axis_rad;
  }
  double watched_axis_bound_rad() const {
    if (headline() != GimbalHeadline::axis)
      return headline() == GimbalHeadline::outer ? gimbals->outer_bound_rad : gimbals->inner_bound_rad;
    return rotor ? rotor->axis_bound_rad : axis_bound_rad;
  }
};
/// The bounds at a time: those of the first look for judgement that is not earlier, since bounds only grow.
const JudgedLook& judged_at(std::span<const JudgedLook> judged, double t_s);
/// Gives a row the bounds at its time.
void take_bounds(std::span<const JudgedLook> judged, DriftRow& row);

LookPlan plan_looks(const Scene& scene, const IntegrationOptions& first);

/// Whether the first integration of a run can look between its rows for next to nothing.
bool looks_between_rows(const IntegrationOptions& first, Precision precision);

/// What integrations for looks take over from the run and from each other.
struct LookMemory {
  std::optional<KickSteps> kick_steps;  ///< that the run's first integration has found
  std::shared_ptr<MotionWay> way = new_way();
  static std::shared_ptr<MotionWay> new_way();
};

/// Adds the time until it is destroyed to that of looks.
class LookTimer {
 public:
  explicit LookTimer(MotionWay& way) : way_(way), start_(std::chrono::steady_clock::now()) {}
  ~LookTimer() { way_.looked_seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count(); }
  LookTimer(const LookTimer&) = delete;
  LookTimer& operator=(const LookTimer&) = delete;

 private:
  MotionWay& way_;
  std::chrono::steady_clock::time_point start_;
};

/// The motion at other times, from an integration that is made for these looks, as options_for_looks has it (scene/parts.hpp).
/// @param times_s  ascending, the release first; of the first looks with a memory the last one is the end of the run
DriftTrajectory<double> look_again(const Scene& scene, std::vector<double> times_s, const IntegrationOptions& first,
                                   const LookMemory& memory, const Watch& watch);

}  // namespace earthtop
