// SPDX-License-Identifier: GPL-3.0-or-later
#include "plan/optimise.hpp"

#include <fmt/core.h>
#include <gsl/gsl_multimin.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <exception>
#include <memory>

#include "earthtop/elementary.hpp"
#include "earthtop/scenario/reference.hpp"
#include "error/gsl_errors.hpp"
#include "input/node.hpp"
#include "measure/measured_motion.hpp"
#include "plan/derivatives.hpp"
#include "plan/planned_rows.hpp"
#include "scenario/document.hpp"
#include "scene/examine.hpp"

namespace earthtop {
namespace plan {
namespace {

constexpr std::size_t kMostDesignInputs = 4;
constexpr std::string_view kDuration = "/motion/duration_s", kStep = "/motion/output_step_s";
constexpr int kGridPoints[] = {9, 5, 4, 3};  // along each number, for one to four of them
constexpr std::size_t kStarts = 2;           // points of the grid from which a simplex starts
constexpr int kMostIterations = 60;
constexpr double kSmallSimplex = 2e-3;  // rad; a thousandth of the range in its middle
constexpr double kFirstStep = 0.25;     // rad
constexpr double kNearLimit = 0.02;     // part of the range; a best value so near to a limit is compared with the limit
constexpr double kNoWorse = 1e-3;  // a design at a limit is taken if its standard error is not larger by more than this part
constexpr double kAtLimit = 1e-3;
constexpr double kNoDesign = 1e3;  // in place of the logarithm of a standard error

[[noreturn]] void refuse_design(const std::string& pointer, const std::string& what) {
  throw ScenarioError("--optimise " + input::excerpt(pointer, 80), what);
}

using Point = std::vector<double>;

class Designs {
 public:
  struct Stopped {};

  Designs(const ScenarioSource& source, const Overrides& overrides, const MeasurementPlan& plan, const Numbers& numbers,
          const std::vector<DesignInput>& design, const Watch& watch, std::int64_t& predictions)
      : source_(source),
        overrides_(overrides),
        plan_(plan),
        numbers_(numbers),
        design_(design),
        watch_(watch),
        predictions_(predictions),
        part_(1 / expected_designs(design.size())) {}

  /// The number's standard error with this design; none without such a motion.
  std::optional<double> standard_error(const Point& x) {
    if (watch_.asks_to_stop()) throw Stopped();
    ++evaluations_;
    const double begun = share_;
    share_ += part_ * (1 - share_);
    const Watch watch = watch_.part(begun, share_);
    std::optional<double> error;
    try {
      const Tried tried = bound_at(x, watch);
      error = tried.error;
      if (error && (!best_ || *error < slack_ * best_->error)) {
        if (is_reliable(tried, watch))
          best_ = Best{x, *error, tried.value, tried.rows};
        else
          error.reset();
      }
    } catch (const ScenarioError&) {  // no steady precession, or another number that does not fit
    }
    if (watch_.asks_to_stop()) throw Stopped();
    if (!error) ++avoided_;
    return error;
  }

  /// Takes this design for the best one unless it is worse by more than `kNoWorse`.
  void prefer(const Point& x) {
    slack_ = 1 + kNoWorse;
    standard_error(x);
    slack_ = 1;
  }

  struct Best {
    Point x;
    double error = 0, value = 0;
    std::size_t rows = 0;
  };
  const std::optional<Best>& best() const { return best_; }
  std::int64_t evaluations() const { return evaluations_; }
  std::int64_t avoided() const { return avoided_; }

 private:
  struct Tried {
    Scene scene;
    double until_s = 0;
    std::size_t rows = 0;
    std::optional<double> error;
    double value = 0;
  };

  Tried bound_at(const Point& x, const Watch& watch) {
    Tried tried;
    Overrides changed = overrides_;
    tried.until_s = *plan_.until_s;
    for (std::size_t i = 0; i < design_.size(); ++i) {
      changed.emplace_back(design_[i].pointer, fmt::format("{}", x[i]));
      if (design_[i].pointer != kDuration) continue;
      tried.until_s = x[i];
      changed.emplace_back(kStep, fmt::format("{}", x[i]));
    }
    tried.rows = count_rows(plan_.every_s, tried.until_s);
    const Scene given = parse_scene(source_, changed);
    const Overrides longer = lasting(changed, given.scenario(), tried.until_s);
    tried.scene = parse_scene(source_, longer);
    const measure::EstimatedInputs inputs(source_, longer, tried.scene, numbers_.names, kMostNumbers);
    tried.value = inputs.list()[0].start;
    const Derivatives derivatives = derivatives_of(tried.scene, inputs, inputs.list().size(), plan_.quantities,
                                                   planned_times(plan_.every_s, tried.rows), watch, predictions_);
    if (derivatives.outcome != PlanOutcome::determined) return tried;
    ValueChoice choice;
    choice.correlation_time_s = plan_.correlation_time_s;
    tried.error = bound_of(derivatives, scales_of(inputs.list()), numbers_.priors, choice).standard_error(0);
    return tried;
  }

