// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>

#include "command_line.hpp"
#include "earthtop/results/output_files.hpp"
#include "earthtop/results/provenance.hpp"
#include "manual_page.hpp"
#include "output.hpp"
#include "unknown_words.hpp"
#include "verbs.hpp"

namespace earthtop::tool {
namespace {

struct ManArguments {
  std::optional<std::string> verb;
  std::optional<std::string> all;  // a directory
  bool force = false;
};

int man_verb(const Verb& program, const ManArguments& arguments) {
  const auto& verbs = program.verbs;
  const std::string& version = build_info().version;
  if (arguments.all) {
    OutputFiles files({}, {}, arguments.force);
    const auto add = [&](const Verb& verb) {
      const std::filesystem::path page = std::filesystem::path(*arguments.all) / (manual_page_name(program, verb) + ".1");
      files.add({OutputKind::manual_page, page.string()}, manual_page(program, verb, version));
    };
    add(program);
    std::for_each(verbs.begin(), verbs.end(), add);
    files.commit();
    return kDone;
  }
  const std::vector<std::string> words = arguments.verb ? std::vector{*arguments.verb} : std::vector<std::string>();
  print(manual_page(program, find_verb(program, words).verb, version));
  return kDone;
}

}  // namespace

Verb describe_man(const Verb& program, const std::vector<std::string>& names) {
  auto arguments = std::make_shared<ManArguments>();
  Verb man("man", "print the manual: the page of the program or of a verb",
           [&program, arguments] { return man_verb(program, *arguments); });
  man.describe(
      "Prints a page of the manual in roff, with the macros of man(7). It has all that --help prints, because both are made "
      "from the same table.");
  man.add("VERB", &arguments->verb, "the verb that the page is about; without one, the program").completed_to(names);
  man.add("--all", &arguments->all, "write every page to a file in DIR, e.g. DIR/earthtop-run.1").called("DIR").without("VERB");
  man.add("--force", &arguments->force, "also overwrite files that earthtop did not write, or that have been changed since");
  man.example("earthtop man run | man -l -", "reads the page of run");
  man.example("earthtop man --all /usr/local/share/man/man1", "puts the pages where man finds them");
  man.example("earthtop man > earthtop.1", "writes the page of the program to a file");
  man.ends_with(kRefused, "there is no such verb, or another file is in the way; nothing was written");
  man.ends_with(kWriteFailed, "writing a page failed");
  return man;
}

}  // namespace earthtop::tool
