// SPDX-License-Identifier: GPL-3.0-or-later
// earthtop help: what --help prints.
#include <memory>

#include "command_line.hpp"
#include "help_text.hpp"
#include "output.hpp"
#include "screen.hpp"
#include "unknown_words.hpp"
#include "verbs.hpp"

namespace earthtop::tool {

Verb describe_help(const Verb& program, const std::vector<std::string>& names) {
  auto words = std::make_shared<std::vector<std::string>>();
  Verb help("help", "print the help of the program or of a verb", [&program, words] {
    print(help_text(find_verb(program, *words), output_screen().width));
    return kDone;
  });
  help.add("VERB", words.get(), "the verb, or a verb and one below it; without one, the program").completed_to(names);
  help.describe("Prints what --help prints: operands, options, examples and exit statuses. The manual says the same.");
  help.example("earthtop help", "lists all verbs");
  help.example("earthtop help run", "prints the help of run");
  help.example("earthtop help study merge", "prints the help of a verb below study");
  help.ends_with(kRefused, "there is no such verb");
  return help;
}

}  // namespace earthtop::tool
