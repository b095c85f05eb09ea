// SPDX-License-Identifier: GPL-3.0-or-later
/// The manual's pages, in roff with the macros of man(7), from the same tables as --help.
#pragma once

#include <string>
#include <string_view>

namespace earthtop::tool {

struct Verb;

/// Section 1's page of a verb: "earthtop-run". Of the program itself: "earthtop", with a list of the verbs.
/// @param version  of the program
std::string manual_page(const Verb& program, const Verb& verb, std::string_view version);

/// The page's name, without the section: "earthtop-run".
std::string manual_page_name(const Verb& program, const Verb& verb);

}  // namespace earthtop::tool
