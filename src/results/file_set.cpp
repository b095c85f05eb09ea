// SPDX-License-Identifier: GPL-3.0-or-later
#include "results/file_set.hpp"

#include <dirent.h>
#include <fcntl.h>
#include <fmt/core.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <new>
#include <stdexcept>
#include <system_error>
#include <utility>

#include "earthtop/results/results.hpp"

namespace earthtop {
namespace {

namespace fs = std::filesystem;

// Data for a signal handler: the names that must not stay on disk, and whether files are being put in place.
using Names = std::array<std::atomic<const char*>, 16>;
Names names_on_disk{}, directories_made{};
std::atomic<bool> committing = false;
std::atomic<const TemporaryNames::Name*> last_name = nullptr;

/// Enters a name. @returns where; null if all slots are taken
std::atomic<const char*>* enter(const char* name, Names& names) {
  for (auto& slot : names) {
    const char* none = nullptr;
    if (slot.compare_exchange_strong(none, name)) return &slot;
  }
  return nullptr;
}

/// Keeps the name of a directory known to `discard_temporaries` while it lives.
class MadeDirectory {
 public:
  explicit MadeDirectory(const char* name) : slot_(enter(name, directories_made)) {}
  ~MadeDirectory() {
    if (slot_) *slot_ = nullptr;
  }
  MadeDirectory(const MadeDirectory&) = delete;
  MadeDirectory& operator=(const MadeDirectory&) = delete;

 private:
  std::atomic<const char*>* slot_;
};

std::string temporary_name(std::string_view name) {
  static std::atomic<unsigned> counter = 0;
  return fmt::format(".{}.{}-{}.tmp", name, ::getpid(), counter++);
}

bool is_temporary_of(std::string_view candidate, std::string_view name) {
  const std::string front = fmt::format(".{}.", name);
  constexpr std::string_view kBack = ".tmp";
  if (!candidate.starts_with(front) || !candidate.ends_with(kBack) || candidate.size() <= front.size() + kBack.size())
    return false;
  const auto middle = candidate.substr(front.size(), candidate.size() - front.size() - kBack.size());
  return middle.find_first_not_of("0123456789-") == std::string_view::npos;
}

}  // namespace

TemporaryName::TemporaryName(const char* name) : slot_(enter(name, names_on_disk)) {}
TemporaryName::~TemporaryName() {
  if (slot_) *slot_ = nullptr;
}

void TemporaryNames::add(std::string name) {
  const Name* before = names_.empty() ? nullptr : &names_.back();
  names_.push_back({std::move(name), before});
  last_name.compare_exchange_strong(before, &names_.back());
}
void TemporaryNames::forget() noexcept {
  const Name* last = names_.empty() ? nullptr : &names_.back();
  last_name.compare_exchange_strong(last, nullptr);
}

CommitMoment::CommitMoment() { committing = true; }
CommitMoment::~CommitMoment() { committing = false; }

bool discard_temporaries() noexcept {
  if (committing) return false;
  for (const auto& slot : names_on_disk)
    if (const char* name = slot.load()) ::unlink(name);
  for (const TemporaryNames::Name* name = last_name; name != nullptr; name = name->before)
    if (::unlink(name->path.c_str()) != 0) ::rmdir(name->path.c_str());
  for (auto slot = directories_made.rbegin(); slot != directories_made.rend(); ++slot)  // the innermost one first
    if (const char* name = slot->load()) ::rmdir(name);                                 // rmdir removes it only if it is empty
  return true;
}

/// One file of the set: its place, and the temporary names of its new (`next`) and its old version (`last`) beside it.
struct FileSet::File {
  File(const fs::path& dir, std::string_view its_name)
      : name(its_name), place(dir / its_name), next(dir / temporary_name(its_name)), last(dir / temporary_name(its_name)) {}
  ~File() {
    if (is_written) ::unlink(next.c_str());
    if (is_set_aside) ::unlink(last.c_str());
  }
  File(const File&) = delete;
  File& operator=(const File&) = delete;

  void finish() {
    if (written.get() >= 0) finish_writing(std::move(written), place);
  }
  void set_aside() {
    if (::rename(place.c_str(), last.c_str()) == 0)
      is_set_aside = true;
    else if (errno != ENOENT)
      fail_to_write(place, errno);
  }
  void put_in_place() {
    if (!is_written) return;
    if (::rename(next.c_str(), place.c_str()) != 0) fail_to_write(place, errno);
    is_written = false;
    is_in_place = true;
  }
  void put_back() noexcept {
    if (is_in_place) ::unlink(place.c_str());
    if (is_set_aside) ::rename(last.c_str(), place.c_str());
    is_set_aside = false;  // where even that failed, the old version stays under its temporary name
  }

