// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <atomic>
#include <exception>
#include <filesystem>
#include <memory>
#include <mutex>
#include <numeric>
#include <optional>
#include <string>
#include <system_error>
#include <thread>
#include <vector>

#include "command_line.hpp"
#include "earthtop/error.hpp"
#include "earthtop/results/output_files.hpp"
#include "earthtop/results/results.hpp"
#include "gallery_page.hpp"
#include "input/suggest.hpp"
#include "interrupt.hpp"
#include "json_object.hpp"
#include "output.hpp"
#include "progress_line.hpp"
#include "verbs.hpp"

namespace earthtop::tool {
namespace {

struct GalleryArguments {
  std::string directory;
  std::vector<std::string> only;
  unsigned jobs = 0;
  bool svg = false, force = false, json = false, quiet = false;
};

std::vector<std::string> page_names() {
  std::vector<std::string> names;
  for (const Example& example : examples()) names.emplace_back(example.name);
  for (const Example& example : shipped_studies()) names.push_back(fmt::format("study-{}", example.name));
  return names;
}

/// The items whose pages are asked for, in the gallery's order.
std::vector<GalleryItem> wanted_items(const std::vector<std::string>& only) {
  std::vector<GalleryItem> items = gallery_items();
  if (only.empty()) return items;
  std::vector<std::string_view> names;
  for (const GalleryItem& item : items) names.push_back(item.name);
  for (const std::string& name : only) {
    if (std::ranges::find(names, std::string_view(name)) != names.end()) continue;
    const auto meant = input::suggest(name, names);
    throw ScenarioError("", fmt::format("--only {}: there is no such page; {}", printable(name),
                                        meant ? fmt::format("did you mean {}?", *meant)
                                              : fmt::format("there are: {}", fmt::join(names, ", "))));
  }
  std::erase_if(items, [&](const GalleryItem& item) { return std::ranges::find(only, item.name) == only.end(); });
  return items;
}

/// Refuses a directory that has files, but no gallery.
void require_room(const std::filesystem::path& directory, bool force) {
  require_place_for_directory(directory, "choose another directory");
  std::error_code error;
  if (force || !std::filesystem::is_directory(directory, error)) return;
  const std::filesystem::directory_iterator entries(directory, error);
  if (error) throw ReadError(directory.string(), error.message());
  if (entries == std::filesystem::directory_iterator() || is_something_at(directory / kGalleryIndex)) return;
  refuse_file(directory.string(), "has other files, and no gallery; choose another directory, or --force to add one there");
}

/// The pages that the threads make, each the next one that nobody has taken.
class Workshop {
 public:
  Workshop(const std::vector<GalleryItem>& items, bool shows_progress)
      : items_(items), reports_(items.size()), line_(shows_progress) {
    order_.resize(items.size());
    std::iota(order_.begin(), order_.end(), std::size_t{0});
    // The longest first, so that none of them is alone at the end: studies, of which nothing is estimated, before scenarios.
    std::ranges::stable_sort(order_, [&](std::size_t a, std::size_t b) {
      if (items[a].is_study != items[b].is_study) return items[a].is_study;
      return items[a].seconds > items[b].seconds;
    });
  }

  /// @throws what the first page threw that could not be made
  std::vector<GalleryPage> make_all(unsigned jobs) {
    std::vector<std::thread> threads;
    try {
      while (threads.size() + 1 < jobs) threads.emplace_back([this] { work(); });
    } catch (const std::system_error&) {  // fewer threads do, too
    }
    work();
    for (std::thread& thread : threads) thread.join();
    line_.clear();
    if (failure_) std::rethrow_exception(failure_);
    std::vector<GalleryPage> pages;
    for (std::size_t i = 0; i < items_.size(); ++i) pages.push_back({items_[i].name + ".html", std::move(*reports_[i])});
    return pages;
  }
  std::size_t done() const { return done_; }

 private:
  void work() {
    while (!failed_ && !*stop_flag()) {
      const std::size_t next = next_++;
      if (next >= order_.size()) return;
      const std::size_t at = order_[next];
      try {
        reports_[at] = make_gallery_page(items_[at], Watch(stop_flag()));
        const std::lock_guard lock(mutex_);
        line_.show(fmt::format("{} of {} pages", ++done_, items_.size()));
      } catch (...) {
        const std::lock_guard lock(mutex_);
        if (!failure_) failure_ = std::current_exception();
        failed_ = true;
      }
    }
    if (*stop_flag()) {
      const std::lock_guard lock(mutex_);
      if (!failure_) failure_ = std::make_exception_ptr(Interrupted());
    }
  }

