// SPDX-License-Identifier: GPL-3.0-or-later
#include "gallery_page.hpp"

#include <fmt/core.h>
#include <stdlib.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string_view>
#include <system_error>

#include "earthtop/error.hpp"
#include "earthtop/results/results.hpp"
#include "earthtop/run.hpp"
#include "earthtop/study/run_study.hpp"
#include "earthtop/study/study.hpp"
#include "run/playable.hpp"
#include "scenario_operand.hpp"

namespace earthtop::tool {
namespace {

/// A directory for the results of one page, which goes with this object.
class WorkDirectory {
 public:
  WorkDirectory() {
    std::error_code error;
    const std::filesystem::path place = std::filesystem::temp_directory_path(error);
    if (error) throw WriteError("the directory for temporary files", error.message());
    std::string name = (place / "earthtop-gallery-XXXXXX").string();
    if (::mkdtemp(name.data()) == nullptr) throw WriteError(place.string(), std::strerror(errno));
    path_ = name;
  }
  ~WorkDirectory() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  WorkDirectory(const WorkDirectory&) = delete;
  WorkDirectory& operator=(const WorkDirectory&) = delete;
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

/// The base that a study names by its file; none where the base is in the study.
std::optional<ScenarioSource> base_of(const Example& study) {
  const nlohmann::json base = nlohmann::json::parse(study.text).at("base");
  if (!base.is_string()) return std::nullopt;
  const std::filesystem::path file = base.get<std::string>();
  const auto all = file.parent_path().filename() == "hard" ? hard_cases() : examples();
  const std::string name = file.stem().string();
  const auto found = std::ranges::find(all, std::string_view(name), &Example::name);
  if (found == all.end()) throw ScenarioError("/base", fmt::format("there is no scenario \"{}\"", name));
  return source_of(*found);
}

Study shipped_study(const Example& example) { return parse_study(source_of(example), base_of(example)); }

Scene shipped_scene(const Example& example) { return resolve(parse_scenario(source_of(example))); }

Report scene_page(const Example& example, const std::filesystem::path& directory, const Watch& watch) {
  const Scene scene = shipped_scene(example);
  const RunResult result = run(scene, {.watch = watch});
  if (result.status == RunStatus::interrupted) throw Interrupted();
  write_results(result, directory, false, watch);
  return make_report(directory, watch, kGalleryIndex);
}

Report study_page(const Example& example, const std::filesystem::path& directory, const Watch& watch) {
  StudyRunOptions options;
  options.dir = directory;
  options.jobs = 1;  // pages are made beside each other
  options.watch = watch;
  if (run_study(shipped_study(example), options).interrupted) throw Interrupted();
  return make_report(directory, watch, kGalleryIndex);
}

}  // namespace

std::vector<GalleryItem> gallery_items() {
  std::vector<GalleryItem> items;
  for (const Example& example : examples()) {
    const Scene scene = shipped_scene(example);
    items.push_back({std::string(example.name), &example, false, estimated_run_seconds(scene), unplayable(scene)});
  }
  for (const Example& example : shipped_studies())
    items.push_back({fmt::format("study-{}", example.name), &example, true, 0, "it is a study of many runs"});
  return items;
}

Report make_gallery_page(const GalleryItem& item, const Watch& watch) {
  const WorkDirectory work;
  const std::filesystem::path results = work.path() / item.source->name;
  return item.is_study ? study_page(*item.source, results, watch) : scene_page(*item.source, results, watch);
}

}  // namespace earthtop::tool
