// SPDX-License-Identifier: GPL-3.0-or-later
// References that change as a whole, and new results that change while they are read.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <future>
#include <map>
#include <thread>

#include "compare/replacement.hpp"
#include "compare/snapshot.hpp"
#include "earthtop/error.hpp"
#include "earthtop/study/run_study.hpp"
#include "results_copy.hpp"
#include "text/checksum.hpp"

namespace earthtop {
namespace {

namespace fs = std::filesystem;
using compare::Replacement;
using testing::read_text;
using testing::ShortRun;
using testing::TemporaryDirectory;
using testing::write_text;

/// The files below a directory with their contents.
std::map<std::string, std::string> contents(const fs::path& directory) {
  std::map<std::string, std::string> found;
  for (const auto& entry : fs::recursive_directory_iterator(directory))
    if (entry.is_regular_file()) found[fs::relative(entry.path(), directory).string()] = read_text(entry.path());
  return found;
}

void put(Replacement& next, const fs::path& name, const std::string& text) {
  next.put(name, [&](const FileSet::Sink& sink) { sink(text); });
}

/// The message with which something is refused; empty where it is not.
std::string refusal(const std::function<void()>& action) {
  try {
    action();
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "";
}

/// Expects that a refusal says something.
void expect_said(const std::function<void()>& action, const std::string& words) {
  const std::string said = refusal(action);
  EXPECT_NE(said.find(words), said.npos) << said;
}

/// Writes results that are not those of ShortRun.
void write_shorter_run(const fs::path& directory) {
  const Overrides shorter = {{"/motion/duration_s", "5"}};
  write_results(run(parse_scenario(read_scenario_source(std::string(EARTHTOP_SCENARIOS) + "/toy-top.json"), shorter)),
                directory, false);
}

/// Where a file is on disk, and when it was last written.
struct Stamp {
  ino_t inode;
  time_t s;
  long ns;
  bool operator==(const Stamp&) const = default;
};

Stamp stamp(const fs::path& file) {
  struct stat status = {};
  EXPECT_EQ(::stat(file.c_str(), &status), 0) << file;
  return {status.st_ino, status.st_mtim.tv_sec, status.st_mtim.tv_nsec};
}

/// Holds a file or directory, as another process does.
class Holder {
 public:
  explicit Holder(const fs::path& path) : descriptor_(::open(path.c_str(), O_RDONLY | O_CLOEXEC)) {
    EXPECT_EQ(::flock(descriptor_, LOCK_EX), 0);
  }
  ~Holder() { ::close(descriptor_); }
  Holder(const Holder&) = delete;
  Holder& operator=(const Holder&) = delete;

 private:
  int descriptor_;
};

class ReplacementTest : public ::testing::Test {
 protected:
  ReplacementTest() {
    fs::create_directories(root_ / "a");
    for (const char* name : {"a/one", "a/gone", "two"}) write_text(root_ / name, "old");
  }
  /// Leaves what a process leaves that is killed while it puts files in place, of which `a/one` is in place already.
  void leave(const std::string& journal_name, const std::vector<std::string>& entries) const {
    const fs::path stage = root_ / compare::kStagingName;
    for (const char* part : {"new/a", "new/deep", "old/a", "old/deep"}) fs::create_directories(stage / part);
    write_text(stage / "old/a/one", "old");
    write_text(root_ / "a/one", "new");
    write_text(stage / "new/deep/three", "new");
    write_text(stage / "new/two", "new");
    std::string text = "earthtop-update-1\n";
    for (const std::string& entry : entries) text += entry + '\0';
    text += checksum_text(checksum_of(text));
    write_text(stage / journal_name, text);
  }
  using Files = std::map<std::string, std::string>;
  const Files old_ = {{"a/one", "old"}, {"a/gone", "old"}, {"two", "old"}};
  const Files new_ = {{"a/one", "new"}, {"deep/three", "new"}, {"two", "new"}};
  const std::vector<std::string> entries_ = {"+1a/one", "-1a/gone", "+0deep/three", "+1two"};
  TemporaryDirectory directory_;
  fs::path root_ = directory_.path() / "root";
};

TEST_F(ReplacementTest, AllChangesOrNothing) {
  {
    Replacement next(root_);
    for (const char* name : {"a/one", "deep/three", "two"}) put(next, name, "new");
    next.remove("a/gone");
    EXPECT_EQ(read_text(root_ / "a/one"), "old");
  }
  EXPECT_EQ(contents(root_), old_);
  {
    Replacement next(root_);
    for (const char* name : {"a/one", "deep/three", "two"}) put(next, name, "new");
    next.remove("a/gone");
    next.commit();
  }
  EXPECT_EQ(contents(root_), new_);
  EXPECT_FALSE(fs::exists(root_ / compare::kStagingName));
  { const Replacement unused(directory_.path() / "none/deeper"); }
  EXPECT_FALSE(fs::exists(directory_.path() / "none"));
}

TEST_F(ReplacementTest, AFailureAtTheLastFilePutsEverythingBack) {
  write_text(root_ / "z", "old");
  {
    Replacement next(root_);
    for (const char* name : {"a/one", "deep/three", "z/four"}) put(next, name, "new");  // where z is a file
    next.remove("a/gone");
    EXPECT_THROW(next.commit(), FileError);
  }
  Files expected = old_;
  expected["z"] = "old";
  EXPECT_EQ(contents(root_), expected);
  for (const char* name : {compare::kStagingName, "deep"}) EXPECT_FALSE(fs::exists(root_ / name)) << name;
}

TEST_F(ReplacementTest, WhatAKilledProcessLeftIsBroughtToItsEnd) {
  leave("journal", entries_);
  compare::finish_update(root_ / "two");  // from within, too
  EXPECT_EQ(contents(root_), new_);
  EXPECT_FALSE(fs::exists(root_ / compare::kStagingName));
}

TEST_F(ReplacementTest, WhatWasBeingPutBackIsPutBack) {
  leave("undo", entries_);
  { const Replacement next(root_); }
  EXPECT_EQ(contents(root_), old_);
}

TEST_F(ReplacementTest, AnUpdateThatHasNotBegunIsForgotten) {
  leave("draft", entries_);
  write_text(root_ / "a/one", "old");
  compare::finish_update(root_);
  EXPECT_EQ(contents(root_), old_);
  EXPECT_FALSE(fs::exists(root_ / compare::kStagingName));
}

TEST_F(ReplacementTest, AJournalThatIsDamagedOrLeadsElsewhereIsRefused) {
  leave("journal", {"+1../outside"});
  EXPECT_THROW(compare::finish_update(root_), ScenarioError);
  leave("journal", entries_);
  const fs::path journal = root_ / compare::kStagingName / "journal";
  std::string text = read_text(journal);
  text[25] ^= 1;
  write_text(journal, text);
  EXPECT_THROW(compare::finish_update(root_), ScenarioError);
}

TEST_F(ReplacementTest, WhatCannotBePutBackIsNamed) {
  leave("undo", entries_);
  fs::remove(root_ / "a/one");
  fs::create_directories(root_ / "a/one/in the way");
  expect_said([&] { compare::finish_update(root_); },
              root_.string() + ": an update was interrupted and cannot be completed (the old files cannot be put back)");
  fs::remove_all(root_ / "a/one");
  EXPECT_EQ(refusal([&] { compare::finish_update(root_); }), "");
  EXPECT_EQ(read_text(root_ / "a/one"), "old");
}

TEST_F(ReplacementTest, AnUpdateThatCanNeitherBeMadeNorTakenBackIsLeftToTheNextOne) {
  write_text(root_ / "z", "old");
  {
    Replacement next(root_);
    for (const char* name : {"a/one", "z/four"}) put(next, name, "new");  // where z is a file
    fs::create_directories(root_ / compare::kStagingName / "undo");       // so that nothing can be noted there
    expect_said([&] { next.commit(); }, "could be neither updated nor restored; the next compare there repairs it");
  }
  fs::remove_all(root_ / compare::kStagingName / "undo");
  fs::remove(root_ / "z");
  compare::finish_update(root_);
  EXPECT_EQ(read_text(root_ / "a/one"), "new");
  EXPECT_EQ(read_text(root_ / "z/four"), "new");
}

TEST_F(ReplacementTest, AnUpdateOfSomebodyElseIsNotCompleted) {
  leave("journal", entries_);
  fs::rename(root_ / compare::kStagingName, directory_.path() / "elsewhere");
  fs::create_directory_symlink(directory_.path() / "elsewhere", root_ / compare::kStagingName);
  const auto before = contents(directory_.path());
  expect_said([&] { compare::finish_update(root_); },
              "belongs to an update that another user began; that user must repeat the command");
  EXPECT_EQ(contents(directory_.path()), before);
}

TEST_F(ReplacementTest, WhatReadsBackOtherwiseThanItWasWrittenIsNotTaken) {
  Replacement next(root_);
  const auto disturbed = [&](const FileSet::Sink& sink) {
    sink("new");
    std::ofstream(next.staged("two"), std::ios::app) << "er";
  };
  expect_said([&] { next.put("two", disturbed); }, "is not what was written");
  EXPECT_EQ(read_text(root_ / "two"), "old");
}

TEST_F(ReplacementTest, WhoWritesForTooLongIsNotWaitedFor) {
  leave("journal", entries_);
  const Holder other(root_);
  static constexpr std::array<std::string_view, 1> kNames = {"two"};
  // At the same time, since each of them waits for ten seconds.
  const auto later = [&](const std::function<void()>& action, const char* words) {
    return std::async(std::launch::async, [=] { expect_said(action, words); });
  };
  const std::future<void> all[] = {
      later([&] { const Replacement next(root_); },
            "another process has been writing there for 10 s; wait until it has ended, and update again"),
      later([&] { compare::finish_update(root_); }, "is being updated; wait until that has ended, and repeat the command"),
      later([&] { compare::read_settled(root_, kNames, {}, [](const compare::Snapshot&) {}); },
            "a run is writing there; wait until it has ended, and repeat the command")};
}

TEST(Snapshot, WhatChangesWhileItIsReadIsReadAgain) {
  const TemporaryDirectory dir;
  const fs::path file = dir.path() / "rows";
  static constexpr std::array<std::string_view, 1> kNames = {"rows"};
  write_text(file, "0");
  int reads = 0;
  const auto change = [&] {  // as a run does it: by another file of this name
    write_text(dir.path() / "next", std::to_string(reads));
    fs::rename(dir.path() / "next", file);
  };
  compare::read_settled(dir.path(), kNames, {}, [&](const compare::Snapshot&) {
    if (++reads > 1) return;
    change();
    throw ScenarioError("", "a mixture");
  });
  EXPECT_EQ(reads, 2);
  const auto change_always = [&](const compare::Snapshot&) {
    ++reads;
    change();
  };
  expect_said([&] { compare::read_settled(dir.path(), kNames, {}, change_always); },
              dir.path().string() + ": error: a run is writing there; wait until it has ended, and repeat the command");
  reads = 0;
  const auto faulty = [&](const compare::Snapshot&) {
    ++reads;
    throw ScenarioError("", "a fault that stays");
  };
  EXPECT_THROW(compare::read_settled(dir.path(), kNames, {}, faulty), ScenarioError);
  EXPECT_EQ(reads, 1);
}

TEST(Update, ResultsThatLackAFileOfTheirSummaryAreRefused) {
  const TemporaryDirectory dir;
  fs::copy(ShortRun::get().path(), dir.path() / "new");
  fs::remove(dir.path() / "new/drift.svg");
  expect_said([&] { update_reference(dir.path() / "reference", dir.path() / "new", "no"); },
              "has no drift.svg, which its summary names; run the scenario again");
  EXPECT_FALSE(fs::exists(dir.path() / "reference"));
}

TEST(Update, AStudyThatIsBeingWrittenIsRefused) {
  const TemporaryDirectory dir;
  const fs::path store = study_store(dir.path() / "new");
  fs::create_directories(store.parent_path());
  write_text(store, "any");
  write_text(store.string() + ".lock", "");
  const char* words = "a study is writing there; wait until it has ended, and repeat the command";
  const auto update = [&] { update_reference(dir.path() / "reference", dir.path() / "new", "no"); };
  {
    const Holder study(store.string() + ".lock");
    expect_said(update, words);
  }
  EXPECT_EQ(refusal(update).find(words), std::string::npos);
}

TEST(Update, AReferenceThatChangesMeanwhileIsNotOverwritten) {
  const TemporaryDirectory dir;
  const fs::path reference = dir.path() / "references/top.json";
  update_reference(reference, ShortRun::get().path(), "one");
  write_shorter_run(dir.path() / "new");
  std::string said;
  for (std::chrono::milliseconds wait(100); said.empty() && wait < std::chrono::seconds(8); wait *= 2) {
    auto other = std::make_unique<Holder>(reference.parent_path());  // which the update waits for before it writes
    auto update = std::async(std::launch::async,
                             [&] { return refusal([&] { update_reference(reference, dir.path() / "new", "two"); }); });
    std::this_thread::sleep_for(wait);
    write_text(reference, read_text(reference));
    other.reset();
    said = update.get();
  }
  EXPECT_EQ(said, reference.string() + ": error: has been changed in the meantime; repeat the command");
}

TEST(Update, ResultsThatKeepChangingAreNotCompared) {
  const TemporaryDirectory dir;
  fs::copy(ShortRun::get().path(), dir.path() / "new");
  std::atomic<bool> ends = false;
  std::thread writer([&] {
    for (auto time = fs::file_time_type::clock::now(); !ends; time += std::chrono::seconds(1))
      fs::last_write_time(dir.path() / "new/summary.json", time);
  });
  std::string said;
  for (int i = 0; i < 1000 && said.empty(); ++i)  // where the writer rests for too long, nothing is said
    said = refusal([&] { compare_results(ShortRun::get().path(), dir.path() / "new", {}); });
  ends = true;
  writer.join();
  EXPECT_NE(said.find("keeps being rewritten; wait until that has ended, and compare again"), said.npos) << said;
  EXPECT_TRUE(compare_results(ShortRun::get().path(), dir.path() / "new", {}).passed());
}

TEST(Update, SeveralReferencesChangeTogether) {
  const TemporaryDirectory dir;
  const fs::path references = dir.path() / "references", several = dir.path() / "several";
  for (const char* name : {"a", "deep/b"}) {
    fs::create_directories((several / name).parent_path());
    fs::copy(ShortRun::get().path(), several / name);
  }
  update_reference(references / "a", several / "a", "one");
  update_reference(references, several, "two");
  EXPECT_TRUE(fs::is_regular_file(references / "deep/b.json"));
  EXPECT_TRUE(compare_results(references, several, testing::with_profile(Profile::bitwise)).passed());
  const auto before = contents(references);
  update_reference(references, several, "two");  // as after a kill
  EXPECT_EQ(contents(references), before);

  write_text(several / "deep/b/trajectory.csv", "t_s\n");
  EXPECT_THROW(update_reference(references, several, "three"), ScenarioError);
  EXPECT_EQ(contents(references), before);
  EXPECT_THROW(update_reference(references, references, "three"), ScenarioError);
}

TEST(Update, FilesWithTheSameContentAreNotTouched) {
  const TemporaryDirectory directory;
  const fs::path root = directory.path() / "reference";
  {
    Replacement first(root);
    put(first, "a/same", "1");
    put(first, "a/other", "1");
    put(first, "same", "1");
    first.commit();
  }
  const Stamp nested = stamp(root / "a/same"), top = stamp(root / "same"), other = stamp(root / "a/other");
  {
    Replacement next(root);
    put(next, "a/same", "1");
    put(next, "a/other", "2");
    put(next, "same", "1");
    EXPECT_FALSE(next.changes("a/same"));
    EXPECT_TRUE(next.changes("a/other"));
    next.commit();
  }
  EXPECT_EQ(stamp(root / "a/same"), nested);
  EXPECT_EQ(stamp(root / "same"), top);
  EXPECT_NE(stamp(root / "a/other"), other);
  EXPECT_EQ(read_text(root / "a/other"), "2");
  EXPECT_FALSE(fs::exists(root / compare::kStagingName));
}

TEST(Update, OfSeveralReferencesRewritesThoseThatChange) {
  const TemporaryDirectory directory;
  const fs::path now = directory.path() / "new", root = directory.path() / "reference";
  fs::create_directories(now);
  for (const char* name : {"a", "b", "c"}) fs::copy(ShortRun::get().path(), now / name);
  fs::create_directories(root);
  fs::create_directories(root / "c");
  update_reference(root / "c", now / "c", "first");  // a directory; the others become compact references
  EXPECT_EQ(update_reference(root, now, "first").size(), 2U);
  const std::map<std::string, std::string> before = contents(root);
  std::map<std::string, Stamp> stamps;
  for (const auto& [name, text] : before) stamps.emplace(name, stamp(root / name));

  std::vector<std::string> unchanged;
  EXPECT_TRUE(update_reference(root, now, "again", {}, &unchanged).empty());
  EXPECT_EQ(unchanged.size(), 3U);
  EXPECT_EQ(contents(root), before);
  for (const auto& [name, last] : stamps) EXPECT_EQ(stamp(root / name), last) << name;

  fs::remove_all(now / "b");
  write_shorter_run(now / "b");
  unchanged.clear();
  const std::vector<std::string> written = update_reference(root, now, "another spin", {}, &unchanged);
  EXPECT_EQ(written, std::vector<std::string>{(root / "b.json").string()});
  EXPECT_EQ(unchanged.size(), 2U);
  for (const auto& [name, last] : stamps) EXPECT_EQ(stamp(root / name) == last, name != "b.json") << name;
  EXPECT_NE(read_text(root / "b.json").find("another spin"), std::string::npos);
}

}  // namespace
}  // namespace earthtop
