#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>
#include <system_error>

#include "earthtop/results/provenance.hpp"
#include "earthtop/results/results.hpp"

namespace earthtop {
namespace {

namespace fs = std::filesystem;

/// In the order in which they appear; summary.json, which names the scenario, comes last.
constexpr std::array kFiles = {"trajectory.csv", "torques.csv", "drift.svg", "timing.json", "summary.json"};

[[noreturn]] void refuse(const fs::path& dir, std::string reason) {
  throw ScenarioError(std::vector<Diagnostic>{{0, 0, "", std::move(reason)}}, dir.string());
}

[[noreturn]] void fail(const fs::path& file, int error) { throw WriteError(file.string(), std::strerror(error)); }

/// A file that is complete on disk under a temporary name beside its place, and vanishes unless it is renamed.
class PendingFile {
 public:
  PendingFile(fs::path place, std::string_view content) : place_(std::move(place)) {
    const int descriptor = open_temporary();
    int error = write_all(descriptor, content);
    if (error == 0 && ::fsync(descriptor) != 0) error = errno;
    if (::close(descriptor) != 0 && error == 0) error = errno;
    if (error != 0) {
      ::unlink(temporary_.c_str());
      fail(place_, error);
    }
  }
  PendingFile(const PendingFile&) = delete;
  PendingFile& operator=(const PendingFile&) = delete;
  ~PendingFile() {
    if (!temporary_.empty()) ::unlink(temporary_.c_str());
  }

  void put_in_place() {
    if (::rename(temporary_.c_str(), place_.c_str()) != 0) fail(place_, errno);
    temporary_.clear();
  }

 private:
  int open_temporary() {
    static std::atomic<unsigned> counter = 0;
    for (int attempt = 0; attempt < 1000; ++attempt) {
      const std::string name = fmt::format(".{}.{}-{}.tmp", place_.filename().string(), ::getpid(), counter++);
      temporary_ = place_.parent_path() / name;
      const int descriptor = ::open(temporary_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
      if (descriptor >= 0) return descriptor;
      if (errno != EEXIST && errno != EINTR) break;
    }
    fail(place_, errno);
  }

  static int write_all(int descriptor, std::string_view rest) {
    while (!rest.empty()) {
      const ssize_t written = ::write(descriptor, rest.data(), rest.size());
      if (written < 0 && errno == EINTR) continue;
      if (written < 0) return errno;
      if (written == 0) return EIO;
      rest.remove_prefix(static_cast<std::size_t>(written));
    }
    return 0;
  }

  fs::path place_;
  fs::path temporary_;
};

/// Removes a file that need not be there.
void remove_file(const fs::path& file) {
  if (::unlink(file.c_str()) != 0 && errno != ENOENT) fail(file, errno);
}

/// Makes the names themselves last. Some file systems cannot sync a directory (EINVAL): then there is nothing to do.
void sync_directory(const fs::path& dir) {
  const int descriptor = ::open(dir.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) fail(dir, errno);
  const int error = ::fsync(descriptor) != 0 && errno != EINVAL ? errno : 0;
  ::close(descriptor);
  if (error != 0) fail(dir, error);
}

/// The scenario whose results `summary` holds; empty if it is not a summary that this program wrote.
std::string scenario_of(const fs::path& summary) {
  constexpr std::uintmax_t kLargest = 64U << 20U;
  std::error_code error;
  if (!fs::is_regular_file(summary, error) || fs::file_size(summary, error) > kLargest || error) return "";
  std::ifstream file(summary, std::ios::binary);
  const std::string text((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
  if (!file) return "";
  const auto json = nlohmann::json::parse(text, nullptr, false);
  const nlohmann::json::json_pointer hash("/provenance/scenario_sha256");
  if (json.is_discarded() || !json.contains(hash) || !json.at(hash).is_string()) return "";
  return json.at(hash).get<std::string>();
}

bool is_there(const fs::path& path) {
  std::error_code error;
  return fs::exists(fs::symlink_status(path, error));
}

/// Refuses what must not be overwritten in an existing directory.
void check_present_files(const fs::path& dir, const Scenario& scenario, bool force) {
  for (const char* name : kFiles)
    if (std::error_code error; fs::is_directory(dir / name, error))
      refuse(dir, std::string(name) + " in it is a directory; choose another --out");
  if (force) return;
  const fs::path summary = dir / "summary.json";
  if (is_there(summary)) {
    const std::string present = scenario_of(summary);
    if (present.empty())
      refuse(dir, "summary.json in it is not a summary of earthtop's; choose another --out, or --force to overwrite it");
    if (present != scenario_sha256(scenario))
      refuse(dir, "holds the results of another scenario; choose another --out, or --force to overwrite them");
    if (!scenario.ledger && is_there(dir / "torques.csv"))
      refuse(dir, "torques.csv in it is none of this scenario's results; choose another --out, or --force to remove it");
    return;
  }
  for (const char* name : kFiles)
    if (is_there(dir / name))
      refuse(dir, std::string(name) + " is in it without a summary.json; choose another --out, or --force to overwrite it");
}

}  // namespace

void check_output_directory(const fs::path& dir, const Scenario& scenario, bool force) {
  if (dir.empty()) refuse("--out", "the directory's name is empty");
  std::error_code error;
  fs::path present = fs::absolute(dir, error).lexically_normal();
  if (error) throw WriteError(dir.string(), error.message());
  while (!is_there(present) && present.has_relative_path()) present = present.parent_path();
  if (!fs::is_directory(present, error)) refuse(present, "is not a directory");
  if (::access(present.c_str(), W_OK | X_OK) != 0) fail(present, errno);
  if (fs::is_directory(dir, error)) check_present_files(dir, scenario, force);
}

void write_results(const RunResult& result, const fs::path& dir, bool force) {
  check_output_directory(dir, result.scenario, force);
  std::error_code error;
  fs::create_directories(dir, error);
  if (error) throw WriteError(dir.string(), error.message());

  PendingFile trajectory(dir / "trajectory.csv", trajectory_csv(result));
  std::optional<PendingFile> torques;
  if (result.ledger) torques.emplace(dir / "torques.csv", torques_csv(result));
  PendingFile figure(dir / "drift.svg", svg(drift_figure(result)));
  PendingFile timing(dir / "timing.json", timing_json(result));
  PendingFile summary(dir / "summary.json", summary_json(result));
  for (PendingFile* file : {&trajectory, &figure, &timing}) file->put_in_place();
  if (torques)
    torques->put_in_place();
  else
    remove_file(dir / "torques.csv");
  summary.put_in_place();
  sync_directory(dir);
}

}  // namespace earthtop
