// SPDX-License-Identifier: GPL-3.0-or-later
#include "earthtop/results/output_files.hpp"

#include <fcntl.h>
#include <fmt/core.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <map>
#include <nlohmann/json.hpp>
#include <system_error>
#include <utility>

#include "earthtop/error.hpp"
#include "input/file.hpp"
#include "results/file_set.hpp"
#include "results/seal.hpp"
#include "text/checksum.hpp"

namespace earthtop {
namespace {

namespace fs = std::filesystem;

/// How the content of a kind of file is known.
struct KnownContent {
  OutputKind kind;
  std::string_view writer;        ///< the command that writes it
  std::string_view open, close;   ///< of a comment; both empty: the file has none, and is not marked
  std::string_view head;          ///< how every such file begins
  std::string_view inside = "";   ///< what it has besides
  bool is_known_unmarked = true;  ///< whether one of version 1.0 is known by its head
};
constexpr std::string_view kPicture = "<svg xmlns=\"http://www.w3.org/2000/svg\" class=\"et\" width=\"";
constexpr std::string_view kPage = "<!doctype html>\n<html lang=\"en\">\n<head>\n";
constexpr std::array<KnownContent, 12> kKnown = {
    {{OutputKind::plan_picture, "earthtop plan --svg", "<!-- ", " -->", kPicture,
      "<title>What a measurement would show</title>"},
     {OutputKind::comparison_picture, "earthtop compare --svg", "<!-- ", " -->", kPicture,
      "<title>Differences over time</title>"},
     {OutputKind::measurement_picture, "earthtop compare --svg", "<!-- ", " -->", kPicture,
      "Measured values with their standard errors, and the model "},
     {OutputKind::page_picture, "earthtop report --svg", "<!-- ", " -->", kPicture},
     {OutputKind::page, "earthtop report", "<!-- ", " -->", kPage, "id=\"earthtop-data\""},
     {OutputKind::verdicts, "earthtop compare --junit", "<!-- ", " -->",
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites name=\"earthtop compare\" "},
     {OutputKind::simulated_data, "earthtop plan --write-data", "# ", "", "# simulated by earthtop plan: ", "", false},
     {OutputKind::scenario, "earthtop", "", "", "", "", false},
     {OutputKind::document, "earthtop", "", "", "", "", false},
     {OutputKind::manual_page, "earthtop man", ".\\\" ", "", ".TH EARTHTOP"},
     {OutputKind::gallery_page, "earthtop gallery", "<!-- ", " -->", kPage, "id=\"earthtop-data\"", false},
     {OutputKind::gallery_picture, "earthtop gallery --svg", "<!-- ", " -->", kPicture, "", false}}};

static_assert(
    [] {
      for (std::size_t i = 0; i < kKnown.size(); ++i)
        if (kKnown[i].kind != static_cast<OutputKind>(i)) return false;
      return kKnown.back().kind == OutputKind::gallery_picture;  // the last one
    }(),
    "each kind has its row, in their order");

const KnownContent& known(OutputKind kind) { return kKnown[static_cast<std::size_t>(kind)]; }

constexpr std::string_view kWrittenBy = "written by ", kChecksum = ", checksum ";

/// The last line of a file, which says who wrote it and what its content was; empty for a kind without comments.
std::string mark_of(const KnownContent& content, std::string_view text) {
  if (content.open.empty()) return "";
  std::string writer(content.writer);
  if (const std::size_t dashes = writer.find("--"); dashes != writer.npos && !content.close.empty())
    writer.replace(dashes, 2, "option ");  // XML has no "--" in comments
  return fmt::format("{}{}{}{}{}{}\n", content.open, kWrittenBy, writer, kChecksum, checksum_text(checksum_of(text)),
                     content.close);
}

/// Whether a text is a document of the same kind as another, and is not known to have been changed.
bool is_like_document(const std::string& there, const std::string& text) {
  const auto kind_of = [](const std::string& document) {
    const nlohmann::json json = nlohmann::json::parse(document, nullptr, false);
    if (!json.is_object()) return std::string();
    for (const char* key : {"$schema", "document"})
      if (const auto found = json.find(key); found != json.end() && found->is_string()) return found->get<std::string>();
    return std::string();
  };
  const std::string kind = kind_of(there);
  return !kind.empty() && kind == kind_of(text) && seal_of(there) != Seal::broken;
}

/// Whether earthtop wrote a file for this purpose, and nobody has changed it since.
bool is_own(OutputKind kind, const std::string& there, const std::string& next) {
  if (!next.empty() && there == next) return true;
  if (kind == OutputKind::document) return is_like_document(there, next);
  const KnownContent& content = known(kind);
  if (content.open.empty() || !there.starts_with(content.head) || there.find(content.inside) == there.npos) return false;
  const std::size_t length = mark_of(content, "").size();
  const std::string_view body = std::string_view(there).substr(0, there.size() - std::min(length, there.size()));
  if (there.ends_with(mark_of(content, body))) return true;
  const std::size_t last = there.rfind(std::string(content.open) + std::string(kWrittenBy));
  return content.is_known_unmarked && last == there.npos;
}

/// The place that a path leads to, links followed as far as they lead.
std::string place_of(const std::string& path) {
  std::error_code error;
  const fs::path absolute = fs::absolute(path, error);
  const fs::path place = fs::weakly_canonical(absolute, error);
  return (error ? absolute.lexically_normal() : place).string();
}

enum class Target { nothing, file, stream };

/// What is at the place of an output. @throws ScenarioError where it can be no output
Target target_of(const std::string& path) {
  struct stat status = {};
  if (!is_something_at(path)) return Target::nothing;
  if (::lstat(path.c_str(), &status) != 0) fail_to_write(path, errno);
  if (S_ISREG(status.st_mode)) return Target::file;
  const bool is_link = S_ISLNK(status.st_mode);
  if (is_link && ::stat(path.c_str(), &status) != 0)
    refuse_file(path, fmt::format("is a link that leads nowhere ({}); repair it, or give another name", std::strerror(errno)));
  if (S_ISFIFO(status.st_mode) || S_ISCHR(status.st_mode)) return Target::stream;
  if (S_ISDIR(status.st_mode)) refuse_file(path, "is a directory; give the name of a file");
  refuse_file(path,
              is_link ? "is a link; give the name of the file that it leads to" : "is not a file; give the name of a file");
}

/// Refuses a file whose content is not this program's. @param next  what is going to be written; empty where not known yet
void require_own(const OutputFile& file, const std::string& next) {
  struct stat status = {};
  if (::lstat(file.path.c_str(), &status) != 0) fail_to_write(file.path, errno);
  if ((status.st_mode & 0222U) == 0)
    refuse_file(file.path, "already exists and is write-protected; give another name, or --force to overwrite it");
  constexpr std::size_t kMost_MiB = 1024;
  if (!is_own(file.kind, input::read_regular_file(file.path, file.path, {"file", false, kMost_MiB}), next))
    refuse_file(file.path,
                fmt::format("already exists, and is not as {} wrote it; give another name, or --force to overwrite it",
                            known(file.kind).writer));
}

}  // namespace

bool is_something_at(const fs::path& path) {
  struct stat status = {};
  if (::lstat(path.c_str(), &status) == 0) return true;
  if (errno != ENOENT && errno != ENOTDIR) fail_to_write(path, errno);
  return false;
}

void require_place_for_directory(const fs::path& directory, std::string_view remedy) {
  std::error_code error;
  fs::path present = fs::absolute(directory, error).lexically_normal();
  if (error) fail_to_write(directory, error.value());
  while (!is_something_at(present) && present.has_relative_path()) present = present.parent_path();
  if (input::type_of(present.string()) != input::PathType::directory) {
    const bool link = fs::is_symlink(fs::symlink_status(present, error));
    refuse_file(present.string(), link ? fmt::format("is a link that does not lead to a directory; repair it, or {}", remedy)
                                       : fmt::format("is not a directory; {}", remedy));
  }
  if (::access(present.c_str(), W_OK | X_OK) != 0) fail_to_write(present, errno);
}

struct OutputFiles::Output {
  explicit Output(OutputFile its_file) : file(std::move(its_file)) {}
  ~Output() {
    if (stream >= 0) ::close(stream);
  }
  Output(const Output&) = delete;
  Output& operator=(const Output&) = delete;

