// SPDX-License-Identifier: GPL-3.0-or-later
#include "results/durable.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <new>
#include <system_error>
#include <utility>

#include "earthtop/results/results.hpp"

namespace earthtop {
namespace {

namespace fs = std::filesystem;

int write_all(int descriptor, std::string_view rest, const std::function<void()>& before_each) {
  constexpr std::size_t kChunk = std::size_t{1} << 20;
  while (!rest.empty()) {
    before_each();
    const ssize_t written = ::write(descriptor, rest.data(), std::min(rest.size(), kChunk));
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return errno;
    if (written == 0) return EIO;
    rest.remove_prefix(static_cast<std::size_t>(written));
  }
  return 0;
}

}  // namespace

int Descriptor::close() { return descriptor_ < 0 ? 0 : ::close(std::exchange(descriptor_, -1)); }

void fail_to_write(const fs::path& file, int error) {
  if (error == ENOMEM) throw std::bad_alloc();
  throw WriteError(file.string(), std::strerror(error));
}

void write_whole(int descriptor, const fs::path& place, std::string_view text) {
  if (const int error = write_all(descriptor, text, [] {}); error != 0) fail_to_write(place, error);
}

void wait_for_disk(int descriptor, const fs::path& place) {
  if (::fsync(descriptor) != 0 && errno != EINVAL) fail_to_write(place, errno);
}

void sync_directory(const fs::path& directory) {
  const Descriptor descriptor(::open(directory.empty() ? "." : directory.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (descriptor.get() < 0 && errno == EACCES) return;  // it may be written to, but not listed
  if (descriptor.get() < 0) fail_to_write(directory, errno);
  wait_for_disk(descriptor.get(), directory);
}

Descriptor begin_writing(const fs::path& file, const fs::path& place, const std::function<void(const Sink&)>& produce,
                         const Watch& watch) {
  const auto stop_if_asked = [&] {
    if (watch.asks_to_stop()) throw Interrupted();
  };
  Descriptor descriptor(::open(file.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666));
  if (descriptor.get() < 0) fail_to_write(place, errno);
  produce([&](std::string_view content) {
    if (const int error = write_all(descriptor.get(), content, stop_if_asked); error != 0) fail_to_write(place, error);
  });
  stop_if_asked();
#ifdef SYNC_FILE_RANGE_WRITE
  ::sync_file_range(descriptor.get(), 0, 0,
                    SYNC_FILE_RANGE_WRITE);  // a hint: what fails here fails again when it is waited for
#endif
  return descriptor;
}

void finish_writing(Descriptor file, const fs::path& place) {
  wait_for_disk(file.get(), place);
  if (file.close() != 0) fail_to_write(place, errno);
}

void write_durably(const fs::path& file, const fs::path& place, const std::function<void(const Sink&)>& produce,
                   const Watch& watch) {
  finish_writing(begin_writing(file, place, produce, watch), place);
}

std::vector<fs::path> missing_directories(const fs::path& directory) {
  std::error_code error;
  std::vector<fs::path> missing;
  for (fs::path at = directory; !at.empty() && !fs::exists(at, error) && at != at.parent_path(); at = at.parent_path())
    missing.insert(missing.begin(), at);
  return missing;
}

void remove_empty(const std::vector<fs::path>& directories) noexcept {
  for (auto at = directories.rbegin(); at != directories.rend(); ++at) ::rmdir(at->c_str());
}

}  // namespace earthtop
