// SPDX-License-Identifier: GPL-3.0-or-later
#include "earthtop/report/report.hpp"

#include <fcntl.h>
#include <fmt/core.h>
#include <spawn.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "command_line.hpp"
#include "earthtop/error.hpp"
#include "earthtop/results/output_files.hpp"
#include "earthtop/study/run_study.hpp"
#include "input/file.hpp"
#include "json_object.hpp"
#include "output.hpp"
#include "verbs.hpp"

namespace earthtop::tool {
namespace {

struct ReportArguments {
  std::optional<std::string> what, out;
  bool opens = false, svg = false, force = false, json = false, quiet = false;
};

/// The files that a page is made from: those in a directory but for pages and pictures.
std::vector<std::string> files_read(const std::string& what) {
  if (what == "-" || input::type_of(what) != input::PathType::directory) return {what};
  std::vector<std::string> files;
  for (const std::string& name : input::names_in(what)) {
    const std::filesystem::path file = std::filesystem::path(what) / name;
    if (file.extension() != ".html" && file.extension() != ".svg") files.push_back(file.string());
  }
  return files;
}

/// The directory below `out` whose results were written last. @throws ScenarioError where there is none
std::string newest_results() {
  const std::filesystem::path below = "out";
  constexpr int kDeepest = 2;  // out/NAME, out/a/NAME, out/a/b/NAME
  std::optional<std::pair<std::filesystem::file_time_type, std::string>> newest;
  std::error_code error;
  std::filesystem::recursive_directory_iterator entries(below, std::filesystem::directory_options::skip_permission_denied,
                                                        error);
  for (; !error && entries != std::filesystem::recursive_directory_iterator(); entries.increment(error)) {
    if (entries.depth() > kDeepest) entries.disable_recursion_pending();
    const std::filesystem::path name = entries->path().filename();
    if (entries.depth() == 0 || (name != "summary.json" && name != study_store("").filename())) continue;
    std::error_code unread;
    const auto when = entries->last_write_time(unread);
    const std::string directory = entries->path().parent_path().string();
    if (!unread && (!newest || std::pair(when, directory) > *newest)) newest.emplace(when, directory);
  }
  if (!newest)
    throw ScenarioError("", "there are no results below out; run a scenario or a study first, or name a directory of results");
  return newest->second;
}

/// Shows a file in the program that the desktop has for it. @returns false where there is no desktop, or no such program
bool show(const std::filesystem::path& file) {
  const auto is_given = [](const char* name) {
    const char* value = std::getenv(name);
    return value != nullptr && *value != '\0';
  };
  if (!is_given("DISPLAY") && !is_given("WAYLAND_DISPLAY")) return false;
  std::string command = "xdg-open", path = std::filesystem::absolute(file).string();
  char* arguments[] = {command.data(), path.data(), nullptr};
  posix_spawn_file_actions_t quiet;
  if (posix_spawn_file_actions_init(&quiet) != 0) return false;
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    posix_spawn_file_actions_addopen(&quiet, stream, "/dev/null", O_RDWR, 0);
  pid_t process = 0;
  const bool is_shown = posix_spawnp(&process, command.c_str(), &quiet, nullptr, arguments, environ) == 0;
  posix_spawn_file_actions_destroy(&quiet);
  return is_shown;
}

int report_verb(const ReportArguments& arguments) {
  const std::string what = arguments.what ? *arguments.what : newest_results();
  const std::filesystem::path page = arguments.out ? std::filesystem::path(*arguments.out) : report_file(what);
  std::vector<std::string> written = {page.string()};
  OutputFiles files({{OutputKind::page, page.string()}}, files_read(what), arguments.force);
  const Report report = make_report(what);
  if (!arguments.quiet) print_notes(report.notes);
  files.put(page.string(), report.html);
  if (arguments.svg)
    for (const auto& [name, picture] : report.pictures) {
      const std::filesystem::path file = page.parent_path() / fmt::format("{}-{}.svg", page.stem().string(), name);
      files.add({OutputKind::page_picture, file.string()}, picture);
      written.push_back(file.string());
    }
  files.commit();
  if (arguments.json)
    print_json(JsonObject().put("written", written));
  else if (!arguments.quiet)
    for (const std::string& file : written) print(printable(file) + "\n");
  if (arguments.opens && !show(page)) message("note: there is no desktop to show it; open it in a browser");
  return kDone;
}

}  // namespace

Verb describe_report() {
  auto arguments = std::make_shared<ReportArguments>();
  Verb report("report", "write one self-contained HTML page about a run, a study, a comparison, a plan or a bench",
              [arguments] { return report_verb(*arguments); });
  report.add("WHAT", &arguments->what,
             "the directory of a run or a study, or a document of compare, plan or bench --json; - is standard input; default: "
             "the newest results below out");
  report.add("--open", &arguments->opens, "also show the page in a browser");
  report.add("--out", &arguments->out, "the page; default: report.html in the directory, or the document's name with .html")
      .called("FILE");
  report.add("--svg", &arguments->svg, "also write its pictures as SVG files beside it");
  report.add("--force", &arguments->force, "also overwrite files that earthtop did not write, or that have been changed since");
  report.add("--json", &arguments->json, "print the names of the files written, or the errors, as one JSON document");
  report.add("--quiet", &arguments->quiet, "print nothing but errors (and what --json asks for)");
  report.describe(
      "Writes a page that needs no other file and no network. It has pictures and tables, and says where the numbers come "
      "from.");
  report.example("earthtop report out/toy-top", "writes out/toy-top/report.html");
  report.example("earthtop report --open", "writes a page about the newest results below out, and shows it");
  report.example("earthtop report out/toy-top --out toy-top.html --svg", "writes toy-top.html, and its pictures beside it");
  report.example("earthtop compare old new --json | earthtop report - --out comparison.html",
                 "writes a page about a comparison");
  report.ends_with(kDone, "the page is written");
  report.ends_with(kRefused,
                   "the command line was refused; or there is nothing to report on; or another file is in the way; nothing "
                   "was written");
  report.ends_with(kWriteFailed, "writing failed, or reading broke off");
  return report;
}

}  // namespace earthtop::tool
