// SPDX-License-Identifier: GPL-3.0-or-later
#include "scene/support_laws.hpp"

#include <array>

#include "earthtop/model/contact_release.hpp"
#include "earthtop/model/release.hpp"
#include "earthtop/scenario/support.hpp"

namespace earthtop {
namespace {

using Fault = std::optional<std::string>;

constexpr SupportLaws kOnTable{.check = on_table::check,
                               .warn = on_table::warn,
                               .fit_units = on_table::fit_units,
                               .fastest_rate = on_table::fastest_rate,
                               .paced = on_table::paced,
                               .add_figures = on_table::add_figures,
                               .form = on_table::form,
                               .choose_method = on_table::choose_method,
                               .second_options = on_table::second_options,
                               .take_series_form = [](const Scene&, IntegrationOptions&) {},
                               .refuse_general = on_table::refuse_general,
                               // Its equations weigh force and torque in every formulation.
                               .refuse_smooth = [](const MethodRow&, const Scene&) { return Fault(); },
                               .evaluation_seconds = on_table::evaluation_seconds,
                               .growth_work = [](const Scene&) { return Work(); },
                               .too_stiff = on_table::too_stiff};

constexpr SupportLaws on_pivot_with(void (*check)(const input::Section&, const Scene&)) {
  return {.check = check,
          .warn = [](const input::Section&, const Scene&) {},
          .fit_units = [](const Scene&, NaturalUnits&) {},
          .fastest_rate = on_pivot::fastest_rate,
          .paced = on_pivot::paced,
          .add_figures = on_pivot::add_figures,
          .form = on_pivot::form,
          .choose_method = on_pivot::choose_method,
          .second_options = on_pivot::second_options,
          .take_series_form = on_pivot::take_series_form,
          .refuse_general = [](const MethodRow&, const Scene&) { return Fault(); },
          .refuse_smooth = on_pivot::refuse_smooth,
          .evaluation_seconds = on_pivot::evaluation_seconds,
          .growth_work = on_pivot::growth_work,
          .too_stiff = on_pivot::too_stiff};
}

/// In the order of SupportKind.
constexpr std::array kLaws = {kOnTable, on_pivot_with(on_pivot::check_platform), on_pivot_with(on_pivot::check_gimbal),
                              on_pivot_with([](const input::Section&, const Scene&) {})};
static_assert(kLaws.size() == kSupportCount);

template <class T>
constexpr SupportLawsIn<T> kOnTableIn{
    [](const Scene& scene) {
      return make_release_on_table(scene.scenario().release, scene.table<T>().contact, scene.body<T>(), scene.site());
    },
    [](const Scene& scene, DriftProblem<T>& problem) {
      TableProblem<T>& table = problem.table.emplace(scene.table<T>());
      table.contact = in_units(table.contact, problem.units), table.start = in_units(table.start, problem.units);
    }};

template <class T>
constexpr SupportLawsIn<T> kOnPivotIn{
    [](const Scene& scene) { return make_release<T>(scene.scenario().release, scene.body<T>(), T(scene.site().gravity_m_s2)); },
    [](const Scene&, DriftProblem<T>&) {}};

/// In the order of SupportKind.
template <class T>
constexpr std::array kLawsIn = {kOnTableIn<T>, kOnPivotIn<T>, kOnPivotIn<T>, kOnPivotIn<T>};
static_assert(kLawsIn<double>.size() == kSupportCount);

}  // namespace

const SupportLaws& laws_of(const Scene& scene) { return kLaws[static_cast<std::size_t>(scene.support().kind)]; }

template <class T>
const SupportLawsIn<T>& laws_in(const Scene& scene) {
  return kLawsIn<T>[static_cast<std::size_t>(scene.support().kind)];
}
template const SupportLawsIn<double>& laws_in(const Scene&);
template const SupportLawsIn<long double>& laws_in(const Scene&);
template const SupportLawsIn<float128>& laws_in(const Scene&);

}  // namespace earthtop
