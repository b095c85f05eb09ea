// SPDX-License-Identifier: GPL-3.0-or-later
/// Examines a scenario whose text has been read already, for callers that change its values many times.
#pragma once

#include <vector>

#include "earthtop/scene/scene.hpp"
#include "scenario/document.hpp"

namespace earthtop {

/// Decodes and validates the document's scenario with some values changed. The messages are the same as those of
/// `examine_scenario` with these values as overrides.
ScenarioReport examine(const scenario::Document& document, const std::vector<input::TreeChange>& changes = {});

}  // namespace earthtop
