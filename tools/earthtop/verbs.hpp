// SPDX-License-Identifier: GPL-3.0-or-later
/// The verbs, one source file each. A verb describes its part of the command line and does its work.
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
Verb describe_plan();
Verb describe_report();
Verb describe_gallery();
Verb describe_schema();
Verb describe_example();
/// @param program will have all verbs; must outlive the returned verb   @param names names of all verbs
Verb describe_help(const Verb& program, const std::vector<std::string>& names);
Verb describe_man(const Verb& program, const std::vector<std::string>& names);
Verb describe_completion(const Verb& program);
Verb describe_version();

/// Prints the version, the commit it was built from, and how it was built. @throws WriteError
int version_verb(bool json);

/// `--set /json/pointer=VALUE`, any number of times.
void add_set_option(Verb& verb, std::vector<std::string>& sets);

/// Splits each argument into pointer and value. @throws ScenarioError naming every argument of another form
std::vector<std::pair<std::string, std::string>> split_sets(const std::vector<std::string>& sets);

}  // namespace earthtop::tool
