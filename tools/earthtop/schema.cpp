// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <memory>

#include "command_line.hpp"
#include "earthtop/compare/compare.hpp"
#include "earthtop/measure/releases_file.hpp"
#include "earthtop/scenario/reference.hpp"
#include "earthtop/study/run_study.hpp"
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
constexpr std::array<DescribedFile, 6> kDescribedFiles = {{
    {nullptr, "", scenario_schema, scenario_reference_markdown},
    {"--study", "describe a study file instead", study_schema, study_reference_markdown},
    {"--mapping", "describe a mapping file instead, with which compare reads a foreign CSV file", mapping_schema,
     mapping_reference_markdown},
    {"--tolerances", "describe a tolerance file instead, which compare takes", tolerances_schema,
     tolerances_reference_markdown},
    {"--releases", "describe a release list instead, which compare and plan take", releases_schema,
     releases_reference_markdown},
    {"--study-results", "describe the results of a study instead, as study.json and study export --json have them",
     study_results_schema, study_results_reference_markdown},
}};

struct SchemaArguments {
  bool markdown = false;
  std::array<bool, kDescribedFiles.size()> chosen{};
};

int schema_verb(const SchemaArguments& arguments) {
  const auto& chosen = arguments.chosen;
  const auto given = static_cast<std::size_t>(std::find(chosen.begin(), chosen.end(), true) - chosen.begin());
  const DescribedFile& file = kDescribedFiles[given < chosen.size() ? given : 0];
  print(arguments.markdown ? file.markdown() : file.schema());
  return kDone;
}

}  // namespace

Verb describe_schema() {
  auto arguments = std::make_shared<SchemaArguments>();
  Verb schema("schema", "print what a scenario may say, as a JSON Schema (draft 7) for editors",
              [arguments] { return schema_verb(*arguments); });
  schema.add("--markdown", &arguments->markdown, "print it for people, as a table of all keys");
  for (std::size_t i = 1; i < kDescribedFiles.size(); ++i)
    schema.add(kDescribedFiles[i].flag, &arguments->chosen[i], kDescribedFiles[i].what).in_group("file");
  schema.describe(
      "With the schema, an editor completes keys, shows what they mean and marks what is wrong as you type. The schema is made "
      "from the same table by which files are read.");
  schema.example("earthtop schema > scenario.schema.json", "keeps the schema for an editor");
  schema.example("earthtop schema --study --markdown", "prints all keys of a study file as a table");
  return schema;
}

}  // namespace earthtop::tool
