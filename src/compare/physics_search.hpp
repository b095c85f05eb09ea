// SPDX-License-Identifier: GPL-3.0-or-later
/// Looks for the change of a scenario with which its motion is that of a file.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "compare/explanation.hpp"
#include "compare/mistakes.hpp"
#include "earthtop/scene/scene.hpp"
#include "earthtop/watch.hpp"

namespace earthtop::compare {

/// A mistake that is known by name: the sentence on it, and the differences that it leaves.
struct NamedMistake {
  std::vector<std::string> sentences;  ///< none, or one
  double ratio = HUGE_VAL;
};

class PhysicsSearch {
 public:
  /// @param now  the differences as they are, in parts of what another program may differ by
  PhysicsSearch(const Explainer& explainer, const Scene& scene, double now, const Watch& watch)
      : explainer_(explainer), evidence_(explainer.evidence()), scene_(scene), now_(now), watch_(watch) {}

  /// Whether the scene's own motion is that of the reference, so that others can be told from it, and is found in a moment.
  bool predicts_reference() const;
  /// The mistake of the table with which the scenario's motion is that of the file, read in this way.
  NamedMistake by_name(const Reading& reading);
  /// A mistake of the table in a file that may be read in these ways; else another release; else another number. One sentence, or none.
  std::vector<std::string> further(const std::vector<Reading>& readings);
  /// Returns the mistake that came nearest of all, if it leaves little of what there was, though more than another program may differ by.
  const NamedMistake& nearest() const { return nearest_; }

 private:
  /// A scenario that is released as the file's first row says.
  struct Release {
    Scenario scenario;
    std::string words;  ///< what differs there
    int differences = 0;
    Reading reading;
  };
  struct Fit {
    double value = 0, sure = 0;  ///< and the change of it that would be seen
    Explanation explanation;
  };

  bool explains(const Explanation& one, double part_of_now) const;
  void note_nearest(const Explanation& one, double part_of_what_was, const std::string& sentence);
  std::optional<Tops> predicted(const Scenario& scenario) const;
  double predicted_until_s() const;
  NamedMistake mistaken(const Scenario& base, const Reading& reading, const std::string& before);
  std::vector<std::string> fitted(const Scenario& base, const Reading& reading, const std::string& before);
  std::optional<Fit> fit(const Scenario& base, const Suspect& suspect, double from, const Reading& reading) const;
  Eigen::VectorXd residuals(const Tops& read, const Tops& expected, std::size_t end) const;
  std::optional<Release> as_released(const Reading& reading) const;

  const Explainer& explainer_;
  const Evidence& evidence_;
  const Scene& scene_;
  double now_;
  const Watch& watch_;
  NamedMistake nearest_;
};

}  // namespace earthtop::compare