  fs::path directory() const {
    const fs::path path = file.path;
    return path.has_parent_path() ? path.parent_path() : fs::path(".");
  }
  std::string name() const { return fs::path(file.path).filename().string(); }

  /// Checks that it may be written; opens a FIFO or a device, so that nobody waits for its reader later.
  void require_free(bool force) {
    if (stream >= 0) return;
    if (!fs::path(file.path).has_filename()) refuse_file(file.path, "is not the name of a file; give the name of a file");
    switch (target_of(file.path)) {
      case Target::nothing: break;
      case Target::file:
        if (!force) require_own(file, content.value_or(""));
        break;
      case Target::stream:
        stream = ::open(file.path.c_str(), O_WRONLY | O_NONBLOCK | O_CLOEXEC | O_NOCTTY);
        if (stream < 0 && errno == ENXIO) refuse_file(file.path, "has no reader; start the process that reads it first");
        if (stream < 0) fail_to_write(file.path, errno);
        ::fcntl(stream, F_SETFL, ::fcntl(stream, F_GETFL) & ~O_NONBLOCK);
        return;
    }
    require_place_for_directory(directory(), "give the name of a file in one");
  }

  OutputFile file;
  std::optional<std::string> content;
  int stream = -1;
};

OutputFiles::OutputFiles(std::vector<OutputFile> files, const std::vector<std::string>& inputs, bool force)
    : inputs_(inputs), force_(force) {
  for (OutputFile& file : files)
    if (!file.path.empty()) {
      outputs_.push_back(std::make_unique<Output>(std::move(file)));
      require_apart(*outputs_.back());
    }
  for (const auto& output : outputs_) output->require_free(force_);
}

OutputFiles::~OutputFiles() = default;

void OutputFiles::require_apart(const Output& output) const {
  const std::string place = place_of(output.file.path);
  for (const auto& other : outputs_) {
    if (other.get() == &output) break;
    const std::string there = place_of(other->file.path);
    if (there != place && !place.starts_with(there + "/") && !there.starts_with(place + "/")) continue;
    refuse_file("", fmt::format("{} and {} name the same file; give two", other->file.option, output.file.option));
  }
  for (const std::string& input : inputs_) {
    if (input.empty() || input == "-") continue;
    const std::string read = place_of(input);
    if (place == read || place.starts_with(read + "/"))
      refuse_file(output.file.path, fmt::format("is {}one of the inputs; write to another place", place == read ? "" : "in "));
  }
}

void OutputFiles::put(std::string_view path, std::string content) {
  for (const auto& output : outputs_)
    if (output->file.path == path) output->content = content + mark_of(known(output->file.kind), content);
}

void OutputFiles::add(OutputFile file, std::string content) {
  const std::string path = file.path;
  outputs_.push_back(std::make_unique<Output>(std::move(file)));
  require_apart(*outputs_.back());
  put(path, std::move(content));
  outputs_.back()->require_free(force_);
}

void OutputFiles::commit() {
  std::map<std::string, std::vector<Output*>> directories;  // two sets may not lock one directory
  for (const auto& output : outputs_)
    if (output->content && output->stream < 0) directories[place_of(output->directory().string())].push_back(output.get());
  std::vector<std::unique_ptr<FileSet>> sets;
  for (const auto& [place, files] : directories) {
    std::vector<std::string> names;
    for (const Output* output : files) names.push_back(output->name());
    const std::vector<std::string_view> views(names.begin(), names.end());
    sets.push_back(std::make_unique<FileSet>(files.front()->directory(), views));
    for (Output* output : files) {
      output->require_free(force_);
      if (output->stream >= 0) refuse_file(output->file.path, "has been changed in the meantime; repeat the command");
      sets.back()->add(output->name(), *output->content);
    }
  }
  for (const auto& output : outputs_)
    if (output->content && output->stream >= 0) write_whole(output->stream, output->file.path, *output->content);
  FileSet::commit(sets);
}

}  // namespace earthtop
