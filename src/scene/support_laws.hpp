// SPDX-License-Identifier: GPL-3.0-or-later
/// What a scene asks its support: the laws by which its parts are made, one row a kind of support. A support's laws are in a namespace
/// and in sources of its own; those of a platform and of a gimbal are a pivot's, with checks of their own.
#pragma once

#include <optional>
#include <string>

#include "earthtop/integrate/method.hpp"
#include "input/section.hpp"
#include "scene/parts.hpp"

namespace earthtop {

struct SupportLaws {
  /// Refuses what the support does not allow in the rest of a scenario, and warns of numbers of its own that look like mistakes.
  void (*check)(const input::Section& root, const Scene& scene);
  void (*warn)(const input::Section& root, const Scene& scene);

  /// Shortens the unit of time where the motion is faster than body, release and Earth alone tell.
  void (*fit_units)(const Scene& scene, NaturalUnits& units);
  double (*fastest_rate)(const Scene& scene);
  Paced (*paced)(const Scene& scene);
  void (*add_figures)(TopFigures& top, const Scene& scene, double cosine);

  ModelForm (*form)(const Scene& scene, const IntegrationOptions& options);
  MethodChoice (*choose_method)(const Scene& scene);
  /// @param second  the first one's, with the form that it takes and without a step
  IntegrationOptions (*second_options)(const Scene& scene, const IntegrationOptions& first, IntegrationOptions second);
  /// Sets observer and form to those in which series take the fewest operations.
  void (*take_series_form)(const Scene& scene, IntegrationOptions& series);
  /// Refuse methods that are built for any body on a pivot, and those that need a smooth motion.
  std::optional<std::string> (*refuse_general)(const MethodRow& row, const Scene& scene);
  std::optional<std::string> (*refuse_smooth)(const MethodRow& row, const Scene& scene);

  /// The time (s) of one evaluation in double.
  double (*evaluation_seconds)(const Scene& scene, const IntegrationOptions& options);
  /// The work of following the growth of disturbances along both motions, which a run's verdict needs.
  Work (*growth_work)(const Scene& scene);
  /// Says that friction is too stiff. @param work  in words
  std::string (*too_stiff)(const Scene& scene, const std::string& work);
};

/// The laws by which the parts are made that each precision has for itself.
template <class T>
struct SupportLawsIn {
  Release<T> (*release)(const Scene& scene);
  /// Adds to a problem what the support adds to the equations.
  void (*complete)(const Scene& scene, DriftProblem<T>& problem);
};

const SupportLaws& laws_of(const Scene& scene);
template <class T>
const SupportLawsIn<T>& laws_in(const Scene& scene);
extern template const SupportLawsIn<double>& laws_in(const Scene&);
extern template const SupportLawsIn<long double>& laws_in(const Scene&);
extern template const SupportLawsIn<float128>& laws_in(const Scene&);

/// The laws of a body on a pivot.
namespace on_pivot {
void check_platform(const input::Section& root, const Scene& scene);
void check_gimbal(const input::Section& root, const Scene& scene);
double fastest_rate(const Scene& scene);
Paced paced(const Scene& scene);
void add_figures(TopFigures& top, const Scene& scene, double cosine);
ModelForm form(const Scene& scene, const IntegrationOptions& options);
MethodChoice choose_method(const Scene& scene);
IntegrationOptions second_options(const Scene& scene, const IntegrationOptions& first, IntegrationOptions second);
void take_series_form(const Scene& scene, IntegrationOptions& series);
std::optional<std::string> refuse_smooth(const MethodRow& row, const Scene& scene);
double evaluation_seconds(const Scene& scene, const IntegrationOptions& options);
Work growth_work(const Scene& scene);
std::string too_stiff(const Scene& scene, const std::string& work);
}  // namespace on_pivot

/// The laws of a top on a table.
namespace on_table {
void check(const input::Section& root, const Scene& scene);
void warn(const input::Section& root, const Scene& scene);
void fit_units(const Scene& scene, NaturalUnits& units);
double fastest_rate(const Scene& scene);
Paced paced(const Scene& scene);
void add_figures(TopFigures& top, const Scene& scene, double cosine);
ModelForm form(const Scene& scene, const IntegrationOptions& options);
MethodChoice choose_method(const Scene& scene);
IntegrationOptions second_options(const Scene& scene, const IntegrationOptions& first, IntegrationOptions second);
std::optional<std::string> refuse_general(const MethodRow& row, const Scene& scene);
double evaluation_seconds(const Scene& scene, const IntegrationOptions& options);
std::string too_stiff(const Scene& scene, const std::string& work);
/// Makes Scene::table.
template <class T>
TableProblem<T> make_table(const Scene& scene);
extern template TableProblem<double> make_table(const Scene&);
extern template TableProblem<long double> make_table(const Scene&);
extern template TableProblem<float128> make_table(const Scene&);
}  // namespace on_table

}  // namespace earthtop
