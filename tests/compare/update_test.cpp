// SPDX-License-Identifier: GPL-3.0-or-later
// References that change as a whole, and new results that change while they are read.
#include <gtest/gtest.h>

#include <array>
#include <map>

#include "compare/replacement.hpp"
#include "compare/snapshot.hpp"
#include "earthtop/error.hpp"
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
  EXPECT_THROW(compare::read_settled(dir.path(), kNames, {},
                                     [&](const compare::Snapshot&) {
                                       ++reads;
                                       change();
                                     }),
               ScenarioError);
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
  EXPECT_THROW(update_reference(dir.path() / "reference", dir.path() / "new", "no"), ScenarioError);
  EXPECT_FALSE(fs::exists(dir.path() / "reference"));
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

}  // namespace
}  // namespace earthtop
