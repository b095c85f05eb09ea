// SPDX-License-Identifier: GPL-3.0-or-later
// The standard contenders of a scenario.
#include <algorithm>

#include "earthtop/bench/bench.hpp"

namespace earthtop {
namespace {

/// A set of variables and their equations: the observer and the form.
struct Equations {
  Observer observer;
  ModelForm form;
};
constexpr Equations kReduced{Observer::laboratory, ModelForm::reduced};
constexpr Equations kBody{Observer::body, ModelForm::general};
constexpr Equations kLaboratory{Observer::laboratory, ModelForm::general};
constexpr Equations kOwn{Observer::laboratory, ModelForm::automatic};

/// The tolerances to be tried, from coarse to as fine as the scalar type allows. The error of a Taylor series is far below its
/// tolerance; the tolerance of the long-horizon method is the error itself.
std::vector<double> tolerances(Method method, Precision precision) {
  if (method == Method::closed_form) return {default_tolerance(precision)};  // it uses no tolerance
  switch (precision) {
    case Precision::bits53: break;
    case Precision::bits64: return {1e-14, 1e-17};
    case Precision::bits113: return {1e-20, 1e-26};
  }
  if (method == Method::taylor) return {1e-2, 1e-3, 1e-5, 1e-8, 1e-11, 1e-14};
  if (method == Method::long_horizon) return {1e-6, 1e-8, 1e-10, 1e-12};
  if (method == Method::dopri5) return {1e-5, 1e-8, 1e-10};
  return {1e-5, 1e-8, 1e-11, 1e-14};
}

class Contenders {
 public:
  Contenders(const Scene& scene, Workload workload)
      : scene_(scene), as_asked_(without_numerics(scene)), workload_(workload), reducible_(scene.is_reducible()) {
    if (workload == Workload::axis && scene.symmetry_axis() != 2) reducible_ = false;
  }

  std::vector<Contender> all() {
    add(Method::closed_form, {kOwn});
    add(Method::long_horizon, {kOwn});
    add(Method::taylor, {kReduced, kBody});
    if (reducible_)
      for (const Composition composition :
           {Composition::automatic, Composition::aba864, Composition::aba1064, Composition::kahan_li8})
        add(Method::splitting, {kReduced}, composition);
    for (const Method method : {Method::dop853, Method::rkf78}) add(method, {kReduced, kBody, kLaboratory});
    for (const Method method : {Method::gauss, Method::extrapolation, Method::bulirsch_stoer, Method::dopri5})
      add(method, {kReduced, kBody});
    add_adams();
    add_peers();
    mark_automatic();
    return std::move(contenders_);
  }

 private:
  void add(Method method, std::initializer_list<Equations> forms, Composition composition = Composition::automatic) {
    if (as_asked_.method_refusal(method)) return;
    for (const Equations& equations : forms) {
      if (equations.form == ModelForm::reduced && !reducible_) continue;
      for (const Precision precision : {Precision::bits53, Precision::bits64, Precision::bits113}) {
        if (!is_built(method, precision)) continue;
        if (precision != Precision::bits53 && equations.observer == Observer::laboratory &&
            equations.form == ModelForm::general)
          continue;
        for (const double tolerance : tolerances(method, precision)) {
          IntegrationOptions options;
          options.method = method;
          options.observer = equations.observer;
          options.form = equations.form;
          options.composition = composition;
          options.relative_tolerance = tolerance;
          contenders_.push_back({workload_, options, precision});
        }
      }
    }
  }

  /// Adams's method has a fixed step: some hundredths of a radian of the fastest motion.
  void add_adams() {
    for (const double radians : {0.1, 0.05, 0.02}) {
      IntegrationOptions options;
      options.method = Method::abm8;
      options.observer = Observer::body;
      options.form = ModelForm::general;
      options.step_s = radians / scene_.fastest_rate_rad_s();
      contenders_.push_back({workload_, options, Precision::bits53});
    }
  }

  void add_peers() {
    if (!scene_.is_plain()) return;
    for (const Peer peer : peers_built())
      for (const double tolerance : {1e-5, 1e-8, 1e-11, 1e-13}) {
        IntegrationOptions options;
        options.observer = Observer::body;
        options.form = ModelForm::general;
        options.relative_tolerance = tolerance;
        contenders_.push_back({workload_, options, Precision::bits53, peer});
      }
  }

  /// The scene without the numerics, which would decide whether a method fits.
  static Scene without_numerics(const Scene& scene) {
    Scenario scenario = scene.scenario();
    scenario.numerics = {};
    return resolve(std::move(scenario));
  }

  void mark_automatic() {
    Scenario scenario = scene_.scenario();
    scenario.numerics.method = Method::automatic;
    scenario.numerics.step_s.reset();
    const Scene scene = resolve(std::move(scenario));
    Contender automatic{workload_, scene.choice().options, scene.scenario().precision};
    IntegrationOptions& options = automatic.options;
    const bool own = options.method == Method::closed_form || options.method == Method::long_horizon;
    if (own)
      options.form = ModelForm::automatic;
    else
      options.form = scene.form(options);
    automatic.is_auto = true;
    const auto is_same = [&](const Contender& other) {
      return !other.peer && other.precision == automatic.precision && other.options.method == options.method &&
             other.options.form == options.form && other.options.observer == options.observer &&
             other.options.composition == options.composition && other.options.step_s == options.step_s &&
             (options.method == Method::closed_form || other.options.relative_tolerance == options.relative_tolerance);
    };
    const auto same = std::find_if(contenders_.begin(), contenders_.end(), is_same);
    if (same != contenders_.end())
      same->is_auto = true;
    else
      contenders_.insert(contenders_.begin(), automatic);
  }

  const Scene& scene_;
  Scene as_asked_;
  Workload workload_;
  bool reducible_;
  std::vector<Contender> contenders_;
};

}  // namespace

std::vector<Contender> standard_contenders(const Scene& scene, Workload workload) { return Contenders(scene, workload).all(); }

}  // namespace earthtop
