// SPDX-License-Identifier: GPL-3.0-or-later
/// The texts that `earthtop explain` prints of tops on a table and of bodies with a rotor.
#pragma once

#include <string>

#include "earthtop/run/contact_explanation.hpp"

namespace earthtop::tool {

/// The sizes of all forces and torques, the expected drift, and how well the inputs must be known. What a scene does not have is not
/// mentioned.
std::string contact_explanation_text(const ContactExplanation& explained, const Scene& scene, std::size_t width);

/// Which equations are integrated for a body with a rotor; empty for any other.
std::string rotor_equations_text(const Scene& scene, std::size_t width);

}  // namespace earthtop::tool
