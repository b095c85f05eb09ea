// Who runs: the standard contenders of a scenario, and their names.
#include <fmt/format.h>

#include "bench/exact_motion.hpp"
#include "earthtop/bench/bench.hpp"
#include "run/setup.hpp"

namespace earthtop {

std::string_view to_string(Workload workload) {
  switch (workload) {
    case Workload::axis: return "axis";
    case Workload::motion: return "motion";
    case Workload::drift: return "drift";
    case Workload::closed_form: return "closed_form";
  }
  return "unknown";
}

std::string describe(const Contender& contender) {
  const IntegrationOptions& options = contender.options;
  std::string text;
  if (contender.workload == Workload::closed_form)
    text = "closed form";
  else if (options.step_s)
    text = fmt::format("{} step {:g} s", to_string(options.method), *options.step_s);
  else
    text = fmt::format("{} {:.0e}", to_string(options.method), options.relative_tolerance);
  if (contender.workload != Workload::closed_form)
    text += fmt::format(", {}, {}", to_string(options.form), to_string(options.observer));
  if (contender.precision != Precision::bits53) text += fmt::format(", {}", to_string(contender.precision));
  return text;
}

std::vector<Contender> standard_contenders(const Scenario& scenario) {
  const auto model = make_model<double>(scenario);
  std::vector<IntegrationOptions> equations;
  const auto add_equations = [&](Observer observer, ModelForm form) {
    IntegrationOptions options;
    options.observer = observer;
    options.form = form;
    equations.push_back(options);
  };
  if (is_reducible(model)) add_equations(Observer::laboratory, ModelForm::reduced);
  for (const Observer observer : {Observer::laboratory, Observer::body, Observer::inertial})
    add_equations(observer, ModelForm::general);

  std::vector<Contender> contenders;
  for (const Workload workload : {Workload::axis, Workload::motion, Workload::drift})
    for (IntegrationOptions options : equations) {
      if (workload == Workload::axis &&
          (options.form != ModelForm::reduced || symmetry_axis(model.I_BP_B, model.mass_moment_B) != 2))
        continue;
      options.method = Method::taylor;
      const bool has_series = options.form == ModelForm::reduced || options.observer == Observer::body;
      if (has_series && !method_refusal(Method::taylor, scenario))
        for (const double tolerance : {1e-3, 1e-4, 1e-6, 1e-8, 1e-10, 1e-14}) {  // its errors are far below its tolerances
          options.relative_tolerance = tolerance;
          contenders.push_back({workload, options, Precision::bits53});
        }
      for (const Method method : {Method::rkf78, Method::bulirsch_stoer, Method::extrapolation, Method::dopri5, Method::dop853,
                                  Method::gauss, Method::splitting})
        for (const double tolerance : {1e-8, 1e-10, 1e-12, 1e-14}) {
          if (method == Method::splitting && options.form != ModelForm::reduced) continue;
          if (method == Method::dopri5 && tolerance < 1e-12) continue;  // of order 5: minutes
          options.method = method;
          options.relative_tolerance = tolerance;
          contenders.push_back({workload, options, Precision::bits53});
        }
    }
  if (!method_refusal(Method::long_horizon, scenario))
    for (const double tolerance : {1e-8, 1e-10, 1e-12}) {
      IntegrationOptions options;
      options.method = Method::long_horizon;
      options.relative_tolerance = tolerance;
      contenders.push_back({Workload::drift, options, Precision::bits53});
    }
  if (exact_laboratory_motion<double>(scenario)) contenders.push_back({Workload::closed_form, {}, Precision::bits53});
  return contenders;
}

}  // namespace earthtop
