// SPDX-License-Identifier: GPL-3.0-or-later
/// The manual pages, in roff with the macros of man(7), made from the same tables as --help.
#pragma once

#include <string>
#include <string_view>

namespace earthtop::tool {

struct Verb;

/// The page of a verb in section 1: "earthtop-run". The page of the program itself, "earthtop", lists the verbs.
/// @param version of the program
std::string manual_page(const Verb& program, const Verb& verb, std::string_view version);

/// The name of the page, without the section: "earthtop-run".
std::string manual_page_name(const Verb& program, const Verb& verb);

}  // namespace earthtop::tool