  bool is_reliable(const Tried& tried, const Watch& watch) const {
    const auto judged = measure::judged_motion(tried.scene, tried.until_s, Watch(watch).with_progress(nullptr));
    return judged.status == RunStatus::completed && !measure::is_beyond_prediction(judged.verdict, tried.until_s);
  }

  const ScenarioSource& source_;
  const Overrides& overrides_;
  const MeasurementPlan& plan_;
  const Numbers& numbers_;
  const std::vector<DesignInput>& design_;
  const Watch& watch_;
  std::int64_t& predictions_;
  double part_, share_ = 0, slack_ = 1;
  std::optional<Best> best_;
  std::int64_t evaluations_ = 0, avoided_ = 0;
};

struct GridPoint {
  Point x;
  double error = 0;
};

/// The points of a grid, limits included, that have a motion, the least standard error first.
std::vector<GridPoint> grid_search(Designs& designs, const std::vector<DesignInput>& design) {
  const int along = kGridPoints[design.size() - 1];
  std::vector<GridPoint> found;
  std::vector<int> at(design.size(), 0);
  for (std::size_t i = 0; i < design.size();) {
    Point x;
    for (std::size_t j = 0; j < design.size(); ++j)
      x.push_back(at[j] == along - 1 ? design[j].high : design[j].low + (design[j].high - design[j].low) * at[j] / (along - 1));
    if (const auto error = designs.standard_error(x)) found.push_back({std::move(x), *error});
    for (i = 0; i < design.size() && ++at[i] == along; ++i) at[i] = 0;
  }
  std::stable_sort(found.begin(), found.end(), [](const GridPoint& a, const GridPoint& b) { return a.error < b.error; });
  return found;
}

/// The data of the callback that GSL, a C library, calls. An exception may not pass through C: it waits here.
struct Search {
  Designs* designs;
  const std::vector<DesignInput>* design;
  std::exception_ptr thrown;

