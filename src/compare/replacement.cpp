// SPDX-License-Identifier: GPL-3.0-or-later
#include "compare/replacement.hpp"

#include <fmt/core.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <memory>
#include <new>

#include "compare/comparand.hpp"
#include "earthtop/error.hpp"
#include "earthtop/results/results.hpp"
#include "input/file.hpp"
#include "text/checksum.hpp"

namespace earthtop::compare {
namespace {

using ReplacedFile = Replacement::File;

constexpr std::string_view kHead = "earthtop-update-1\n";  // the journal: this line, then `+` or `-`, `1` or `0`, name, NUL
                                                           // for each file, then the checksum of all that
constexpr std::size_t kDigits = 16;
constexpr const char *kJournal = "journal", *kUndo = "undo", *kDraft = "draft";

/// Makes a directory with those that hold it. @param made  gets those that were not there, the outermost first
void make_directories(const fs::path& directory, std::vector<fs::path>& made, TemporaryNames* known = nullptr) {
  std::vector<fs::path> missing = missing_directories(directory);
  made.reserve(made.size() + missing.size());
  for (fs::path& path : missing) {
    if (known) known->add(path.string());
    if (::mkdir(path.c_str(), 0777) == 0)
      made.push_back(std::move(path));
    else if (errno != EEXIST)
      fail_to_write(path, errno);
  }
}

void remove_file(const fs::path& file) {
  if (::unlink(file.c_str()) != 0 && errno != ENOENT) fail_to_write(file, errno);
}

/// Removes a directory and all in it; links in it are not followed.
void remove_tree(const fs::path& directory) {
  for (const std::string& name : input::names_in(directory.string())) {
    const fs::path path = directory / name;
    if (::unlink(path.c_str()) == 0 || errno == ENOENT) continue;
    if (errno != EISDIR && errno != EPERM) fail_to_write(path, errno);
    remove_tree(path);
  }
  if (::rmdir(directory.c_str()) != 0 && errno != ENOENT) fail_to_write(directory, errno);
}

/// Whether a file's next version is what is in place already: the same bytes, or no file.
bool is_in_place(const ReplacedFile& change) {
  if (!change.is_put) return !is_there(change.place);
  struct stat last = {}, next = {};
  if (::lstat(change.place.c_str(), &last) != 0 || ::lstat(change.next.c_str(), &next) != 0) return false;
  if (!S_ISREG(last.st_mode) || !S_ISREG(next.st_mode) || last.st_size != next.st_size) return false;
  try {
    return input::checksum_of_file(change.place.string(), {"file"}) == input::checksum_of_file(change.next.string(), {"file"});
  } catch (const FileError&) {  // what cannot be read is replaced
    return false;
  }
}

/// Keeps the old version of a file. It stays in its place, too, where the file system has hard links.
void keep_last(const ReplacedFile& change) {
  if (::link(change.place.c_str(), change.last.c_str()) == 0 || errno == EEXIST || errno == ENOENT) return;
  const bool has_links = errno != EPERM && errno != EOPNOTSUPP && errno != EMLINK && errno != ENOSYS;
  if (has_links || ::rename(change.place.c_str(), change.last.c_str()) != 0) fail_to_write(change.place, errno);
}

/// @param resumes  the file may have been put in place already
void put_in_place(ReplacedFile& change, bool resumes) {
  if (change.was_there) keep_last(change);
  if (!change.is_put)
    remove_file(change.place);
  else if (::rename(change.next.c_str(), change.place.c_str()) != 0 && !(resumes && errno == ENOENT))
    fail_to_write(change.place, errno);
  change.is_done = true;
}

/// @returns whether every old version is in its place again
bool put_back(std::vector<ReplacedFile>& changes) noexcept {
  bool all = true;
  for (auto change = changes.rbegin(); change != changes.rend(); ++change) {
    const bool done = change->was_there ? ::rename(change->last.c_str(), change->place.c_str()) == 0
                                        : !change->is_done || ::unlink(change->place.c_str()) == 0;
    all = all && (done || errno == ENOENT);
  }
  return all;
}

void require_free(const DirectoryLock& lock, const fs::path& directory) {
  if (lock.is_busy())
    throw WriteError(directory.string(),
                     "another process has been writing there for 10 s; wait until it has ended, and update again");
}

/// @param resumes  some may be in place already   @param made  gets the directories that were not there
void put_all_in_place(std::vector<ReplacedFile>& changes, const fs::path& root, bool resumes, std::vector<fs::path>& made) {
  for (auto from = changes.begin(); from != changes.end();) {
    const fs::path directory = from->place.parent_path();
    const auto to =
        std::find_if(from, changes.end(), [&](const ReplacedFile& c) { return c.place.parent_path() != directory; });
    make_directories(directory, made);
    std::optional<DirectoryLock> lock;
    if (directory != root) lock.emplace(directory, DirectoryLock::Mode::exclusive);  // the root is locked already
    if (lock) require_free(*lock, directory);
    for (; from != to; ++from) put_in_place(*from, resumes);
    sync_directory(directory);
    if (directory != root) sync_directory(directory.parent_path());
  }
}

ReplacedFile change_of(const fs::path& root, const fs::path& name, bool is_put, bool was_there) {
  const fs::path stage = root / kStagingName;
  return {name, root / name, stage / "new" / name, stage / "old" / name, is_put, was_there, false};
}

/// A name that a journal may state: it does not lead out of the root.
bool is_below_root(const fs::path& name) {
  return !name.empty() && name.is_relative() && std::none_of(name.begin(), name.end(), [](const fs::path& part) {
    return part == ".." || part == "." || part.empty();
  });
}

std::vector<ReplacedFile> read_journal(const fs::path& root, const fs::path& journal) {
  const auto damaged = [&]() {
    refuse_file(journal, fmt::format("is damaged, so that the reference may be, too; remove {}, and update the reference again",
                                     printable(journal.parent_path().string())));
  };
  constexpr std::size_t kLargest_MiB = 256;
  const std::string text = input::read_regular_file(journal.string(), journal.string(), {"journal", false, kLargest_MiB});
  if (text.size() < kHead.size() + kDigits || !text.starts_with(kHead)) damaged();
  const std::string_view content = std::string_view(text).substr(0, text.size() - kDigits);
  if (checksum_text(checksum_of(content)) != std::string_view(text).substr(content.size())) damaged();
  std::vector<ReplacedFile> changes;
  for (std::string_view rest = content.substr(kHead.size()); !rest.empty();) {
    const std::size_t end = rest.find('\0');
    if (end == rest.npos || end < 3) damaged();
    const fs::path name = rest.substr(2, end - 2);
    if (!is_below_root(name)) damaged();
    changes.push_back(change_of(root, name, rest[0] == '+', rest[1] == '1'));
    rest.remove_prefix(end + 1);
  }
  return changes;
}

/// Completes an update that a process left; the root is locked.
void resume(const fs::path& root) try {
  const fs::path stage = root / kStagingName, journal = stage / kJournal, undo = stage / kUndo;
  const CommitMoment moment;
  if (is_there(undo)) {
    std::vector<ReplacedFile> changes = read_journal(root, undo);
    for (ReplacedFile& change : changes) change.is_done = change.is_put && !is_there(change.next);
    if (!put_back(changes)) throw WriteError(root.string(), "the old files cannot be put back");
    for (const ReplacedFile& change : changes)
      if (const fs::path directory = change.place.parent_path(); is_there(directory)) sync_directory(directory);
    remove_file(undo);
  } else if (is_there(journal)) {
    std::vector<ReplacedFile> changes = read_journal(root, journal);
    std::vector<fs::path> made;
    put_all_in_place(changes, root, true, made);
    remove_file(journal);
  }
  remove_tree(stage);
} catch (const WriteError& error) {
  throw WriteError(error.file(), fmt::format("an update was interrupted and cannot be completed ({})", error.reason()));
}

void require_own(const fs::path& root) {
  struct stat status = {};
  const fs::path stage = root / kStagingName;
  if (::lstat(stage.c_str(), &status) != 0) {
    if (errno == ENOENT) return;
    throw ReadError(stage.string(), std::strerror(errno));
  }
  if (!S_ISDIR(status.st_mode) || status.st_uid != ::geteuid())
    refuse_file(stage, "belongs to an update that another user began; that user must repeat the command");
}

}  // namespace

Replacement::Replacement(fs::path root, const Watch& watch) : root_(std::move(root)), watch_(watch) {
  stage_ = root_ / kStagingName;
  journal_ = stage_ / kJournal;
  undo_ = stage_ / kUndo;
  try {
    make_directories(root_, made_, &temporary_names_);
    lock_.emplace(root_, DirectoryLock::Mode::exclusive, watch_);
    require_free(*lock_, root_);
    if (is_there(stage_)) {
      require_own(root_);
      resume(root_);
    }
    make_directories(stage_ / "new", staged_directories_, &temporary_names_);
    make_directories(stage_ / "old", staged_directories_, &temporary_names_);
    temporary_names_.add(stage_ / kDraft);
  } catch (...) {
    remove_empty(staged_directories_);
    remove_empty(made_);
    throw;
  }
}

Replacement::~Replacement() {
  if (!keeps_stage_) {
    for (const ReplacedFile& change : changes_) {
      if (change.is_put) ::unlink(change.next.c_str());
      ::unlink(change.last.c_str());
    }
    remove_empty(staged_directories_);
  }
  if (!keeps_stage_ && ::access(stage_.c_str(), F_OK) == 0) {
    try {
      remove_tree(stage_);
    } catch (const std::exception&) {  // the next update removes it
    }
  }
  if (!keeps_root_) remove_empty(made_);
}

fs::path Replacement::staged(const fs::path& name) const { return stage_ / "new" / name; }

Replacement::File& Replacement::file(const fs::path& name) {
  for (ReplacedFile& known : changes_)
    if (known.name.native() == name.native()) return known;
  if (input::type_of((root_ / name).string()) == input::PathType::directory)
    refuse_file(root_ / name, "is a directory, where a file of the reference belongs; move it away");
  changes_.push_back(change_of(root_, name, false, false));
  ReplacedFile& added = changes_.back();
  make_directories(added.next.parent_path(), staged_directories_, &temporary_names_);
  make_directories(added.last.parent_path(), staged_directories_, &temporary_names_);
  temporary_names_.add(added.next);
  return added;
}

std::pair<fs::path, std::string> Replacement::put(const fs::path& name,
                                                  const std::function<void(const FileSet::Sink&)>& produce) {
  ReplacedFile& file = this->file(name);
  remove_file(file.next);
  file.is_put = true;
  Checksum written;
  write_durably(
      file.next, file.place,
      [&](const FileSet::Sink& sink) {
        produce([&](std::string_view piece) {
          written.add(piece);
          sink(piece);
        });
      },
      watch_);
  if (input::checksum_of_file(file.next.string(), {"file"}) != written.value())
    throw WriteError(file.next.string(), "is not what was written");
  return {file.next, checksum_text(written.value())};
}

void Replacement::take(const fs::path& name) { file(name).is_put = true; }

void Replacement::remove(const fs::path& name) {
  ReplacedFile& file = this->file(name);
  remove_file(file.next);
  file.is_put = false;
}

bool Replacement::changes(const fs::path& name) const {
  const auto known = std::find_if(changes_.begin(), changes_.end(),
                                  [&](const ReplacedFile& change) { return change.name.native() == name.native(); });
  return known != changes_.end() && !is_in_place(*known);
}

void Replacement::keep(const fs::path& name) {
  const auto known = std::find_if(changes_.begin(), changes_.end(),
                                  [&](const ReplacedFile& change) { return change.name.native() == name.native(); });
  if (known == changes_.end()) return;
  remove_file(known->next);
  changes_.erase(known);
}

void Replacement::write_journal() {
  std::string text(kHead);
  for (const ReplacedFile& change : changes_) {
    text += change.is_put ? '+' : '-';
    text += change.was_there ? '1' : '0';
    text += change.name.string();
    text += '\0';
  }
  text += checksum_text(checksum_of(text));
  // It gets its own name when it is complete: under the name of a draft nobody acts on it.
  const fs::path draft = stage_ / kDraft;
  try {
    write_durably(draft, journal_, [&](const FileSet::Sink& sink) { sink(text); });
    for (const fs::path& directory : staged_directories_) sync_directory(directory);
    sync_directory(root_);
    for (const fs::path& directory : made_) sync_directory(directory.parent_path());
    if (::rename(draft.c_str(), journal_.c_str()) != 0) fail_to_write(journal_, errno);
  } catch (...) {
    ::unlink(draft.c_str());
    throw;
  }
}

void Replacement::commit() {
  std::stable_sort(changes_.begin(), changes_.end(), [](const ReplacedFile& a, const ReplacedFile& b) {
    return a.place.parent_path() < b.place.parent_path();  // a directory is locked once
  });
  for (std::size_t i = changes_.size(); i-- > 0;)
    if (is_in_place(changes_[i])) keep(fs::path(changes_[i].name));
  if (changes_.empty()) return;
  for (ReplacedFile& change : changes_) change.was_there = is_there(change.place);
  if (watch_.asks_to_stop()) throw Interrupted();
  const CommitMoment moment;
  write_journal();
  temporary_names_.forget();
  keeps_root_ = keeps_stage_ = true;
  try {
    sync_directory(stage_);
    put_all_in_place(changes_, root_, false, made_);
  } catch (...) {
    if (::rename(journal_.c_str(), undo_.c_str()) != 0 || !put_back(changes_) || ::unlink(undo_.c_str()) != 0)
      throw WriteError(root_.string(), "could be neither updated nor restored; the next compare there repairs it");
    keeps_stage_ = keeps_root_ = false;
    throw;
  }
  remove_file(journal_);
  keeps_stage_ = false;
}

void finish_update_in(const fs::path& directory) {
  const fs::path stage = directory / kStagingName;
  if (!is_there(stage)) return;
  const auto has_begun = [&] { return is_there(stage / kJournal) || is_there(stage / kUndo); };
  if (!has_begun()) {
    // The files that are put together there may belong to a process that is alive, and change nothing yet.
    const DirectoryLock lock(directory, DirectoryLock::Mode::exclusive, {}, std::chrono::seconds(0));
    if (!lock.is_held() || has_begun()) return;
    try {
      remove_tree(stage);
    } catch (const FileError&) {  // a reader without the right to write goes on: what is left does no harm
    } catch (const ScenarioError&) {
    }
    return;
  }
  const DirectoryLock lock(directory, DirectoryLock::Mode::exclusive);
  if (lock.is_busy()) refuse_file(directory, "is being updated; wait until that has ended, and repeat the command");
  if (!is_there(stage)) return;
  require_own(directory);
  resume(directory);
}

void finish_update(const fs::path& path) {
  struct Free {
    void operator()(char* text) const { std::free(text); }
  };
  const std::unique_ptr<char, Free> real(::realpath(path.c_str(), nullptr));
  if (!real && errno == ENOMEM) throw std::bad_alloc();
  if (!real) return;  // there is nothing that could be compared
  const fs::path whole = real.get();
  if (input::type_of(whole.string()) == input::PathType::directory) finish_update_in(whole);
  for (fs::path at = whole; at.has_relative_path();) {
    at = at.parent_path();
    const fs::path stage = at / kStagingName;
    struct stat status = {};
    if (::lstat(stage.c_str(), &status) != 0) {
      if (errno != ENOENT && errno != EACCES) throw ReadError(stage.string(), std::strerror(errno));
    } else if (status.st_uid == ::geteuid()) {  // in a directory where all may write, another user's might be anything
      finish_update_in(at);
    }
  }
}

}  // namespace earthtop::compare
