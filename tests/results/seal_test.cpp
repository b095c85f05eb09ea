// SPDX-License-Identifier: GPL-3.0-or-later
// Checksums of result files: no flipped bit is believed.
#include "results/seal.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "earthtop/compare/compare.hpp"
#include "earthtop/error.hpp"
#include "earthtop/report/report.hpp"
#include "earthtop/results/results.hpp"
#include "results/made_up_run.hpp"
#include "support/json.hpp"
#include "support/temporary_directory.hpp"
#include "text/checksum.hpp"

namespace earthtop {
namespace {

namespace fs = std::filesystem;

// The reference values of xxHash for XXH3 with 64 bits and seed 0: of nothing, and of "abc" [xxHash 0.8.1, xxhsum -H3].
TEST(Checksum, IsXxh3) {
  EXPECT_EQ(checksum_text(checksum_of("")), "2d06800538d394c2");
  EXPECT_EQ(checksum_text(checksum_of("abc")), "78af5f94892f3950");
  Checksum pieces;
  pieces.add("a");
  pieces.add("");
  pieces.add("bc");
  EXPECT_EQ(pieces.value(), checksum_of("abc"));
}

TEST(SealOfADocument, IsBrokenByEveryFlippedBit) {
  const std::string document = sealed("{\n  \"a\": 1\n}\n", {{"b.csv", "0011223344556677"}});
  const auto parsed = testing::parse_json(document);
  EXPECT_EQ(parsed.at("a"), 1);
  EXPECT_EQ(parsed.at("files").at("b.csv"), "0011223344556677");
  EXPECT_EQ(seal_of(document), Seal::fits);
  for (const std::string& text : {document, sealed("{\n  \"a\": 1\n}\n")})
    for (std::size_t bit = 0; bit < 8 * text.size(); ++bit) {
      std::string damaged = text;
      damaged[bit / 8] = static_cast<char>(damaged[bit / 8] ^ (1 << bit % 8));
      EXPECT_EQ(seal_of(damaged), Seal::broken) << bit;
    }
  EXPECT_EQ(seal_of("{\n  \"a\": 1\n}\n"), Seal::absent);
  EXPECT_EQ(seal_of(""), Seal::absent);
}

class Damage : public ::testing::Test {
 protected:
  static std::string read(const fs::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  }
  static void put(const fs::path& path, const std::string& text) { std::ofstream(path, std::ios::binary) << text; }
  testing::TemporaryDirectory temporary_;
  const fs::path dir_ = temporary_.path() / "results";
};

TEST_F(Damage, OfAnyFileIsNamedByReportAndCompare) {
  write_results(test::made_up_run_with_ledger(), dir_, false);
  for (const char* name : {"trajectory.csv", "torques.csv", "drift.svg", "timing.json", "summary.json"}) {
    const fs::path file = dir_ / name;
    const std::string good = read(file);
    for (std::size_t k = 0; k < 40; ++k) {
      std::string bad = good;
      const std::size_t at = (k * 7919 + 13) % good.size();
      if (k % 4 == 0)
        bad.resize(at);
      else
        bad[at] = static_cast<char>(bad[at] ^ (1 << k % 7));
      put(file, bad);
      try {
        make_report(dir_);
        ADD_FAILURE() << name << " with another byte " << at << " is reported";
      } catch (const ScenarioError& error) {
        EXPECT_NE(error.file().find(name), std::string::npos) << error.what();
      }
      bool is_refused = false;
      try {
        is_refused = compare_results(dir_, dir_, {}).refused();
      } catch (const ScenarioError&) {
        is_refused = true;
      }
      EXPECT_TRUE(is_refused) << name << " " << at;
    }
    put(file, good);
  }
  EXPECT_NO_THROW(make_report(dir_));
}

TEST_F(Damage, IsNotSoughtInResultsWithoutChecksums) {
  write_results(test::made_up_run(), dir_, false);
  put(dir_ / "summary.json", summary_json(test::made_up_run()));
  EXPECT_FALSE(check_result_files(dir_, read(dir_ / "summary.json")));
  EXPECT_NO_THROW(make_report(dir_));
}

}  // namespace
}  // namespace earthtop