  Point point(const gsl_vector* angles) const {
    Point x;
    for (std::size_t i = 0; i < design->size(); ++i) {
      const DesignInput& input = (*design)[i];
      const double place = (1 + real::sin(gsl_vector_get(angles, i))) / 2;
      x.push_back(std::clamp(input.low + (input.high - input.low) * place, input.low, input.high));
    }
    return x;
  }
};

double log_of_error(const gsl_vector* angles, void* data) {
  auto& search = *static_cast<Search*>(data);
  if (search.thrown) return kNoDesign;
  try {
    const auto error = search.designs->standard_error(search.point(angles));
    return error && *error > 0 ? real::log(*error) : kNoDesign;
  } catch (...) {
    search.thrown = std::current_exception();
    return kNoDesign;
  }
}

struct FreeVector {
  void operator()(gsl_vector* vector) const { gsl_vector_free(vector); }
};

void simplex_search(Designs& designs, const std::vector<DesignInput>& design, const Point& start) {
  const ReturnedGslErrors returned;
  const std::size_t n = design.size();
  Search search{&designs, &design, nullptr};
  const std::unique_ptr<gsl_vector, FreeVector> angles(allocated(gsl_vector_alloc(n))), steps(allocated(gsl_vector_alloc(n)));
  for (std::size_t i = 0; i < n; ++i) {
    const double place = 2 * (start[i] - design[i].low) / (design[i].high - design[i].low) - 1;
    gsl_vector_set(angles.get(), i, real::asin(std::clamp(place, -1.0, 1.0)));
    // From a limit inwards.
    gsl_vector_set(steps.get(), i, place > 0 ? -kFirstStep : kFirstStep);
  }
  const std::unique_ptr<gsl_multimin_fminimizer, void (*)(gsl_multimin_fminimizer*)> minimizer(
      allocated(gsl_multimin_fminimizer_alloc(gsl_multimin_fminimizer_nmsimplex2, n)), gsl_multimin_fminimizer_free);
  gsl_multimin_function function{log_of_error, n, &search};
  int status = gsl_multimin_fminimizer_set(minimizer.get(), &function, angles.get(), steps.get());
  for (int i = 0; status == GSL_SUCCESS && i < kMostIterations; ++i) {
    if (search.thrown) std::rethrow_exception(search.thrown);
    status = gsl_multimin_fminimizer_iterate(minimizer.get());
    if (gsl_multimin_fminimizer_size(minimizer.get()) < kSmallSimplex) break;
  }
  if (search.thrown) std::rethrow_exception(search.thrown);
}

/// Takes numbers that are near a limit to the limit, if that is hardly worse.
void try_limits(Designs& designs, const std::vector<DesignInput>& design) {
  for (std::size_t i = 0; i < design.size(); ++i) {
    const double range = design[i].high - design[i].low;
    Point x = designs.best()->x;
    const double before = x[i];
    if (x[i] - design[i].low < kNearLimit * range) x[i] = design[i].low;
    if (design[i].high - x[i] < kNearLimit * range) x[i] = design[i].high;
    if (x[i] != before) designs.prefer(x);
  }
}

double given_value(const ScenarioSource& source, const Overrides& overrides, const std::string& pointer) {
  const scenario::Document document(source, overrides);
  if (const auto given = measure::number_in(document.root(), pointer)) return *given;
  const scenario::Document complete({"", canonical_json(parse_scene(source, overrides).scenario())});
  return measure::number_in(complete.root(), pointer).value_or(NAN);
}

}  // namespace

void require_design(const ScenarioSource& source, const Overrides& overrides, const std::vector<DesignInput>& design) {
  if (design.size() > kMostDesignInputs)
    refuse_design(design[kMostDesignInputs].pointer,
                  fmt::format("at most {} numbers can be chosen at once", kMostDesignInputs));
  const scenario::Document document(source, overrides);
  for (auto input = design.begin(); input != design.end(); ++input) {
    if (std::any_of(design.begin(), input, [&](const DesignInput& other) { return other.pointer == input->pointer; }))
      refuse_design(input->pointer, "is given twice");
    if (input->pointer != kDuration && !measure::is_estimable(input->pointer))
      refuse_design(input->pointer,
                    "is not a number that can be chosen; give a number of site, earth, body, release, contact, platform, "
                    "travel or effects, "
                    "or /motion/duration_s, e.g. /release/tilt_deg=5:60");
    if (!std::isfinite(given_value(source, overrides, input->pointer)))
      refuse_design(input->pointer, "is not in the scenario; add it there, with any value");
    for (const double limit : {input->low, input->high}) {
      const ScenarioReport report = examine(document, {{input->pointer, limit}});
      for (const Diagnostic& error : report.errors)
        if (error.pointer == input->pointer)
          refuse_design(input->pointer, fmt::format("a limit is not possible: {}", error.message));
    }
  }
}

double expected_designs(std::size_t numbers) {
  if (numbers == 0) return 0;
  double designs = 1;
  for (std::size_t i = 0; i < numbers; ++i) designs *= kGridPoints[numbers - 1];
  return designs + static_cast<double>(kStarts * numbers) * 15;
}

std::optional<PlanOptimum> best_design(const ScenarioSource& source, const Overrides& overrides, const MeasurementPlan& plan,
                                       const Numbers& numbers, const std::vector<DesignInput>& design, const Watch& watch,
                                       std::int64_t& predictions) {
  Designs designs(source, overrides, plan, numbers, design, watch, predictions);
  try {
    const std::vector<GridPoint> grid = grid_search(designs, design);
    for (std::size_t i = 0; i < std::min(kStarts, grid.size()); ++i) simplex_search(designs, design, grid[i].x);
    if (designs.best()) try_limits(designs, design);
  } catch (const Designs::Stopped&) {
    return std::nullopt;
  }
  if (!designs.best()) return std::nullopt;
  const Designs::Best& best = *designs.best();
  PlanOptimum optimum;
  for (std::size_t i = 0; i < design.size(); ++i) {
    const double range = design[i].high - design[i].low;
    const double to_limit = std::min(best.x[i] - design[i].low, design[i].high - best.x[i]);
    optimum.choices.push_back(
        {design[i], given_value(source, overrides, design[i].pointer), best.x[i], to_limit <= kAtLimit * range});
  }
  optimum.standard_error = best.error;
  optimum.significance = std::abs(best.value) / best.error;
  optimum.rows = best.rows;
  optimum.evaluations = designs.evaluations();
  optimum.avoided = designs.avoided();
  return optimum;
}

}  // namespace plan

DesignInput design_input(const std::string& text) {
  DesignInput input;
  const std::size_t equals = text.find('='), colon = text.find(':', equals == std::string::npos ? 0 : equals);
  const auto number = [&](std::size_t from, std::size_t to, double& value) {
    const char* const end = text.data() + to;
    const auto [last, error] = std::from_chars(text.data() + from, end, value);
    return error == std::errc() && last == end && std::isfinite(value);
  };
  const bool is_whole = equals != std::string::npos && colon != std::string::npos && number(equals + 1, colon, input.low) &&
                        number(colon + 1, text.size(), input.high);
  if (!is_whole)
    throw ScenarioError("", fmt::format("--optimise {}: is not KEY=LOW:HIGH, e.g. tilt_deg=5:60", input::excerpt(text, 80)));
  input.pointer = scenario_pointer(text.substr(0, equals));
  if (!(input.low < input.high)) plan::refuse_design(input.pointer, "the first limit must be below the second one");
  return input;
}

}  // namespace earthtop
