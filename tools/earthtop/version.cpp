// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/core.h>

#include <memory>

#include "command_line.hpp"
#include "earthtop/bench/peers.hpp"
#include "earthtop/integrate/options.hpp"
#include "earthtop/results/provenance.hpp"
#include "earthtop/study/processes.hpp"
#include "json_object.hpp"
#include "output.hpp"
#include "verbs.hpp"

namespace earthtop::tool {

int version_verb(bool json) {
  const BuildInfo& build = build_info();
  const bool extended = !precision_refusal(Precision::bits113);
  const std::string precisions = extended ? "double, long_double, float128" : "double";
  if (json) {
    JsonObject libraries;
    for (const auto& [name, version] : build.libraries) libraries.put(name, version);
    JsonObject document;
    document.put("program", "earthtop").put("version", build.version).put("commit", build.commit);
    document.put("compiler", build.compiler).put("flags", build.flags).put("libraries", libraries);
    document.put("peers", peers_description()).put("mpi", has_mpi()).put("precisions", precisions);
    print_json(document);
    return kDone;
  }
  std::string libraries;
  for (const auto& [name, version] : build.libraries)
    libraries += fmt::format("{}{} {}", libraries.empty() ? "" : ", ", name, version);
  print(fmt::format(
      "earthtop {}\ncommit     {}\ncompiler   {}\nflags      {}\nlibraries  {}\npeers      {}\nmpi        {}\nprecisions {}\n",
      build.version, build.commit, build.compiler, build.flags, libraries, peers_description(), has_mpi() ? "yes" : "no",
      precisions));
  return kDone;
}

Verb describe_version() {
  auto json = std::make_shared<bool>(false);
  Verb version("version", "print what was built, from what, and how", [json] { return version_verb(*json); });
  version.add("--json", json.get(), "print it as one JSON document");
  version.describe(
      "Prints the version, the commit, the compiler and its flags, the versions of the libraries, and which optional parts "
      "were compiled in.");
  version.example("earthtop version", "prints one line for each");
  version.example("earthtop version --json", "prints the same for programs");
  return version;
}

}  // namespace earthtop::tool
