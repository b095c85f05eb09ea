#include <algorithm>
#include <array>
#include <memory>

#include "earthtop/scenario/reference.hpp"
#include "output.hpp"
#include "verbs.hpp"

namespace earthtop::tool {
namespace {

/// A kind of file that has a schema.
struct DescribedFile {
  const char* flag;  // null for a scenario
  const char* what;
  std::string (*schema)();
  std::string (*markdown)();
};
constexpr std::array<DescribedFile, 4> kDescribedFiles = {{
    {nullptr, "", scenario_schema, scenario_reference_markdown},
    {"--study", "of a study file instead", study_schema, study_reference_markdown},
    {"--mapping", "of a mapping file instead, which compare takes beside a foreign CSV", mapping_schema,
     mapping_reference_markdown},
    {"--tolerances", "of a tolerance file instead, which compare takes", tolerances_schema, tolerances_reference_markdown},
}};

}  // namespace

void add_schema(CLI::App& app, Action& action) {
  auto markdown = std::make_shared<bool>(false);
  auto chosen = std::make_shared<std::array<bool, kDescribedFiles.size()>>();
  CLI::App* schema = app.add_subcommand("schema", "what a scenario may say: a JSON Schema (draft 7) for editors");
  schema->add_flag("--markdown", *markdown, "the same for people: a table of all keys");
  CLI::Option_group* kinds = schema->add_option_group("file");
  kinds->require_option(0, 1);
  for (std::size_t i = 1; i < kDescribedFiles.size(); ++i)
    kinds->add_flag(kDescribedFiles[i].flag, (*chosen)[i], kDescribedFiles[i].what);
  schema->callback([&action, markdown, chosen] {
    action = [markdown, chosen] {
      const auto given = static_cast<std::size_t>(std::find(chosen->begin(), chosen->end(), true) - chosen->begin());
      const DescribedFile& file = kDescribedFiles[given < chosen->size() ? given : 0];
      print(*markdown ? file.markdown() : file.schema());
      return static_cast<int>(kDone);
    };
  });
}

}  // namespace earthtop::tool
