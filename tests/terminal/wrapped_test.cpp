// SPDX-License-Identifier: GPL-3.0-or-later
/// Tests of prose in lines, and of their width.
#include "wrapped.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "screen.hpp"

namespace earthtop::tool {
namespace {

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines(1);
  for (const char c : text) c == '\n' ? void(lines.emplace_back()) : void(lines.back() += c);
  return lines;
}

/// The words of a text, with one space between them.
std::string words_of(std::string_view text) {
  std::string words;
  for (const char c : text)
    if (c != ' ' && c != '\n')
      words += c;
    else if (!words.empty() && words.back() != ' ')
      words += ' ';
  return words;
}

constexpr std::string_view kProse =
    "In the 60 s of this run the Earth turns by 902.46″: to an observer in the laboratory a Coriolis torque acts on the spin, "
    "5.39e-07 ± 2.1e-12 N m at most, and the precession is slower by 5.25339e-05 rad/s; the cone leans by 2.9″ to the South.";

TEST(Wrapped, EveryLineFitsAndNoWordIsLost) {
  for (const std::size_t hanging : {0U, 4U, 12U, 19U})
    for (std::size_t width = 40; width <= 120; ++width) {
      const std::string text = wrapped(kProse, width, hanging);
      const auto lines = lines_of(text);
      for (const std::string& line : lines) EXPECT_LE(columns_of(line), width) << line;
      EXPECT_EQ(words_of(text), kProse) << width;
      const std::size_t indent = hanging + 24 <= width ? hanging : 4;
      for (std::size_t i = 1; i < lines.size(); ++i) EXPECT_EQ(lines[i].find_first_not_of(' '), indent) << width << lines[i];
      for (std::size_t i = 0; i + 1 < lines.size(); ++i)  // the next piece had no room; the longest has 23 columns
        EXPECT_GT(columns_of(lines[i]) + 1 + 23, width) << lines[i];
    }
}

TEST(Wrapped, ALineThatFitsStaysAsItIs) {
  EXPECT_EQ(wrapped("  two  columns   are kept", 40), "  two  columns   are kept");
  EXPECT_EQ(wrapped("exactly", 7), "exactly");
  EXPECT_EQ(wrapped("exactly so", 9), "exactly\nso");
  EXPECT_EQ(wrapped("", 40), "");
}

TEST(Wrapped, ALongWordIsNotBroken) {
  const std::string path = "out/" + std::string(60, 'x');
  EXPECT_EQ(wrapped("in " + path + " there", 40, 2), "in\n  " + path + "\n  there");
  EXPECT_EQ(wrapped(path, 40), path);
}

TEST(Wrapped, ANumberStaysWithItsErrorAndUnit) {
  EXPECT_EQ(wrapped("it turns within 3.5 ± 0.1 s or so", 22), "it turns within\n3.5 ± 0.1 s or so");
  EXPECT_EQ(wrapped("it turns within 60 s", 18), "it turns within\n60 s");
  EXPECT_EQ(wrapped("up to -1.5e-07 rad", 14), "up to\n-1.5e-07 rad");
  EXPECT_EQ(wrapped("gravity's 0.0113 N m.", 18), "gravity's\n0.0113 N m.");
  EXPECT_EQ(wrapped("a body of 0.1 kg more", 17), "a body of 0.1 kg\nmore");
  EXPECT_EQ(wrapped("step 7b of it", 8), "step 7b\nof it");
}

TEST(Wrapped, ColumnsAreThoseOfTheTerminal) {
  EXPECT_EQ(columns_of("45° ± 2″"), 8U);
  EXPECT_EQ(columns_of("\x1b[33mwarn\x1b[0ming"), 7U);
  EXPECT_EQ(wrapped("\x1b[1m±±±±\x1b[0m ±±±±", 9), "\x1b[1m±±±±\x1b[0m ±±±±");
}

TEST(Wrapped, AnEntryHangsBelowItsText) {
  EXPECT_EQ(wrapped_entry("Why", "the Earth turns below the top all the time", 40, 12),
            "Why         the Earth turns below the\n            top all the time\n");
  EXPECT_EQ(wrapped_entry("", "more", 40, 4), "    more\n");
  EXPECT_EQ(wrapped_entry("a label too long", "text", 40, 6), "a label too long\n      text\n");
}

TEST(Screen, TheVariableComesFirstAndTheTerminalNext) {
  EXPECT_EQ(prose_width(nullptr, 0), 80U);
  EXPECT_EQ(prose_width(nullptr, 100), 100U);
  EXPECT_EQ(prose_width("60", 100), 60U);
  EXPECT_EQ(prose_width(nullptr, 20), 40U);
  EXPECT_EQ(prose_width(nullptr, 200), 120U);
  EXPECT_EQ(prose_width("1", 100), 40U);
  EXPECT_EQ(prose_width("100000", 100), 120U);
  for (const char* invalid : {"", "0", "-60", "wide", "60 ", "6e1", "99999999999999999999999"})
    EXPECT_EQ(prose_width(invalid, 100), 100U) << invalid;
  EXPECT_EQ(prose_width("wide", 0), 80U);
}

}  // namespace
}  // namespace earthtop::tool
