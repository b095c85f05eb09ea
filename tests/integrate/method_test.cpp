// SPDX-License-Identifier: GPL-3.0-or-later
// The table of methods: each has one row, whose places are all different, and the manual's table of what they are worth is made of
// these rows.
#include "earthtop/integrate/method.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <set>
#include <string>

namespace earthtop {
namespace {

TEST(Methods, EachHasOneRowAndItsOwnWordPlaceAndLook) {
  std::set<Method> methods;
  std::set<std::string_view> words, looks;
  for (const MethodRow& row : kMethodRows) {
    EXPECT_TRUE(methods.insert(row.method).second) << row.word;
    EXPECT_TRUE(words.insert(row.word).second) << row.word;
    if (row.method != Method::automatic) {
      EXPECT_TRUE(looks.insert(row.look).second) << row.word;
    }
    EXPECT_FALSE(row.worth.empty()) << row.word;
    EXPECT_EQ(&row_of(row.method), &row);
  }
  EXPECT_EQ(methods.size(), kMethodCount);
  for (const auto place : {&MethodRow::place_in_menus, &MethodRow::place_in_bench}) {
    const auto ordered = methods_by(place);
    EXPECT_EQ(std::set<Method>(ordered.begin(), ordered.end()).size(), kMethodCount);
    EXPECT_EQ(ordered.front(), Method::automatic);
  }
}

TEST(Methods, AreOfferedByTheWordsOfTheirRows) {
  EXPECT_EQ(
      kMethodWords,
      "auto|taylor|dopri5|rkf78|bulirsch_stoer|extrapolation|abm8|dop853|gauss|splitting|long_horizon|closed_form|fourier");
  EXPECT_TRUE(is_built(Method::bulirsch_stoer, Precision::bits64));
  EXPECT_FALSE(is_built(Method::bulirsch_stoer, Precision::bits113));
  EXPECT_TRUE(is_exact(Method::closed_form));
  EXPECT_FALSE(is_exact(Method::abm8));
}

TEST(Methods, TheManualSaysWhatEachIsWorth) {
  std::string table = "| method | what you would lose without it |\n| --- | --- |\n";
  for (const Method method : methods_by(&MethodRow::place_in_bench))
    table += "| `" + std::string(to_string(method)) + "` | " + std::string(row_of(method).worth) + " |\n";
  std::ifstream file(std::string(EARTHTOP_TESTS) + "/../include/earthtop/README.md");
  const std::string readme{std::istreambuf_iterator<char>(file), {}};
  EXPECT_NE(readme.find("\n" + table), std::string::npos) << "The table of methods in include/earthtop/README.md should be\n"
                                                          << table;
}

}  // namespace
}  // namespace earthtop
