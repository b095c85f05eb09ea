// SPDX-License-Identifier: GPL-3.0-or-later
// The reader of the program's own documents, the headers of tables, and the length of messages.
#include "input/document.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <new>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <system_error>

#include "earthtop/arithmetic.hpp"
#include "earthtop/error.hpp"
#include "input/csv_reader.hpp"
#include "input/findings.hpp"
#include "input/node.hpp"
#include "text/json.hpp"

namespace earthtop::input {
namespace {

using namespace std::string_literals;

constexpr DocumentKind kKind = {"summary"};

/// All that is wrong with a document, a line each.
std::string refusal_of(const std::string& text, const DocumentKind& kind = kKind) {
  try {
    read_document(text, "summary.json", kind);
  } catch (const ScenarioError& error) {
    return error.what();
  }
  return "accepted";
}

void expect_refused(const std::string& text, const std::string& line) {
  const std::string said = refusal_of(text);
  EXPECT_NE(said.find(line), std::string::npos) << said << "\n" << line;
}

std::string repeated(const std::string& unit, std::size_t times) {
  std::string text;
  for (std::size_t i = 0; i < times; ++i) text += unit;
  return text;
}

TEST(Document, IsReadAsItIsWritten) {
  const std::string text = R"({"a": [1, -2, 0.5, true, null, "\u00e9", {}, []], "z": {"y": {"x": 1}, "b": [[2]]}, "_a": 3})";
  EXPECT_EQ(read_document(text, "summary.json", kKind), nlohmann::ordered_json::parse(text));
  EXPECT_EQ(written(read_document("\xEF\xBB\xBF" + text + " \n", "summary.json", kKind)),
            written(nlohmann::ordered_json::parse(text)));  // the order of the members is kept
}

TEST(Document, IsRefusedWithAPlace) {
  expect_refused("{\"a\": 1}\0"s, "summary.json:1:9: error: a NUL byte; remove it: a summary is plain UTF-8 text");
  expect_refused("{\"a\": 1}\n\0more"s, "summary.json:2:1: error: a NUL byte");
  expect_refused("{\"a\": 1}\n {}", "summary.json:2:2: error: text after the end of the summary: '{'");
  expect_refused("{\"a\": 1, \"b\": {\"c\": 1,\n \"c\": 2}}",
                 "summary.json:2:2: error: /b/c: duplicate key, given already at 1:16");
  expect_refused("{\"_a\": 1, \"_a\": 2}", "summary.json:1:11: error: /_a: duplicate key");  // it has no comments
  expect_refused("{\"a\": {\"//\": {\"b\": 1, \"b\": 2}}}", "error: /a/~1~1/b: duplicate key");
  expect_refused("{\"a\": \"\xff\"}", "summary.json:1:8: error: byte 0xff is not valid UTF-8");
  expect_refused("{\"a\": 1e999}", "summary.json:1:7: error: /a: 1e999 is too large for a double");
  expect_refused("{\"a\": NaN}", "summary.json:1:7: error: /a: NaN is not a finite number");
  expect_refused("{\"a\": [1, 2", "summary.json:1:12: error: /a: the text ends here");
  expect_refused("", "summary.json:1:1: error: is empty; a summary is an object {...}");
  expect_refused("[1]", "summary.json:1:1: error: the text is an array; a summary is an object {...}");
  expect_refused("{\"a\": " + repeated("[", 64) + repeated("]", 64) + "}", "nested more than 64 levels deep");
  EXPECT_EQ(refusal_of("{\"a\": " + repeated("[", 63) + repeated("]", 63) + "}"), "accepted");
}

TEST(Document, HasALimitOfSizeOfValuesAndOfMembers) {
  const auto members = [](std::size_t count) {
    std::string text = "{\"k\": 0";
    for (std::size_t i = 1; i < count; ++i) text += fmt::format(",\"{}\":0", i);
    return text + "}";
  };
  EXPECT_EQ(refusal_of(members(kMostMembers)), "accepted");
  expect_refused(members(kMostMembers + 1), "more than 10000 members in an object; a summary has far fewer");
  EXPECT_EQ(refusal_of("{\"a\": [0" + repeated(",0", 97) + "]}", {"summary", 1, 100}), "accepted");
  EXPECT_NE(refusal_of("{\"a\": [0" + repeated(",0", 98) + "]}", {"summary", 1, 100}).find("more than 100 values"),
            std::string::npos);
  EXPECT_NE(refusal_of(std::string((1U << 20U) + 1, ' '), {"summary", 1}).find("at most 1 MiB"), std::string::npos);
}

TEST(Document, ErrorsAreAsManyAsInAScenario) {
  std::string text = "{\"a\": 0";
  for (int i = 0; i < 100; ++i) text += ",\n\"a\": 1";
  const std::string said = refusal_of(text + "}");
  EXPECT_EQ(std::count(said.begin(), said.end(), '\n'), 20);
  EXPECT_NE(said.find("80 more errors are not shown"), std::string::npos);
}

std::string header_refusal(const std::string& text) {
  try {
    CsvReader reader = CsvReader::of_text("table.csv", text);
    reader.want({0});
    while (reader.next()) {
    }
  } catch (const ScenarioError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(CsvHeader, HasALimitOfColumns) {
  std::string header = "t_s", row = "0";
  for (std::size_t i = 1; i < kMostColumns; ++i) {
    header += fmt::format(",c{}", i);
    row += ",0";
  }
  EXPECT_EQ(header_refusal(header + "\n" + row + "\n"), "accepted");
  const std::string said = header_refusal(header + ",more,and,more\n");
  EXPECT_EQ(said,
            fmt::format("table.csv:1:{}: error: the header names more than 10000 columns, the most that a table may have; "
                        "leave some out",
                        header.size() + 2));
  EXPECT_EQ(header_refusal("t_s,a\n1,2\n" + repeated("1,", 100'000) + "1\n"),
            "table.csv:3:1: error: more than 4 cells, where the header names 2 columns");
}

TEST(CsvText, IsUtf8WithoutNulBytes) {
  EXPECT_EQ(header_refusal("# \xC3\xA9\n\xC3\xA9,a\n1,2\n"), "accepted");
  EXPECT_NE(header_refusal("t_s,a\n1,\0\n"s).find("table.csv:2:3: error: a NUL byte"), std::string::npos);
  EXPECT_NE(header_refusal("# note \xE9\nt_s\n1\n").find("table.csv:1:8: error: byte 0xe9 is not valid UTF-8"),
            std::string::npos);
  EXPECT_NE(header_refusal("t_s,a\n1,23456789012\xE9\n").find("table.csv:2:14: error: byte 0xe9"), std::string::npos);
  EXPECT_EQ(header_refusal("\xEF\xBB\xBF# a comment\nt_s\n1\n"), "accepted");
}

TEST(Names, AreListedUpToALimit) {
  EXPECT_EQ(listed({}), "");
  EXPECT_EQ(listed({"a", "b"}), "a, b");
  const std::string many = listed(std::vector<std::string>(20'000, "a_column"));
  EXPECT_TRUE(many.starts_with("a_column, a_column, ") && many.ends_with(" more")) << many;
  EXPECT_LT(listed(std::vector<std::string>(20'000, std::string(100, 'x'))).size(), 1000U);
}

TEST(Shortened, CutsBetweenCharactersAndEscapes) {
  EXPECT_EQ(shortened("abcdef", 6), "abcdef");
  EXPECT_EQ(shortened("abcdefg", 6), "abc...");
  EXPECT_EQ(shortened("ab\u00e9defg", 6), "ab...");            // the third character has two bytes
  EXPECT_EQ(shortened("a\x1b[2Jabcdef", 8), "a\x1b...");       // shown as \x1b, four bytes
  EXPECT_EQ(shortened("\u202e\u202e\u202e", 9), "\u202e...");  // shown as \u202e, six bytes
  EXPECT_EQ(shortened("abcd\\x1babcdef", 10), "abcd...");      // an escape that is there already
  EXPECT_EQ(shortened("abcd\\u202eabcdef", 12), "abcd...");
  EXPECT_EQ(shortened("/a~1~0~1bcdefghi", 8), "/a~1...");
  for (std::size_t most = 3; most < 60; ++most)
    EXPECT_LE(printable(shortened(repeated("a\x1b\u00e9\xff\U000e0001~1\\u202e", 9), most)).size(), most);
}

TEST(Shortened, EveryLineOfADiagnosticIsShort) {
  for (const std::string unit : {"x", "\x1b", "\xff", "\u202e", "\U000e0001", "\u00e9", "~1", "\\u001b"}) {
    const std::string text = repeated(unit, 100'000 / unit.size());
    const ScenarioError error({{123456789, 1234567890, text, text}}, text);
    EXPECT_LT(std::string(error.what()).size(), 2048U) << unit;
    EXPECT_EQ(error.what(), printable(error.what())) << unit;
    EXPECT_LE(printable(error.diagnostics().front().message).size(), kLongestMessage) << unit;
    Findings findings;
    findings.add({}, text, text);
    EXPECT_LT(format_diagnostic(text, findings.errors("").front()).size(), 2048U) << unit;
  }
  EXPECT_TRUE(format_diagnostic(std::string(5000, 'd') + "/name.json", {}).find("ddd/name.json: ") != std::string::npos);
}

/// What nlohmann says of reading a document's values is said in words of its reader.
TEST(PlainWords, AreSaidOfADocumentsErrors) {
  const nlohmann::ordered_json document = {{"a", {1, 2}}, {"b", "x"}};
  const auto said = [](const auto& read) -> std::string {
    try {
      read();
    } catch (const nlohmann::ordered_json::exception& error) {
      return complaint_of(error);
    }
    return "nothing";
  };
  const std::string kind = "a value is of another kind, or a list has another length";
  EXPECT_EQ(said([&] { return document.at("drift"); }), "a member is missing: drift");
  EXPECT_EQ(said([&] { return document.at("b").get<double>(); }), kind);
  EXPECT_EQ(said([&] { return document.at("a").at("c"); }), kind);
  EXPECT_EQ(said([&] { return document.at("a").at(7); }), kind);
  EXPECT_EQ(said([&] { return document.at(nlohmann::ordered_json::json_pointer("/b/c")); }), kind);
  EXPECT_EQ(said([&] { return count_in(document.at("b")); }), "not a whole number of at least 0");
}

TEST(PlainWords, OfAnExceptionAreNoTextOfALibrary) {
  EXPECT_EQ(plain_words(ScenarioError("/a", "is wrong")), "error: /a: is wrong");
  EXPECT_EQ(plain_words(ReadError("a.csv", "is gone")), "a.csv: is gone");
  EXPECT_EQ(plain_words(ArithmeticError("rounds up")), "rounds up");
  EXPECT_EQ(plain_words(std::bad_alloc()), "out of memory; ask for fewer rows, or end other programs");
  EXPECT_EQ(plain_words(std::filesystem::filesystem_error("x", "a\nb", std::make_error_code(std::errc::permission_denied))),
            "a\\x0ab: Permission denied");
  EXPECT_EQ(plain_words(std::system_error(std::make_error_code(std::errc::resource_unavailable_try_again))),
            "no thread can be started; end other programs");
  EXPECT_EQ(plain_words(std::out_of_range("vector::_M_range_check")),
            "a defect of earthtop, and not of what it was given; please report it with the command and its files");
}

}  // namespace
}  // namespace earthtop::input
