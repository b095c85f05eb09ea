// SPDX-License-Identifier: GPL-3.0-or-later
/// The content security policy of a page: only the scripts and styles that are in the page are allowed.
#pragma once

#include <string>

namespace earthtop::report {

/// Placeholder in a page where its policy is to be inserted.
inline constexpr const char* kPolicyPlace = "earthtop-content-policy";

/// Replaces the placeholder by a policy that allows exactly the style and script elements of the page, by their hashes.
void set_content_policy(std::string& html);

}  // namespace earthtop::report
