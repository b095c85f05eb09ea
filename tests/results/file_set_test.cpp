// SPDX-License-Identifier: GPL-3.0-or-later
// Files that change together: whatever happens in between, either all old ones or all new ones are there, and nothing else.
#include "results/file_set.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/file.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <fstream>
#include <map>

#include "earthtop/results/results.hpp"
#include "support/temporary_directory.hpp"

namespace earthtop {
namespace {

namespace fs = std::filesystem;

constexpr std::array<std::string_view, 4> kNames = {"rows", "figure", "extra", "seal"};
using Files = std::map<std::string, std::string>;
const Files kOld = {{"rows", "old rows"}, {"figure", "old figure"}, {"extra", "old extra"}, {"seal", "old seal"}};

class FileSetTest : public ::testing::Test {
 protected:
  void put(const Files& files) const {
    for (const auto& [name, text] : files) std::ofstream(dir_ / name) << text;
  }
  Files present() const {
    Files files;
    for (const auto& entry : fs::directory_iterator(dir_)) {
      std::ifstream file(entry.path());
      files[entry.path().filename()] = {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
    }
    return files;
  }
  static void add_new(FileSet& set) {
    for (const std::string_view name : {"rows", "figure", "seal"}) set.add(name, "new " + std::string(name));
  }

  testing::TemporaryDirectory temporary_;
  const fs::path dir_ = temporary_.path();
};

TEST_F(FileSetTest, WhatIsNotAddedGoes) {
  put(kOld);
  FileSet set(dir_, kNames);
  add_new(set);
  set.commit();
  EXPECT_EQ(present(), (Files{{"rows", "new rows"}, {"figure", "new figure"}, {"seal", "new seal"}}));
}

TEST_F(FileSetTest, WithoutCommitNothingChanges) {
  put(kOld);
  {
    FileSet set(dir_, kNames);
    add_new(set);
  }
  EXPECT_EQ(present(), kOld);
  { FileSet set(dir_ / "deep" / "deeper", kNames); }
  EXPECT_EQ(present(), kOld);
}

TEST_F(FileSetTest, AFailureAtAnyFilePutsEverythingBack) {
  for (const char* failing : {"rows", "figure", "seal"}) {
    for (const Files& before : {kOld, Files{}, Files{{"figure", "alone"}}}) {
      fs::remove_all(dir_);
      fs::create_directory(dir_);
      put(before);
      {
        FileSet set(dir_, kNames);
        add_new(set);
        for (const auto& written : FileSet::temporaries(dir_, failing)) fs::remove(written);  // its renaming will fail
        EXPECT_THROW(set.commit(), WriteError) << failing;
        EXPECT_EQ(present().count("seal"), before.count("seal"));
      }
      EXPECT_EQ(present(), before) << failing;
    }
  }
}

TEST_F(FileSetTest, AProducerThatThrowsLeavesNothing) {
  put(kOld);
  try {
    FileSet set(dir_, kNames);
    set.add("rows", [](const FileSet::Sink& sink) {
      sink("half a ");
      throw std::bad_alloc();
    });
    FAIL();
  } catch (const std::bad_alloc&) {
  }
  EXPECT_EQ(present(), kOld);
}

TEST_F(FileSetTest, WhatAKilledRunLeftIsRemoved) {
  put(kOld);
  put({{".rows.77-0.tmp", "half"}, {".seal.77-1.tmp", "half"}, {".rows.mine.tmp", "mine"}, {".other.77-0.tmp", "mine"}});
  FileSet set(dir_, kNames);
  add_new(set);
  set.commit();
  EXPECT_EQ(present(), (Files{{"rows", "new rows"},
                              {"figure", "new figure"},
                              {"seal", "new seal"},
                              {".rows.mine.tmp", "mine"},
                              {".other.77-0.tmp", "mine"}}));
}

TEST_F(FileSetTest, LinksAreReplacedAndNotFollowed) {
  put(kOld);
  put({{"elsewhere", "precious"}});
  for (const char* name : {"rows", "seal"}) {
    fs::remove(dir_ / name);
    fs::create_symlink("elsewhere", dir_ / name);
  }
  fs::remove(dir_ / "figure");
  fs::create_symlink("nowhere", dir_ / "figure");
  FileSet set(dir_, kNames);
  add_new(set);
  set.commit();
  EXPECT_EQ(present(),
            (Files{{"rows", "new rows"}, {"figure", "new figure"}, {"seal", "new seal"}, {"elsewhere", "precious"}}));
  for (const char* name : {"rows", "figure", "seal"}) EXPECT_TRUE(fs::is_regular_file(fs::symlink_status(dir_ / name)));
}

TEST_F(FileSetTest, DiscardedTemporariesAreGone) {
  put(kOld);
  FileSet set(dir_, kNames);
  add_new(set);
  EXPECT_EQ(present().size(), kOld.size() + 3);
  EXPECT_TRUE(discard_temporaries());
  EXPECT_EQ(present(), kOld);
}

TEST_F(FileSetTest, AnotherWriterIsWaitedFor) {
  const int other = ::open(dir_.c_str(), O_RDONLY | O_DIRECTORY);
  ASSERT_EQ(::flock(other, LOCK_EX), 0);
  int from_child[2];
  ASSERT_EQ(::pipe2(from_child, O_NONBLOCK), 0);
  const pid_t child = ::fork();
  if (child == 0) {  // holds the lock, too, until it ends, and says so before it does
    ::usleep(100'000);
    const ssize_t told = ::write(from_child[1], "x", 1);
    ::_exit(told == 1 ? 0 : 1);
  }
  ::close(other);
  { FileSet set(dir_, kNames); }
  char byte = 0;
  EXPECT_EQ(::read(from_child[0], &byte, 1), 1) << "the set was made while the other one held the lock";
  ::waitpid(child, nullptr, 0);
  ::close(from_child[0]);
  ::close(from_child[1]);
}

TEST_F(FileSetTest, AWriterThatDoesNotEndIsNotWaitedForWithoutEnd) {
  put(kOld);
  const int other = ::open(dir_.c_str(), O_RDONLY | O_DIRECTORY);
  ASSERT_EQ(::flock(other, LOCK_EX), 0);
  try {
    FileSet set(dir_, kNames, {}, std::chrono::seconds(0));
    ADD_FAILURE() << "the directory is taken";
  } catch (const WriteError& error) {
    EXPECT_NE(std::string(error.what()).find("another run has been writing there for 0 s; wait until it has ended, or choose"),
              std::string::npos)
        << error.what();
  }
  EXPECT_EQ(present(), kOld);
  ::close(other);
  EXPECT_NO_THROW(FileSet(dir_, kNames, {}, std::chrono::seconds(0))) << "it has ended";
}

}  // namespace
}  // namespace earthtop
