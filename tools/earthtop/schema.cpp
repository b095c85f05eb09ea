#include <memory>

#include "earthtop/scenario/reference.hpp"
#include "output.hpp"
#include "verbs.hpp"

namespace earthtop::tool {

void add_schema(CLI::App& app, Action& action) {
  auto markdown = std::make_shared<bool>(false), study = std::make_shared<bool>(false);
  CLI::App* schema = app.add_subcommand("schema", "what a scenario may say: a JSON Schema (draft 7) for editors");
  schema->add_flag("--markdown", *markdown, "the same for people: a table of all keys");
  schema->add_flag("--study", *study, "of a study file instead");
  schema->callback([&action, markdown, study] {
    action = [markdown, study] {
      if (*study)
        print(*markdown ? study_reference_markdown() : study_schema());
      else
        print(*markdown ? scenario_reference_markdown() : scenario_schema());
      return static_cast<int>(kDone);
    };
  });
}

}  // namespace earthtop::tool
