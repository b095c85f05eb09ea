// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>

#include "command_line.hpp"
#include "earthtop/results/provenance.hpp"
#include "earthtop/results/results.hpp"
#include "exit_status.hpp"
#include "manual_page.hpp"
#include "output.hpp"
#include "verbs.hpp"

namespace earthtop::tool {
namespace {

struct ManArguments {
  std::optional<std::string> verb;
  std::optional<std::string> all;  // a directory
};

int man_verb(const Verb& program, const ManArguments& arguments) {
  const auto& verbs = program.verbs;
  const std::string& version = build_info().version;
  if (arguments.all) {
    const auto write = [&](const Verb& verb) {
      write_file(std::filesystem::path(*arguments.all) / (manual_page_name(program, verb) + ".1"),
                 manual_page(program, verb, version));
    };
    write(program);
    std::for_each(verbs.begin(), verbs.end(), write);
    return kDone;
  }
  const auto named = std::find_if(verbs.begin(), verbs.end(), [&](const Verb& verb) { return verb.name == arguments.verb; });
  print(manual_page(program, named != verbs.end() ? *named : program, version));
  return kDone;
}

}  // namespace

Verb describe_man(const Verb& program, const std::vector<std::string>& names) {
  auto arguments = std::make_shared<ManArguments>();
  Verb man("man", "print the manual: the page of the program or of a verb",
           [&program, arguments] { return man_verb(program, *arguments); });
  man.describe(
      "Prints a page in roff, with the macros of man(7), made from the tables that --help is made from. "
      "Without a verb it is the page of the program.");
  man.add("VERB", &arguments->verb, "whose page").one_of(names);
  man.add("--all", &arguments->all, "write every page to a file there, e.g. DIR/earthtop-run.1").called("DIR").without("VERB");
  man.example("earthtop man run | man -l -", "reads the page of run");
  man.example("earthtop man --all /usr/local/share/man/man1", "puts the pages where man finds them");
  return man;
}

}  // namespace earthtop::tool
