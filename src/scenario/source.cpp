#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <utility>

#include "earthtop/scenario/scenario.hpp"
#include "scenario/reader.hpp"

namespace earthtop {
namespace {

class Descriptor {
 public:
  explicit Descriptor(int descriptor) : descriptor_(descriptor) {}
  ~Descriptor() {
    if (descriptor_ > STDERR_FILENO) ::close(descriptor_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  int get() const { return descriptor_; }

 private:
  int descriptor_;
};

[[noreturn]] void refuse(const std::string& file, std::string message) {
  throw ScenarioError(std::vector<Diagnostic>{{0, 0, "", std::move(message)}}, file);
}

void require_regular(const struct stat& status, const std::string& file) {
  if (S_ISDIR(status.st_mode)) refuse(file, "is a directory; give a scenario file in it");
  if (S_ISFIFO(status.st_mode)) refuse(file, "is a FIFO; give a file, or '-' and redirect standard input");
  if (!S_ISREG(status.st_mode)) refuse(file, "is no regular file; give a file, or '-' for standard input");
}

std::string read_all(int descriptor, const std::string& file) {
  std::string text, chunk(std::size_t{1} << 16, '\0');
  for (;;) {
    const ssize_t got = ::read(descriptor, chunk.data(), chunk.size());
    if (got < 0 && errno == EINTR) continue;
    if (got < 0 && errno == EISDIR) refuse(file, "is a directory; give a scenario file in it");
    if (got < 0 && errno == EBADF) refuse(file, "is closed; give a file, or redirect standard input");
    if (got < 0) throw ReadError(file, fmt::format("reading broke off ({}); check the file", std::strerror(errno)));
    if (got == 0) return text;
    text.append(chunk, 0, static_cast<std::size_t>(got));
    if (text.size() > scenario::kLargestText)
      refuse(file, "has more than 16 MiB, the most a scenario may have; is it a scenario file?");
  }
}

}  // namespace

ScenarioSource read_scenario_source(const std::string& path) {
  if (path == "-") return {"<stdin>", read_all(STDIN_FILENO, "<stdin>")};
  struct stat status = {};
  if (::stat(path.c_str(), &status) == 0) require_regular(status, path);
  // Not blocking, and asked again: a FIFO put there in between would hold the program for ever.
  const Descriptor file(::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC | O_NOCTTY));
  if (file.get() < 0) {
    if (errno == ENOENT) refuse(path, "there is no such file; check the path, or give '-' for standard input");
    refuse(path, fmt::format("cannot be opened ({}); check path and permissions", std::strerror(errno)));
  }
  if (::fstat(file.get(), &status) != 0)
    refuse(path, fmt::format("cannot be examined ({}); check the file", std::strerror(errno)));
  require_regular(status, path);
  return {path, read_all(file.get(), path)};
}

}  // namespace earthtop
