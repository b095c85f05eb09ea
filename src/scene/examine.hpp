// SPDX-License-Identifier: GPL-3.0-or-later
/// Examines a scenario whose text has been read already, for callers that change its values many times.
#pragma once

#include <optional>
#include <vector>

#include "earthtop/scene/scene.hpp"
#include "scenario/document.hpp"

namespace earthtop {

/// Decodes and validates the document's scenario with some values changed. The messages are the same as those of
/// `examine_scenario` with these values as overrides.
ScenarioReport examine(const scenario::Document& document, const std::vector<input::TreeChange>& changes = {});

/// The scene of the document with some values changed, for callers that ask for nothing but whether there is one: no warnings, and no
/// estimate of its cost. None where a value is refused.
std::optional<Scene> varied_scene(const scenario::Document& document, const std::vector<input::TreeChange>& changes);

}  // namespace earthtop
