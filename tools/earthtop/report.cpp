// SPDX-License-Identifier: GPL-3.0-or-later
#include "earthtop/report/report.hpp"

#include <fmt/core.h>

#include <memory>
#include <optional>

#include "command_line.hpp"
#include "earthtop/error.hpp"
#include "earthtop/results/output_files.hpp"
#include "input/file.hpp"
#include "json_object.hpp"
#include "output.hpp"
#include "verbs.hpp"

namespace earthtop::tool {
namespace {

struct ReportArguments {
  std::string what;
  std::optional<std::string> out;
  bool svg = false, force = false, json = false, quiet = false;
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

int report_verb(const ReportArguments& arguments) {
  const std::filesystem::path page = arguments.out ? std::filesystem::path(*arguments.out) : report_file(arguments.what);
  std::vector<std::string> written = {page.string()};
  OutputFiles files({{OutputKind::page, page.string()}}, files_read(arguments.what), arguments.force);
  const Report report = make_report(arguments.what);
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
  return kDone;
}

}  // namespace

Verb describe_report() {
  auto arguments = std::make_shared<ReportArguments>();
  Verb report("report", "write one self-contained HTML page about a run, a study, a comparison, a plan or a bench",
              [arguments] { return report_verb(*arguments); });
  report
      .add("WHAT", &arguments->what,
           "the directory of a run or a study, or a document of compare, plan or bench --json; - is standard input")
      .required();
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
