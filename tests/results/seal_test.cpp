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

// A document that somebody wrote anew, before it was read and copied.
TEST(SealOfADocument, KeepsADocumentOfAnyLayout) {
  for (const char* text : {"{\"a\": {\"b\": 1}}", "{\"a\": {\"b\": 1} } \n", "{\n  \"a\": {\n    \"b\": 1\n  }\n}\n"})
    for (const std::string& document : {sealed(text), sealed(text, {{"b.csv", "0011223344556677"}})}) {
      EXPECT_EQ(seal_of(document), Seal::fits) << document;
      EXPECT_EQ(testing::parse_json(unsealed(document)), testing::parse_json(text)) << document;
    }
  EXPECT_EQ(sealed("{}\n"), "{}\n");
  EXPECT_EQ(sealed("{}\n", {{"b.csv", "0011223344556677"}}), "{}\n");
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

TEST_F(Damage, SaysWhichFileIsMissingOrWrong) {
  const auto refusal = [&] {
    try {
      read_result_texts(dir_);
      return std::string("accepted");
    } catch (const ScenarioError& error) {
      return std::string(error.what());
    }
  };
  write_results(test::made_up_run(), dir_, false);
  put(dir_ / "summary.json", summary_json(test::made_up_run()));  // without checksums
  const std::string good = read(dir_ / "trajectory.csv");
  EXPECT_EQ(refusal(), "accepted");
  put(dir_ / "trajectory.csv", std::string(good).replace(0, 3, "\"t_s\""));
  EXPECT_NE(refusal().find("has quotation marks, which no table of results has; run the scenario again"), std::string::npos);
  put(dir_ / "trajectory.csv", std::string(good).replace(0, 3, "t_z"));
  EXPECT_NE(refusal().find("has no column t_s; run the scenario again"), std::string::npos) << refusal();
  fs::remove(dir_ / "trajectory.csv");
  EXPECT_NE(refusal().find("holds no results: it has no trajectory.csv"), std::string::npos);
}

/// Files without checksums are read by `read_result_texts` as strictly as those with.
TEST_F(Damage, IsSeenByTheFormatWhereThereAreNoChecksums) {
  write_results(test::made_up_run_with_ledger(), dir_, false);
  put(dir_ / "summary.json", summary_json(test::made_up_run_with_ledger()));
  put(dir_ / "timing.json", timing_json(test::made_up_run_with_ledger()));
  EXPECT_EQ(read_result_texts(dir_).size(), 5U);
  const auto changed = [](std::string text, std::string_view old, std::string_view now) {
    return text.replace(text.find(old), old.size(), now);
  };
  for (const char* name : {"summary.json", "timing.json", "trajectory.csv", "torques.csv"}) {
    const fs::path file = dir_ / name;
    const std::string good = read(file);
    const bool is_table = file.extension() == ".csv";
    std::vector<std::string> kinds = {"", good + std::string(1, '\0'), good + "more\n", good + good,
                                      good.substr(0, good.size() / 2)};
    if (is_table)
      for (const std::string_view now : {"t_z", "t_s,t_s", "# note\nt_s", "\"t_s\""})
        kinds.push_back(changed(good, "t_s", now));
    if (is_table)
      for (const std::string_view now : {"\nword,", "\n0x1,", "\n1 1,"}) kinds.push_back(changed(good, "\n0,", now));
    if (!is_table) kinds.push_back(changed(good, "{", "{\"$schema\": 1,\"$schema\": 1,"));
    for (const std::string& bad : kinds) {
      put(file, bad);
      try {
        read_result_texts(dir_);
        ADD_FAILURE() << name << " is accepted: " << bad.substr(0, 100);
      } catch (const ScenarioError& error) {
        EXPECT_NE(error.file().find(name), std::string::npos) << error.what();
      }
    }
    put(file, "\xEF\xBB\xBF" + good);
    EXPECT_NO_THROW(read_result_texts(dir_)) << name;
    put(file, good);
  }
}

/// A timing.json of another run is told apart by the checksum of the summary, whoever reads it.
TEST_F(Damage, IsATimingOfAnotherResult) {
  constexpr const char* kWords =
      "timing.json: error: belongs to another result than the summary.json beside it; remove it, or run the scenario again";
  const fs::path other = temporary_.path() / "other";
  write_results(test::made_up_run(), dir_, false);
  write_results(test::made_up_run_with_ledger(), other, false);
  const std::string good = read(dir_ / "timing.json");
  const auto refusal = [&](const auto& reader) {
    try {
      reader();
      return std::string("accepted");
    } catch (const ScenarioError& error) {
      return std::string(error.what());
    }
  };
  const auto texts = [&] { read_result_texts(dir_); };
  const auto page = [&] { make_report(dir_); };
  const auto comparison = [&] { compare_results(dir_, dir_, {}); };
  for (const auto& found : {refusal(texts), refusal(page), refusal(comparison)}) EXPECT_EQ(found, "accepted");
  put(dir_ / "timing.json", read(other / "timing.json"));
  for (const auto& found : {refusal(texts), refusal(page), refusal(comparison)})
    EXPECT_NE(found.find(kWords), std::string::npos) << found;
  put(dir_ / "timing.json", sealed(unsealed(good)));  // as an older version wrote it: it names no summary
  for (const auto& found : {refusal(texts), refusal(page), refusal(comparison)}) EXPECT_EQ(found, "accepted");
  put(dir_ / "timing.json", read(other / "timing.json"));
  put(dir_ / "summary.json", summary_json(test::made_up_run()));  // edited, perhaps: nothing is known
  for (const auto& found : {refusal(texts), refusal(page), refusal(comparison)}) EXPECT_EQ(found, "accepted");
}

TEST_F(Damage, ThatWouldGoUnnoticedIsNoted) {
  const auto notes = [&] {
    const Report page = make_report(dir_);
    std::vector<std::string> found;
    read_result_texts(dir_, &found);
    EXPECT_EQ(found, page.notes);
    EXPECT_EQ(page.html.find("<p class=\"note\">Note: ") != std::string::npos, !found.empty());
    return found;
  };
  const std::string words = " has no checksums: damage to it would go unnoticed";
  write_results(test::made_up_run(), dir_, false);
  const std::string good = read(dir_ / "summary.json");
  EXPECT_TRUE(notes().empty());
  put(dir_ / "timing.json", timing_json(test::made_up_run()));
  EXPECT_EQ(notes(), std::vector<std::string>{(dir_ / "timing.json").string() + words});
  put(dir_ / "summary.json", summary_json(test::made_up_run()));
  EXPECT_EQ(notes(), std::vector<std::string>{dir_.string() + words});
}

TEST(SealOfADocument, IsRenewedAfterAChange) {
  const std::string document = sealed_document({{"a", "\u202e"}, {"b", 0.1}});
  EXPECT_EQ(seal_of(document), Seal::fits);
  EXPECT_NE(document.find("\\u202e"), std::string::npos) << "what is invisible is written as an escape";
  std::string changed = document;
  changed.replace(changed.find("0.1"), 3, "0.2");
  EXPECT_EQ(seal_of(changed), Seal::broken);
  EXPECT_EQ(seal_of(resealed(changed)), Seal::fits);
  EXPECT_EQ(resealed(document), document);
  EXPECT_EQ(seal_of(resealed("{\"a\": 1}")), Seal::fits);
  EXPECT_EQ(resealed("{}"), "{}");
}

TEST_F(Damage, OfTheListOfFilesReadsNoOthers) {
  for (const char* files :
       {R"({"/dev/zero": "0"})", R"({"../results/drift.svg": "0"})", R"({"": "0"})", R"({"drift.svg": 1})", "[]"})
    EXPECT_THROW(checksums_in(std::string("{\"files\": ") + files + "}", "summary.json"), ScenarioError) << files;
  EXPECT_EQ(checksums_in(R"({"files": {"drift.svg": "0"}})", "summary.json").size(), 1U);
  EXPECT_TRUE(checksums_in("{}", "summary.json").empty());
}

}  // namespace
}  // namespace earthtop
