// SPDX-License-Identifier: GPL-3.0-or-later
// The standard contenders of a scenario.
#include <algorithm>

#include "bench/table_equations.hpp"
#include "earthtop/bench/bench.hpp"

namespace earthtop {
namespace {

std::vector<Equations> equations_of(const MethodRow& row, const Scene& scene) {
  if (scene.support().has_contact) return equations_on_table(scene);
  constexpr Equations kReduced{Observer::laboratory, ModelForm::reduced}, kBody{Observer::body, ModelForm::general};
  constexpr Equations kLaboratory{Observer::laboratory, ModelForm::general}, kOwn{Observer::laboratory, ModelForm::automatic};
  switch (row.equations) {
    case MethodEquations::own: return {kOwn};
    case MethodEquations::reduced: return {kReduced};
    case MethodEquations::body: return {kBody};
    case MethodEquations::reduced_and_body: break;
    case MethodEquations::reduced_body_and_laboratory: return {kReduced, kBody, kLaboratory};
  }
  return {kReduced, kBody};
}

/// The tolerances to be tried, from coarse to as fine as the scalar type allows.
std::vector<double> tolerances(const MethodRow& row, Precision precision) {
  if (is_exact(row.method)) return {default_tolerance(precision)};  // it uses no tolerance
  switch (precision) {
    case Precision::bits53: break;
    case Precision::bits64: return {1e-14, 1e-17};
    case Precision::bits113: return {1e-20, 1e-26};
  }
  const auto& all = row.bench_tolerances;
  return {all.begin(), std::find(all.begin(), all.end(), 0.0)};
}

class Contenders {
 public:
  Contenders(const Scene& scene, Workload workload)
      : scene_(scene),
        as_asked_(without_numerics(scene)),
        workload_(workload),
        is_on_table_(scene.support().has_contact),
        reducible_(is_on_table_ || scene.is_reducible()) {
    if (workload == Workload::axis && scene.symmetry_axis() != 2) reducible_ = false;
  }

  std::vector<Contender> all() {
    for (const Method method : methods_by(&MethodRow::place_in_bench)) {
      const MethodRow& row = row_of(method);
      if (method == Method::automatic || as_asked_.method_refusal(method)) continue;
      if (row.relative_tolerance == Need::none && !is_exact(method))
        add_fixed_steps(row);
      else
        add(row);
    }
    add_peers();
    mark_automatic();
    return std::move(contenders_);
  }

 private:
  void add(const MethodRow& row) {
    std::vector<Composition> compositions = {Composition::automatic};
    if (row.composes)
      compositions.insert(compositions.end(), {Composition::aba864, Composition::aba1064, Composition::kahan_li8});
    std::vector<Precision> precisions;
    for (const Precision precision : {Precision::bits53, Precision::bits64, Precision::bits113})
      if (is_built(row.method, precision) && !in_precision(precision).method_refusal(row.method))
        precisions.push_back(precision);
    for (const Composition composition : compositions)
      for (const Equations& equations : equations_of(row, scene_)) {
        if (equations.form == ModelForm::reduced && !reducible_) continue;
        for (const Precision precision : precisions) {
          if (precision != Precision::bits53 && is_extra(equations)) continue;
          for (const double tolerance : tolerances(row, precision)) {
            IntegrationOptions options = options_of(row, equations);
            options.composition = composition;
            options.relative_tolerance = tolerance;
            contenders_.push_back({workload_, options, precision});
          }
        }
      }
  }

  /// A method whose step has to be given takes some hundredths of a radian of the fastest motion.
  void add_fixed_steps(const MethodRow& row) {
    for (const Equations& equations : equations_of(row, scene_))
      for (const double radians : {0.1, 0.05, 0.02}) {
        IntegrationOptions options = options_of(row, equations);
        options.step_s = radians / scene_.fastest_rate_rad_s();
        contenders_.push_back({workload_, options, Precision::bits53});
      }
  }

  /// Equations that are tried in double precision alone.
  bool is_extra(const Equations& equations) const {
    if (is_on_table_) return equations.observer != Observer::laboratory;
    return equations.observer == Observer::laboratory && equations.form == ModelForm::general;
  }

  static IntegrationOptions options_of(const MethodRow& row, const Equations& equations) {
    IntegrationOptions options;
    options.method = row.method;
    options.observer = equations.observer;
    options.form = equations.form;
    return options;
  }

  void add_peers() {
    if (!scene_.is_plain()) return;
    for (const Peer& peer : peers_built())
      for (const double tolerance : {1e-5, 1e-8, 1e-11, 1e-13}) {
        IntegrationOptions options;
        options.observer = Observer::body;
        options.form = ModelForm::general;
        options.relative_tolerance = tolerance;
        contenders_.push_back({workload_, options, Precision::bits53, &peer});
      }
  }

  /// The scene without the numerics, which would decide whether a method fits.
  static Scene without_numerics(const Scene& scene) {
    Scenario scenario = scene.scenario();
    scenario.numerics = {};
    return resolve(std::move(scenario));
  }
  Scene in_precision(Precision precision) const {
    Scenario scenario = as_asked_.scenario();
    scenario.precision = precision;
    return resolve(std::move(scenario));
  }

  void mark_automatic() {
    Scenario scenario = scene_.scenario();
    scenario.numerics.method = Method::automatic;
    scenario.numerics.step_s.reset();
    const Scene scene = resolve(std::move(scenario));
    Contender automatic{workload_, scene.choice().options, scene.scenario().precision};
    IntegrationOptions& options = automatic.options;
    const bool own = row_of(options.method).equations == MethodEquations::own;
    if (own)
      options.form = ModelForm::automatic;
    else
      options.form = scene.form(options);
    automatic.is_auto = true;
    const auto is_same = [&](const Contender& other) {
      return !other.peer && other.precision == automatic.precision && other.options.method == options.method &&
             other.options.form == options.form && other.options.observer == options.observer &&
             other.options.composition == options.composition && other.options.step_s == options.step_s &&
             (is_exact(options.method) || other.options.relative_tolerance == options.relative_tolerance);
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
  bool is_on_table_, reducible_;
  std::vector<Contender> contenders_;
};

}  // namespace

std::vector<Contender> standard_contenders(const Scene& scene, Workload workload) { return Contenders(scene, workload).all(); }

}  // namespace earthtop