  const std::vector<GalleryItem>& items_;
  std::vector<std::optional<Report>> reports_;
  std::vector<std::size_t> order_;
  std::atomic<std::size_t> next_ = 0;
  std::atomic<bool> failed_ = false;
  std::mutex mutex_;
  std::size_t done_ = 0;
  std::exception_ptr failure_;
  ProgressLine line_;
};

void print_pages(const std::vector<GalleryItem>& items, const std::vector<GalleryPage>& pages,
                 const std::vector<std::string>& written) {
  std::vector<JsonObject> list;
  for (std::size_t i = 0; i < items.size(); ++i) {
    JsonObject object;
    object.put("name", items[i].name)
        .put("page", written[i])
        .put("title", pages[i].report.title)
        .put("group", pages[i].report.group)
        .put("playable", items[i].unplayable.empty());
    items[i].unplayable.empty() ? object.put_null("unplayable_reason") : object.put("unplayable_reason", items[i].unplayable);
    list.push_back(std::move(object));
  }
  print_json(JsonObject().put("written", written).put("pages", list));
}

int gallery_verb(const GalleryArguments& arguments) {
  const std::filesystem::path directory = arguments.directory;
  const std::vector<GalleryItem> items = wanted_items(arguments.only);
  require_room(directory, arguments.force);
  std::vector<OutputFile> outputs;
  for (const GalleryItem& item : items)
    outputs.push_back({OutputKind::gallery_page, (directory / (item.name + ".html")).string()});
  outputs.push_back({OutputKind::gallery_page, (directory / kGalleryIndex).string()});
  std::vector<std::string> written;  // the pages in their order, the index, and pictures
  for (const OutputFile& output : outputs) written.push_back(output.path);
  OutputFiles files(std::move(outputs), {}, arguments.force);

  Workshop workshop(items, !arguments.quiet && !arguments.json);
  std::vector<GalleryPage> pages;
  try {
    const OrderlyEnd orderly(true);  // until the temporary directories are gone
    pages = workshop.make_all(arguments.jobs > 0 ? arguments.jobs : std::max(1U, std::thread::hardware_concurrency()));
  } catch (const Interrupted&) {
    return report_errors("",
                         {{0, 0, "",
                           fmt::format("interrupted at {} of {} pages; nothing was written; the same command starts again",
                                       workshop.done(), items.size())}},
                         arguments.json, interrupted_status());
  }
  std::size_t bytes = 0;
  const auto put = [&](const std::string& file, std::string html) {
    bytes += html.size();
    files.put(file, std::move(html));
  };
  const std::string index = written.back();
  put(index, gallery_index(pages));
  for (std::size_t i = 0; i < pages.size(); ++i) put(written[i], std::move(pages[i].report.html));
  for (const GalleryPage& page : pages) {
    if (!arguments.svg || page.report.picture.empty()) continue;
    const std::string file = (directory / page.file).replace_extension(".svg").string();
    files.add({OutputKind::gallery_picture, file}, page.report.picture);
    written.push_back(file);
  }
  files.commit();
  if (arguments.json)
    print_pages(items, pages, written);
  else if (!arguments.quiet)
    print(fmt::format("{}: {} pages beside it, {} in all\n", printable(index), items.size(),
                      bytes_text(static_cast<double>(bytes))));
  return kDone;
}

}  // namespace

Verb describe_gallery() {
  auto arguments = std::make_shared<GalleryArguments>();
  Verb gallery("gallery", "write a page for every scenario and study that comes with the program, and an index",
               [arguments] { return gallery_verb(*arguments); });
  gallery.add("DIR", &arguments->directory, "directory for the pages; it is made where there is none").required();
  gallery.add("--only", &arguments->only, "only these pages: a scenario's name, or study- and a study's")
      .called("NAME")
      .with_commas()
      .completed_to(page_names());
  gallery.add("--jobs", &arguments->jobs, "number of threads; default: one per core").called("N").within(1, 4096);
  gallery.add("--svg", &arguments->svg, "also write the index's small pictures as SVG files beside the pages");
  gallery.add("--force", &arguments->force,
              "also overwrite files that earthtop did not write, or that have been changed since");
  gallery.add("--json", &arguments->json, "print the pages, or the errors, as one JSON document");
  gallery.add("--quiet", &arguments->quiet, "print nothing but errors (and what --json asks for)");
  gallery.describe(
      "Runs all of them and writes DIR/index.html, with a small picture and the finding of each, and its page beside it. No "
      "page "
      "needs a network, and each but the index can be passed on alone. The same program writes the same bytes. The files are "
      "put in "
      "place together, at the end.");
  gallery.example("earthtop gallery gallery", "writes gallery/index.html and all pages");
  gallery.example("earthtop gallery some --only toy-top,study-latitude", "writes two pages and their index");
  gallery.ends_with(kDone, "the pages are written");
  gallery.ends_with(
      kRefused,
      "the command line was refused, or the directory has files that are no gallery or are not as earthtop wrote them; "
      "nothing was written");
  gallery.ends_with(kWriteFailed, "writing failed, in the directory or in that for temporary files");
  gallery.ends_with(kInterrupted, "interrupted by SIGHUP, SIGINT or SIGTERM; nothing was written");
  return gallery;
}

}  // namespace earthtop::tool
