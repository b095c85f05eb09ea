// SPDX-License-Identifier: GPL-3.0-or-later
#include "input/text_edit.hpp"

#include <gtest/gtest.h>

#include "earthtop/error.hpp"

namespace earthtop::input {
namespace {

TEST(TextEdit, ChangesOneValueAndLeavesTheRest) {
  struct Case {
    std::string text, pointer, value, expected;
  };
  const Case cases[] = {
      {R"({"a": 1.50, "b": [1, 2 ,3]})", "/a", "2.5", R"({"a": 2.5, "b": [1, 2 ,3]})"},
      {R"({"a": 1.50, "b": [1, 2 ,3]})", "/b/1", "7", R"({"a": 1.50, "b": [1, 7 ,3]})"},
      {R"({"a": {"b": "}]\"", "c": -1e-3}})", "/a/c", "4", R"({"a": {"b": "}]\"", "c": 4}})"},
      {R"({"a": {"b": 1}, "b": 2})", "/b", "[1]", R"({"a": {"b": 1}, "b": [1]})"},
      {R"({"s": "old"})", "/s", "new word", R"({"s": "new word"})"},
      {R"({"s": "old"})", "/s", "\"json\"", R"({"s": "json"})"},
      {R"({"\u0061": 1})", "/a", "2", R"({"\u0061": 2})"},
      {R"({"a~/": 1})", "/a~0~1", "2", R"({"a~/": 2})"},
      {"\xEF\xBB\xBF {\"a\": 1}\n", "/a", "2", "\xEF\xBB\xBF {\"a\": 2}\n"},
      // A missing member is added behind the last one, laid out as that is.
      {R"({"a": 1})", "/b", "2", R"({"a": 1, "b": 2})"},
      {R"({"a":1,"c":3})", "/b", "2", R"({"a":1,"c":3, "b": 2})"},
      {"{\n  \"a\": 1\n}\n", "/b", "2", "{\n  \"a\": 1,\n  \"b\": 2\n}\n"},
      {"{\n  \"a\": {}\n}", "/a/b", "2", "{\n  \"a\": { \"b\": 2 }\n}"},
      {"{\n  \"a\": { \"x\": 1 },\n  \"z\": 0\n}", "/a/b/c", "2",
       "{\n  \"a\": { \"x\": 1, \"b\": { \"c\": 2 } },\n  \"z\": 0\n}"},
      {"{ }", "/a/b", "2", R"({ "a": { "b": 2 } })"},
      {R"({"a": [{"x": 1}, {"x": 2}]})", "/a/1/x", "3", R"({"a": [{"x": 1}, {"x": 3}]})"},
  };
  for (const Case& c : cases) EXPECT_EQ(with_value(c.text, c.pointer, c.value), c.expected) << c.text << " " << c.pointer;
}

TEST(TextEdit, RemovesAMember) {
  EXPECT_EQ(without_member(R"({"a": 1, "b": {"a": 2}, "c": 3})", "/a"), R"({"b": {"a": 2}, "c": 3})");
  EXPECT_EQ(without_member(R"({"a": 1, "b": {"a": 2}, "c": 3})", "/b"), R"({"a": 1, "c": 3})");
  EXPECT_EQ(without_member("{\n  \"a\": 1,\n  \"c\": 3\n}", "/c"), "{\n  \"a\": 1\n}");
  EXPECT_EQ(without_member(R"({"a": 1})", "/a"), "{}");
  EXPECT_EQ(without_member(R"({"a": 1})", "/b"), R"({"a": 1})");
  EXPECT_EQ(without_member(R"({"a": {"b": 1, "c": 2}, "b": 3})", "/a/b"), R"({"a": {"c": 2}, "b": 3})");
  EXPECT_EQ(without_member(R"({"a": {"b": {"c": 2}}, "c": 3})", "/a/b/c"), R"({"a": {"b": {}}, "c": 3})");
  for (const char* pointer : {"", "/a/b", "/l/0", "/a/b/c"})
    EXPECT_EQ(without_member(R"({"a": 1, "l": [1]})", pointer), R"({"a": 1, "l": [1]})") << pointer;
}

TEST(TextEdit, PlacesThatAreNotThereAreRefused) {
  for (const char* pointer : {"", "a", "/a/b", "/l/2", "/l/-", "/l/x", "/a~2"}) try {
      with_value(R"({"a": 1, "l": [1, 2]})", pointer, "3");
      ADD_FAILURE() << pointer;
    } catch (const ScenarioError& error) {
      EXPECT_STREQ(error.diagnostics().front().message.c_str(),
                   "does not lead to a value in the scenario's text that can be changed");
      EXPECT_EQ(error.diagnostics().front().pointer, pointer);
    }
}

}  // namespace
}  // namespace earthtop::input
