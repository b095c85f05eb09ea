// SPDX-License-Identifier: GPL-3.0-or-later
#include "earthtop/scene/scene.hpp"

#include <array>
#include <cmath>
#include <tuple>

#include "earthtop/model/gyrostat.hpp"
#include "earthtop/scenario/support.hpp"
#include "scene/once.hpp"
#include "scene/second_integration.hpp"
#include "scene/support_laws.hpp"
#include "scene/touchdown.hpp"
#include "text/sha256.hpp"

namespace earthtop {
namespace {

/// The parts of a scene that are kept separately for each precision.
template <class T>
struct InPrecision {
  Once<Body<T>> body;
  Once<Release<T>> release;
  Once<Model<T>> model;
  Once<TableProblem<T>> table;
  Once<DriftProblem<T>> problem, problem_without_rows;
};

}  // namespace

struct Scene::Parts {
  explicit Parts(Scenario given)
      : scenario(std::move(given)),
        site(resolved_site(scenario)),
        rotation_rate_rad_s(resolved_rotation_rate_rad_s(scenario)) {}
  template <class T>
  const InPrecision<T>& in() const {
    return std::get<InPrecision<T>>(precisions);
  }

  const Scenario scenario;
  const Site site;
  const double rotation_rate_rad_s;
  std::tuple<InPrecision<double>, InPrecision<float80>, InPrecision<float128>> precisions;
  Once<std::string> identity, sha256;
  Once<std::vector<Constant>> constants;
  Once<int> symmetry_axis;
  Once<Touchdown> touchdown;
  Once<TopFigures> top;
  Once<NaturalUnits> units;
  Once<PlatformDemand> platform_demand;
  Once<double> fastest_rate;
  Once<Paced> paced;
  Once<Pace> pace;
  Once<ExactKind> closed_form_kind;
  Once<FourierOutlook> fourier_outlook;
  std::array<Once<std::optional<std::string>>, kMethodCount> refusals;
  Once<MethodChoice> choice;
  Once<std::array<IntegrationCost, 2>> costs;
  Once<RunEstimate> estimate;
};

Scene::Scene() : Scene(Scenario()) {}
Scene::Scene(Scenario scenario) : parts_(std::make_shared<const Parts>(std::move(scenario))) {}

const Scenario& Scene::scenario() const { return parts_->scenario; }
const Site& Scene::site() const { return parts_->site; }
double Scene::rotation_rate_rad_s() const { return parts_->rotation_rate_rad_s; }
const std::string& Scene::identity() const {
  return parts_->identity.get([this] { return identity_json(scenario()); });
}
const std::string& Scene::sha256() const {
  return parts_->sha256.get([this] { return sha256_hex(identity()); });
}

const std::vector<Constant>& Scene::constants() const {
  return parts_->constants.get([this] { return constants_of(*this); });
}

const Support& Scene::support() const { return support_of(scenario()); }
bool Scene::is_plain() const { return support().is_fixed_pivot && scenario().effects.plain(); }
int Scene::symmetry_axis() const {
  return parts_->symmetry_axis.get(
      [this] { return support().has_moving_parts() ? -1 : earthtop::symmetry_axis(body<double>()); });
}
const TopFigures& Scene::top() const {
  return parts_->top.get([this] { return top_figures_of(*this); });
}
bool Scene::is_reducible_when_driven() const {
  const EffectsSpec& effects = scenario().effects;
  if (!effects.all_on() || support().has_moving_parts()) return false;
  if (effects.applied.gimbal && (symmetry_axis() != 2 || scenario().platform)) return false;
  return symmetry_axis() >= 0 && model<double>().applied.is_symmetric_about(symmetry_axis());
}
bool Scene::has_drift() const {
  const auto& travel = scenario().travel;
  return rotation_rate_rad_s() != 0 || (travel && travel->reference == TravelReference::at_rest);
}
bool Scene::is_one_motion() const {
  return rotation_rate_rad_s() == 0 || scenario().release.rates_relative_to == RatesRelativeTo::inertial;
}

Scene Scene::without_rotation() const {
  Scenario still = scenario();
  still.rotation_rate_rad_s = 0;
  return resolve(std::move(still));
}

template <class T>
const Body<T>& Scene::body() const {
  return parts_->in<T>().body.get([this] {
    Body<T> body = make_body<T>(scenario().body);
    if (const auto& rotor = scenario().rotor) body = gyrostat_body(body, *rotor, has_axial_moment(*this));
    return with_masses(body, scenario().moving_masses);
  });
}
template <class T>
const Release<T>& Scene::release() const {
  return parts_->in<T>().release.get([this] { return laws_in<T>(*this).release(*this); });
}
template <class T>
const TableProblem<T>& Scene::table() const {
  return parts_->in<T>().table.get([this] { return table_of(*this, body<T>()); });
}
template <class T>
const Model<T>& Scene::model() const {
  return parts_->in<T>().model.get([this] { return model_of<T>(*this); });
}
template <class T>
const DriftProblem<T>& Scene::problem() const {
  return parts_->in<T>().problem.get([this] {
    DriftProblem<T> problem = problem_without_rows<T>();
    problem.times_s = output_times(scenario().duration_s, scenario().output_step_s);
    return problem;
  });
}
template <class T>
const DriftProblem<T>& Scene::problem_without_rows() const {
  return parts_->in<T>().problem_without_rows.get([this] { return problem_of<T>(*this); });
}
#define EARTHTOP_SCENE(T)                                 \
  template const Body<T>& Scene::body() const;            \
  template const Release<T>& Scene::release() const;      \
  template const TableProblem<T>& Scene::table() const;   \
  template const Model<T>& Scene::model() const;          \
  template const DriftProblem<T>& Scene::problem() const; \
  template const DriftProblem<T>& Scene::problem_without_rows() const;
EARTHTOP_SCENE(double)
EARTHTOP_SCENE(float80)
EARTHTOP_SCENE(float128)

const Touchdown& Scene::touchdown() const {
  return parts_->touchdown.get([this] { return Touchdown(*this); });
}
const NaturalUnits& Scene::units() const {
  return parts_->units.get([this] { return units_of(*this); });
}

double Scene::gravity_torque_N_m(double pivot_acceleration_m_s2) const {
  const Body<double>& top = body<double>();
  // Gravity may be below 0 by the step of a difference quotient.
  return top.mass * (std::abs(site().gravity_m_s2) + pivot_acceleration_m_s2) * norm(top.p_PBcm_B);
}
double Scene::axial_gravity_torque_N_m() const {
  const Body<double>& top = body<double>();
  return top.mass * site().gravity_m_s2 * top.p_PBcm_B[2];
}
const PlatformDemand& Scene::platform_demand() const {
  return parts_->platform_demand.get([this] { return demand_of(*this); });
}
double Scene::fastest_rate_rad_s() const {
  return parts_->fastest_rate.get([this] { return laws_of(*this).fastest_rate(*this); });
}
const Pace& Scene::pace_by_rule() const {
  return parts_->paced.get([this] { return laws_of(*this).paced(*this); }).pace;
}
const Pace& Scene::pace() const {
  return may_be_driven(scenario()) ? parts_->pace.get([this] { return pace_as_seen(*this); }) : pace_by_rule();
}
const StiffFriction& Scene::stiffest_friction() const {
  return parts_->paced.get([this] { return laws_of(*this).paced(*this); }).stiffest;
}
ExactKind Scene::closed_form_kind() const {
  return parts_->closed_form_kind.get([this] { return closed_form_of(*this); });
}

const FourierOutlook& Scene::fourier_outlook() const {
  return parts_->fourier_outlook.get([this] { return fourier_outlook_of(*this); });
}

const std::optional<std::string>& Scene::method_refusal(Method method) const {
  return parts_->refusals[static_cast<std::size_t>(method)].get([&] { return refuse_method(method, *this); });
}
void Scene::require_integrable() const {
  if (auto reason = precision_refusal(scenario().precision)) throw ScenarioError("/numerics/precision", *std::move(reason));
  if (const auto& reason = method_refusal()) throw ScenarioError("/numerics/method", *reason);
}
const MethodChoice& Scene::choice() const {
  return parts_->choice.get([this] { return laws_of(*this).choose_method(*this); });
}
ModelForm Scene::form(const IntegrationOptions& options) const { return laws_of(*this).form(*this, options); }

IntegrationCost Scene::cost(const IntegrationOptions& options) const { return cost_of(*this, options); }
const std::array<IntegrationCost, 2>& Scene::costs() const {
  return parts_->costs.get([this] {
    const IntegrationOptions& first = choice().options;
    return std::array{cost(first), cost(second_options(*this, first))};
  });
}
const RunEstimate& Scene::estimate() const {
  return parts_->estimate.get([this] { return estimate_run(*this); });
}
void Scene::require_affordable() const { refuse_unaffordable(*this); }

}  // namespace earthtop
