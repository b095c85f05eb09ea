// SPDX-License-Identifier: GPL-3.0-or-later
// The changes that the fuzzer makes of an input keep its kind: readers see more of it than that it is damaged.
#include "fuzz/mutation.hpp"

#include <gtest/gtest.h>

#include <set>

#include "earthtop/report/report.hpp"
#include "earthtop/results/results.hpp"
#include "earthtop/study/run_study.hpp"
#include "fuzz/door.hpp"
#include "fuzz/fixture.hpp"
#include "fuzz/properties.hpp"
#include "results/seal.hpp"

namespace earthtop::fuzz {
namespace {

constexpr std::uint32_t kTried = 200;

/// How many of the changes of an input are so.
template <class IsSo>
std::uint32_t count_changed(std::string (*mutated)(std::string_view, std::uint32_t), const std::string& input,
                            const IsSo& is_so) {
  std::uint32_t count = 0;
  for (std::uint32_t seed = 0; seed < kTried; ++seed)
    if (const std::string changed = mutated(input, seed); changed != input && is_so(changed)) ++count;
  return count;
}

TEST(Mutations, AreTheSameForTheSameSeedAndOthersForOthers) {
  for (const Door& each : doors()) {
    const std::string input = each.seeds().front();
    std::set<std::string> all;
    for (std::uint32_t seed = 0; seed < 20; ++seed) {
      const std::string changed = each.mutated(input, seed);
      EXPECT_EQ(changed, each.mutated(input, seed)) << each.name;
      all.insert(changed);
    }
    EXPECT_GE(all.size(), 10U) << each.name;
  }
}

TEST(Mutations, OfResultsAreReadWithAndWithoutChecksums) {
  const auto reads = [](Seal seal) {
    return [seal](const std::string& input) {
      const ResultFiles files = result_files_in(input);
      const auto directory = Scratch::empty();
      put(files, directory);
      return seal_of(files.summary) == seal && accepts([&] { read_result_texts(directory); });
    };
  };
  const std::string input = input_of(with_checksums(Fixture::get().result_files()));
  EXPECT_GE(count_changed(mutated_results, input, reads(Seal::fits)), kTried / 5);
  EXPECT_GE(count_changed(mutated_results, input, reads(Seal::absent)), kTried / 5);
}

TEST(Mutations, OfStoresAreReadWithAndWithoutChecksums) {
  const auto reads = [](bool has_checksums) {
    return [has_checksums](const std::string& input) {
      const auto file = Scratch::empty() / "study.sqlite";
      Scratch::write("study.sqlite", input);
      bool is_so = false;
      return accepts([&] {
               const StudyStoreCheck check = check_study_store(file);
               is_so = check.damage.empty() && check.has_checksums == has_checksums;
               study_json(file);
             }) &&
             is_so;
    };
  };
  const std::string input = content_of(Fixture::get().store());
  EXPECT_GE(count_changed(mutated_store, input, reads(true)), kTried / 5);
  EXPECT_GE(count_changed(mutated_store, input, reads(false)), kTried / 20);
}

TEST(Mutations, DamageStoresSoThatARepairHasWorkToDo) {
  const auto is_damaged = [](const std::string& input) {
    const auto file = Scratch::empty() / "study.sqlite";
    Scratch::write("study.sqlite", input);
    bool is_so = true;
    return !accepts([&] { is_so = !check_study_store(file).damage.empty(); }) || is_so;
  };
  EXPECT_GE(count_changed(damaged_store, content_of(Fixture::get().store()), is_damaged), kTried / 3);
}

TEST(Mutations, OfPageTextsNeverRefuseTheInput) {
  const std::string input = "Fx\x01y";
  std::set<char> documents;
  EXPECT_GE(count_changed(mutated_page_text, input,
                          [&](const std::string& changed) {
                            documents.insert(changed.front());
                            return parts_of(changed).size() >= 2;
                          }),
            kTried * 3 / 4);
  EXPECT_GE(documents.size(), 7U);
}

}  // namespace
}  // namespace earthtop::fuzz
