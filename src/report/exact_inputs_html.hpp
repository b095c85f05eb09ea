// SPDX-License-Identifier: GPL-3.0-or-later
/// Shows the inputs on which a result rests, on the pages of comparisons and of plans.
#pragma once

#include <string>

#include "report/html.hpp"

namespace earthtop::report {

/// The name of an input in an entry of a document; with its release where there are several and it is not that of all.
std::string input_name(const Json& entry, const char* key = "name");

/// The same in words.
std::string input_words(const Json& entry, const char* key = "name");
/// The same with its name on demand; HTML.
std::string input_html(const Json& entry, const char* key = "name");

/// A table of the inputs that were taken as exact for an estimate of a document. Empty without any.
std::string exact_inputs_html(const Json& estimate);

}  // namespace earthtop::report
