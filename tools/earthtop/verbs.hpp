// SPDX-License-Identifier: GPL-3.0-or-later
/// The verbs, one file each: a verb says what can be said of it on the command line, and what is done when it is given.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace earthtop::tool {

struct Verb;

Verb describe_run();
Verb describe_explain();
Verb describe_check();
Verb describe_verify();
Verb describe_bench();
Verb describe_study();
Verb describe_compare();
Verb describe_report();
Verb describe_schema();
Verb describe_example();
/// @param program  all verbs, which outlive this one
Verb describe_completion(const Verb& program);
/// @param program  as of `describe_completion`   @param names  of all verbs
Verb describe_man(const Verb& program, const std::vector<std::string>& names);
Verb describe_version();

/// Prints what was built, from what and how. @throws WriteError
int version_verb(bool json);

/// `--set /json/pointer=VALUE`, any number of times.
void add_set_option(Verb& verb, std::vector<std::string>& sets);

/// Pairs of pointer and value. @throws ScenarioError naming every one that has another form
std::vector<std::pair<std::string, std::string>> split_sets(const std::vector<std::string>& sets);

}  // namespace earthtop::tool
