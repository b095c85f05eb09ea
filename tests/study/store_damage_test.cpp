// SPDX-License-Identifier: GPL-3.0-or-later
// Damaged stores: nothing of them is believed, what is intact is kept, and --repair computes the rest again.
#include <gtest/gtest.h>

#include <fstream>
#include <random>

#include "earthtop/compare/compare.hpp"
#include "earthtop/error.hpp"
#include "earthtop/report/report.hpp"
#include "earthtop/study/run_study.hpp"
#include "study/sqlite.hpp"
#include "support/json.hpp"
#include "support/temporary_directory.hpp"

namespace earthtop {
namespace {

namespace fs = std::filesystem;

class StoreDamage : public ::testing::Test {
 protected:
  StoreDamage() { run_study(study_, options_); }

  static std::string read(const fs::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  }
  void put(const std::string& bytes) const { std::ofstream(store_, std::ios::binary) << bytes; }
  std::string csv() const {
    std::string text;
    study_csv(store_, [&](std::string_view piece) { text += piece; });
    return text;
  }
  void execute(const char* sql) const {
    study::sqlite::Connection(store_.string(), study::sqlite::Connection::Mode::write).execute(sql);
  }

  testing::TemporaryDirectory directory_;
  const Study study_ = parse_study({"small.json", R"({"base": ")" + std::string(EARTHTOP_SCENARIOS) + R"(/toy-top.json",
    "set": {"/motion/duration_s": 0.2}, "collect": ["drift.axis_final_rad", "drift.verdict"],
    "axes": [{"pointer": "/site/latitude_deg", "range": {"from": -90, "to": 90, "points": 20}}]})"});
  StudyRunOptions options_ = [&] {
    StudyRunOptions options;
    options.dir = directory_.path();
    options.jobs = 1;
    return options;
  }();
  const fs::path store_ = study_store(directory_.path());
};

TEST_F(StoreDamage, IsNeverBelieved) {
  const std::string good = read(store_), expected = csv();
  std::mt19937 random(11);
  int noticed = 0;
  for (int k = 0; k < 120; ++k) {
    std::string bad = good;
    const std::size_t bit = random() % (8 * bad.size());
    if (k % 3 == 0)
      bad.resize(bit / 8);
    else if (k % 3 == 1)
      bad.append(1 + bit % 5000, '\0');
    else
      bad[bit / 8] = static_cast<char>(bad[bit / 8] ^ (1 << bit % 8));
    put(bad);
    std::string table;
    bool is_damaged = false;
    try {
      is_damaged = !check_study_store(store_).damage.empty();
      table = csv();
    } catch (const std::runtime_error&) {
      is_damaged = true;
    }
    EXPECT_TRUE(is_damaged || table == expected) << k << " at bit " << bit;
    noticed += is_damaged;
  }
  EXPECT_GT(noticed, 80);
}

TEST_F(StoreDamage, NamesThePointsAndKeepsTheOthers) {
  const std::string expected = csv();
  execute("UPDATE point SET \"drift.axis_final_rad\" = 1 WHERE number = 5");
  execute("UPDATE point SET status = 'refused' WHERE number = 7");
  execute("DELETE FROM point WHERE number = 9");
  const std::string damage = check_study_store(store_).damage;
  EXPECT_NE(damage.find("of 20 points 2 (5, 7) are not what was stored, and 1 points are missing"), damage.npos) << damage;
  EXPECT_NE(damage.find("--repair"), damage.npos);
  const std::string left = csv();
  EXPECT_EQ(std::count(left.begin(), left.end(), '\n'), 18);
  EXPECT_EQ(left.find("\n5,"), left.npos);
  EXPECT_LT(testing::parse_json(study_json(store_)).at("statistics").at("drift.axis_final_rad").at("quantile_95").get<double>(),
            0.5);

  EXPECT_THROW(run_study(study_, options_), ScenarioError);
  EXPECT_THROW(make_report(directory_.path()), ScenarioError);
  EXPECT_THROW(merge_study_stores({store_}, directory_.path() / "merged", false), ScenarioError);
  EXPECT_TRUE([&] {
    try {
      return compare_results(store_, store_, {}).refused();
    } catch (const ScenarioError&) {
      return true;
    }
  }());
  EXPECT_EQ(csv(), left) << "nothing has been changed";

  options_.repair = true;
  const StudyRunReport report = run_study(study_, options_);
  EXPECT_EQ(report.progress.done, 3U);
  EXPECT_EQ(report.progress.before, 17U);
  EXPECT_FALSE(report.damage.empty());
  EXPECT_EQ(csv(), expected);
  EXPECT_TRUE(check_study_store(store_).damage.empty());
}

TEST_F(StoreDamage, IsRepairedAlsoWhereTheFileIs) {
  const std::string good = read(store_), expected = csv();
  options_.repair = true;
  std::mt19937 random(12);
  for (int k = 0; k < 12; ++k) {
    std::string bad = good;
    const std::size_t at = random() % bad.size();
    if (k % 2 == 0)
      bad.resize(at);
    else
      bad.replace(at, 200, std::string(std::min<std::size_t>(200, bad.size() - at), 'x'));
    put(bad);
    run_study(study_, options_);
    EXPECT_EQ(csv(), expected) << k << " from byte " << at;
  }
}

TEST_F(StoreDamage, IsSeenInAHeadThatForbidsWriting) {
  const std::string expected = csv();
  std::string bad = read(store_);
  constexpr std::size_t kWriteVersion = 18;  // SQLite writes to no file whose number here is not 1 or 2
  bad[kWriteVersion] = '\x4b';
  put(bad);
  const std::string words = "its head says that nothing may be written to it";
  EXPECT_NE(check_study_store(store_).damage.find(words), std::string::npos) << check_study_store(store_).damage;
  try {
    run_study(study_, options_);
    FAIL() << "the store was written to";
  } catch (const ScenarioError& error) {
    EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
  }
  options_.repair = true;
  EXPECT_EQ(run_study(study_, options_).progress.done, 0U) << "the points themselves are intact";
  EXPECT_EQ(csv(), expected);
}

TEST_F(StoreDamage, IsSeenInAPointThatItsStudyHasNot) {
  const auto damage = [&] { return check_study_store(store_).damage; };
  execute("ALTER TABLE point DROP COLUMN row_checksum");
  execute("DELETE FROM study WHERE key IN ('facts_checksum', 'contents')");
  ASSERT_EQ(damage(), "");
  for (const char* number : {"-1", "20", "9223372036854775807"}) {
    execute((std::string("UPDATE point SET number = ") + number + " WHERE number NOT BETWEEN 0 AND 18").c_str());
    EXPECT_NE(damage().find(std::string("it has a point numbered ") + number + ", but its study has the points 0 to 19"),
              std::string::npos)
        << damage();
    EXPECT_THROW(make_report(directory_.path()), ScenarioError);
  }
}

TEST_F(StoreDamage, PointsOfAnotherStudyAreNotTakenForThisOnes) {
  execute("UPDATE study SET value = replace(value, '0.2', '0.3') WHERE key = 'study'");
  EXPECT_THROW(check_study_store(store_), ScenarioError);
  options_.repair = true;
  EXPECT_EQ(run_study(study_, options_).progress.done, 0U) << "the points themselves are intact";
}

TEST_F(StoreDamage, WithTheNameOfAnotherStudyIsNeitherReplacedNorTakenForAFullDisk) {
  execute("ALTER TABLE point DROP COLUMN row_checksum");
  execute("DELETE FROM study WHERE key IN ('facts_checksum', 'contents')");
  const auto number = [&](const char* sql) {
    study::sqlite::Connection connection(store_.string(), study::sqlite::Connection::Mode::read);
    study::sqlite::Statement statement(connection, sql);
    statement.step();
    return static_cast<std::size_t>(statement.integer(0));
  };
  const std::size_t size = number("PRAGMA page_size"), page = number("SELECT rootpage FROM sqlite_master WHERE name = 'point'");
  std::string own = read(store_);
  own.replace((page - 1) * size, size, size, 'x');
  for (const bool other : {false, true}) {
    put(own);
    if (other) execute("UPDATE study SET value = 'another' WHERE key = 'sha256'");
    for (const bool repair : {false, true}) {
      if (repair && !other) continue;  // which mends it
      options_.repair = repair;
      try {
        run_study(study_, options_);
        ADD_FAILURE() << "accepted";
      } catch (const ScenarioError& error) {
        const std::string& message = error.diagnostics().front().message;
        EXPECT_NE(message.find(other ? "--force" : "--repair"), message.npos) << message;
      }
      EXPECT_NE(read(store_).find(std::string(size, 'x')), std::string::npos) << "the file is as it was";
    }
  }
  options_.force = true;
  options_.repair = false;
  EXPECT_EQ(run_study(study_, options_).failed, 0U);
}

TEST_F(StoreDamage, OfAStoreWithoutChecksumsIsNotKnown) {
  execute("ALTER TABLE point DROP COLUMN row_checksum");
  execute("DELETE FROM study WHERE key IN ('facts_checksum', 'contents')");
  const StudyStoreCheck check = check_study_store(store_);
  EXPECT_FALSE(check.has_checksums);
  EXPECT_TRUE(check.damage.empty());
  execute("DELETE FROM point WHERE number = 9");
  const StudyRunReport report = run_study(study_, options_);
  EXPECT_EQ(report.progress.done, 1U);
  EXPECT_FALSE(report.has_checksums);
}

TEST_F(StoreDamage, MergeRefusesPointsOfAnIdentityThatTheDescriptionDoesNotGive) {
  const fs::path merged = directory_.path() / "merged";
  EXPECT_EQ(merge_study_stores({store_}, merged, false), 20U);
  fs::remove_all(merged);
  execute("ALTER TABLE point DROP COLUMN row_checksum");
  execute("DELETE FROM study WHERE key IN ('facts_checksum', 'contents')");
  execute("UPDATE study SET value = 'of an older version' WHERE key = 'sha256'");
  try {
    merge_study_stores({store_}, merged, false);
    FAIL() << "nothing was refused";
  } catch (const ScenarioError& error) {
    const std::string& message = error.diagnostics().front().message;
    EXPECT_NE(message.find("merge it with the version that computed it"), std::string::npos) << message;
  }
  EXPECT_FALSE(fs::exists(merged));
}

}  // namespace
}  // namespace earthtop