  std::string name;
  fs::path place, next, last;
  TemporaryName known{next.c_str()};
  Descriptor written;         // the new version, till the disk has it
  bool is_written = false;    // the new version is there as `next`
  bool is_in_place = false;   // the new version has been moved to `place`
  bool is_set_aside = false;  // the old version has been moved to `last`
};

FileSet::FileSet(fs::path dir, std::span<const std::string_view> names, const Watch& watch, std::chrono::seconds patience)
    : dir_(std::move(dir)), watch_(watch) {
  try {
    make_directory();
    lock(patience);
    for (const std::string_view name : names) {
      files_.push_back(std::make_unique<File>(dir_, name));
      if (name != names.back()) remove_left(name);
    }
  } catch (...) {
    remove_empty(made_);
    throw;
  }
}

FileSet::~FileSet() {
  files_.clear();
  if (!committed_) remove_empty(made_);
}

void FileSet::stop_if_asked() const {
  if (watch_.asks_to_stop()) throw Interrupted();
}

void FileSet::make_directory() {
  made_ = missing_directories(dir_);
  for (const fs::path& made : made_) known_.push_back(std::make_shared<MadeDirectory>(made.c_str()));
  std::error_code error;
  fs::create_directories(dir_, error);
  if (error) fail_to_write(dir_, error.value());
}

/// Removes temporary files left for `name`. While this run holds the lock they belong to no running process; without a lock
/// that is not known, and they stay.
void FileSet::remove_left(std::string_view name) const {
  if (!lock_->is_held()) return;
  for (const fs::path& left : temporaries(dir_, name)) ::unlink(left.c_str());
}

void FileSet::lock(std::chrono::seconds patience) {
  lock_.emplace(dir_, DirectoryLock::Mode::exclusive, watch_, patience);
  if (lock_->is_busy())
    throw WriteError(
        dir_.string(),
        fmt::format("another run has been writing there for {} s; wait until it has ended, or choose another --out",
                    patience.count()));
}

std::vector<fs::path> FileSet::temporaries(const fs::path& dir, std::string_view name) {
  // libstdc++'s directory_iterator ends the program where it finds no memory.
  struct Close {
    void operator()(DIR* directory) const { ::closedir(directory); }
  };
  std::vector<fs::path> found;
  const std::unique_ptr<DIR, Close> directory(::opendir(dir.c_str()));
  if (!directory && errno == ENOMEM) throw std::bad_alloc();
  while (const dirent* entry = directory ? ::readdir(directory.get()) : nullptr)
    if (is_temporary_of(entry->d_name, name)) found.push_back(dir / entry->d_name);
  return found;
}

FileSet::File& FileSet::file(std::string_view name) {
  for (const auto& file : files_)
    if (file->name == name) return *file;
  throw std::logic_error(fmt::format("{} is not one of the files", name));
}

void FileSet::add(std::string_view name, const std::function<void(const Sink&)>& produce) {
  File& file = this->file(name);
  // If a file of this name exists, a killed run with the same process number left it.
  if (::unlink(file.next.c_str()) != 0 && errno != ENOENT) fail_to_write(file.place, errno);
  file.is_written = true;
  file.written = begin_writing(file.next, file.place, produce, watch_);
}

void FileSet::add(std::string_view name, std::string_view content) {
  add(name, [&](const Sink& sink) { sink(content); });
}

/// Makes the changes of names in the directory durable.
void FileSet::sync() const {
  if (lock_->descriptor() >= 0) wait_for_disk(lock_->descriptor(), dir_);
}

void FileSet::replace(bool must_go_back) {
  File& seal = *files_.back();
  if (files_.size() == 1 && !must_go_back) {  // it needs no seal: the system puts one version in the place of the other
    seal.put_in_place();
    seal.is_in_place = false;  // the old version is gone: there is nothing to be put back
    return sync();
  }
  seal.set_aside();
  if (seal.is_set_aside) sync();
  for (const auto& file : files_) {
    if (file.get() == &seal) continue;
    file->set_aside();
    file->put_in_place();
  }
  sync();
  seal.put_in_place();
  sync();
}

void FileSet::put_back() noexcept {
  for (const auto& file : files_) file->put_back();  // the seal last
}

void FileSet::commit() {
  FileSet* const alone = this;
  commit_as_one({&alone, 1});
}

void FileSet::commit(std::span<const std::unique_ptr<FileSet>> sets) {
  std::vector<FileSet*> all;
  for (const auto& set : sets) all.push_back(set.get());
  commit_as_one(all);
}

void FileSet::commit_as_one(std::span<FileSet* const> sets) {
  for (const FileSet* set : sets) {
    for (const auto& file : set->files_) file->finish();
    set->stop_if_asked();
  }
  const CommitMoment moment;
  try {
    for (FileSet* set : sets) set->replace(sets.size() > 1);
  } catch (...) {
    for (FileSet* set : sets) set->put_back();
    throw;
  }
  for (FileSet* set : sets) set->settle();
}

/// Removes the old files, which are not needed any more.
void FileSet::settle() {
  committed_ = true;
  for (const auto& file : files_) {
    if (file->is_set_aside) ::unlink(file->last.c_str());
    file->is_set_aside = false;
  }
  remove_left(files_.back()->name);  // only now: till then an old seal says whose directory this is
}

}  // namespace earthtop
