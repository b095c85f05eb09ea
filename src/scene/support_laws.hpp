// SPDX-License-Identifier: GPL-3.0-or-later
/// What a scene asks its support: the laws by which its parts are made. Those of a body on a pivot hold for every support that does not
/// have its own.
#pragma once

#include <optional>
#include <string>

#include "earthtop/integrate/method.hpp"
#include "input/section.hpp"
#include "scene/parts.hpp"

namespace earthtop {

class PivotLaws {
 public:
  virtual ~PivotLaws() = default;

  /// Refuses what the support does not allow in the rest of a scenario, and warns of numbers of its own that look like mistakes.
  virtual void check(const input::Section& root, const Scene& scene) const;
  virtual void warn(const input::Section&, const Scene&) const {}

  /// Shortens the unit of time where the motion is faster than body, release and Earth alone tell.
  virtual void fit_units(const Scene&, NaturalUnits&) const {}
  virtual double fastest_rate(const Scene& scene) const;
  virtual Paced paced(const Scene& scene) const;
  /// @param cosine  of the tilt
  virtual void add_figures(TopFigures& top, const Scene& scene, double cosine) const;

  virtual ModelForm form(const Scene& scene, const IntegrationOptions& options) const;
  virtual MethodChoice choose_method(const Scene& scene) const;
  /// @param second  the first one's, with the form that it takes and without a step
  virtual IntegrationOptions second_options(const Scene& scene, const IntegrationOptions& first,
                                            IntegrationOptions second) const;
  /// Sets observer and form to those in which series take the fewest operations.
  virtual void take_series_form(const Scene& scene, IntegrationOptions& series) const;
  /// Says why a method for any body, or for any smooth motion, is not available; empty if it is.
  virtual std::optional<std::string> refuse(const MethodRow& row, const Scene& scene) const;

  /// The time (s) of one evaluation in double.
  virtual double evaluation_seconds(const Scene& scene, const IntegrationOptions& options) const;
  /// The work of following the growth of disturbances along both motions, which a run's verdict needs.
  virtual Work growth_work(const Scene& scene) const;
  /// Says that friction is too stiff. @param work  in words
  virtual std::string too_stiff(const Scene& scene, const std::string& work) const;
};

struct RotorLaws : PivotLaws {
  void check(const input::Section& root, const Scene& scene) const override;
  void fit_units(const Scene& scene, NaturalUnits& units) const override;
  ModelForm form(const Scene&, const IntegrationOptions&) const override { return ModelForm::general; }
  MethodChoice choose_method(const Scene& scene) const override;
  void add_figures(TopFigures& top, const Scene&, double) const override;
  std::optional<std::string> refuse(const MethodRow& row, const Scene& scene) const override;
};

struct SuspensionLaws final : PivotLaws {
  void check(const input::Section& root, const Scene& scene) const override;
  void fit_units(const Scene& scene, NaturalUnits& units) const override;
  double fastest_rate(const Scene& scene) const override;
  Paced paced(const Scene& scene) const override;
  ModelForm form(const Scene&, const IntegrationOptions&) const override { return ModelForm::general; }
  MethodChoice choose_method(const Scene& scene) const override;
  IntegrationOptions second_options(const Scene& scene, const IntegrationOptions& first,
                                    IntegrationOptions second) const override;
  void take_series_form(const Scene&, IntegrationOptions& series) const override { series.observer = Observer::inertial; }
  void add_figures(TopFigures& top, const Scene& scene, double cosine) const override;
  std::optional<std::string> refuse(const MethodRow& row, const Scene& scene) const override;
};

/// Masses that move in a body, with a rotor or without one.
struct MassLaws final : RotorLaws {
  double fastest_rate(const Scene& scene) const override;
  Paced paced(const Scene& scene) const override;
  void add_figures(TopFigures& top, const Scene&, double) const override;
  double evaluation_seconds(const Scene& scene, const IntegrationOptions& options) const override;
};

struct PlatformLaws final : PivotLaws {
  void check(const input::Section& root, const Scene& scene) const override;
};

struct GimbalLaws final : PivotLaws {
  void check(const input::Section& root, const Scene& scene) const override;
};

struct TableLaws final : PivotLaws {
  void check(const input::Section& root, const Scene& scene) const override;
  void warn(const input::Section& root, const Scene& scene) const override;
  void fit_units(const Scene& scene, NaturalUnits& units) const override;
  double fastest_rate(const Scene& scene) const override;
  Paced paced(const Scene& scene) const override;
  void add_figures(TopFigures& top, const Scene& scene, double cosine) const override;
  ModelForm form(const Scene& scene, const IntegrationOptions& options) const override;
  MethodChoice choose_method(const Scene& scene) const override;
  IntegrationOptions second_options(const Scene&, const IntegrationOptions& first, IntegrationOptions second) const override;
  void take_series_form(const Scene&, IntegrationOptions&) const override {}
  std::optional<std::string> refuse(const MethodRow& row, const Scene& scene) const override;
  double evaluation_seconds(const Scene& scene, const IntegrationOptions& options) const override;
  Work growth_work(const Scene&) const override { return {}; }
  std::string too_stiff(const Scene& scene, const std::string& work) const override;
};

const PivotLaws& laws_of(const Scene& scene);

/// Returns whether a closed form is cheap. It is if the two motions differ only by a turn of the laboratory; otherwise their
/// difference has to be evaluated in 113 bits.
bool has_cheap_closed_form(const Scene& scene);

/// The laws by which the parts are made that each precision has for itself.
template <class T>
struct LawsIn {
  Release<T> (*release)(const Scene& scene);
  /// Adds to a problem what the support adds to the equations.
  void (*complete)(const Scene& scene, DriftProblem<T>& problem);
};
template <class T>
const LawsIn<T>& laws_in(const Scene& scene);

/// Makes the table of a scene that has one, in SI units.   @param body  that of the scene, or one beside it
template <class T>
TableProblem<T> table_of(const Scene& scene, const Body<T>& body);
/// Takes it to natural units.
template <class T>
TableProblem<T> in_units(TableProblem<T> table, const NaturalUnits& units) {
  table.contact = in_units(table.contact, units), table.start = in_units(table.start, units);
  return table;
}

}  // namespace earthtop
