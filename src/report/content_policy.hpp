// SPDX-License-Identifier: GPL-3.0-or-later
/// A page's content security policy: what is in the page may run, and nothing else.
#pragma once

#include <string>

namespace earthtop::report {

/// Stands in a page where its policy goes.
inline constexpr const char* kPolicyPlace = "earthtop-content-policy";

/// Replaces the place by a policy that allows just the style and script elements of the page, by their hashes.
void set_content_policy(std::string& html);

}  // namespace earthtop::report
