// SPDX-License-Identifier: GPL-3.0-or-later
// earthtop help: what --help prints.
#include <algorithm>
#include <memory>
#include <utility>

#include "command_line.hpp"
#include "help_text.hpp"
#include "output.hpp"
#include "screen.hpp"
#include "topics.hpp"
#include "unknown_words.hpp"
#include "verbs.hpp"

namespace earthtop::tool {

Verb describe_help(const Verb& program, const std::vector<std::string>& names) {
  std::vector<std::string> completed = names;
  std::string listed;
  for (const Topic& topic : topics()) {
    completed.emplace_back(topic.name);
    listed += (listed.empty() ? "" : ", ") + std::string(topic.name);
  }
  auto words = std::make_shared<std::vector<std::string>>();
  Verb help("help", "print the help of the program or of a verb, or explain a topic", [&program, words] {
    const auto topic =
        std::ranges::find_if(topics(), [&](const Topic& t) { return words->size() == 1 && t.name == words->front(); });
    if (topic != topics().end())
      print(topic_text(*topic, output_screen().width));
    else
      print(help_text(find_verb(program, *words), output_screen().width));
    return kDone;
  });
  help.add("WORD", words.get(), "the verb, or a verb and one below it; or a topic: " + listed + "; without one, the program")
      .completed_to(std::move(completed));
  help.describe(
      "Prints what --help prints: operands, options, examples and exit statuses; the manual says the same. Of a topic it "
      "prints the table of the manual.");
  help.example("earthtop help", "lists all verbs");
  help.example("earthtop help run", "prints the help of run");
  help.example("earthtop help study merge", "prints the help of a verb below study");
  help.example("earthtop help verdicts", "says what each verdict means");
  help.ends_with(kRefused, "there is no such verb or topic");
  return help;
}

}  // namespace earthtop::tool
