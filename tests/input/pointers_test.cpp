// SPDX-License-Identifier: GPL-3.0-or-later
// Where JSON pointers lead: in a table of fields, and in a tree.
#include "input/pointers.hpp"

#include <gtest/gtest.h>

#include "input/reader.hpp"

namespace earthtop::input {
namespace {

constexpr Field kFields[] = {
    {"/size", FieldKind::number, "m", {}, "", "", ""},   {"/at", FieldKind::vector3, "m", {}, "", "", ""},
    {"/turn", FieldKind::matrix3, "", {}, "", "", ""},   {"/parts", FieldKind::list, "", {}, "", "", ""},
    {"/parts/*", FieldKind::object, "", {}, "", "", ""}, {"/parts/*/word", FieldKind::word, "", {}, "one|two", "", ""},
    {"/set", FieldKind::changes, "", {}, "", "", ""}};
constexpr FieldTable kTable = {"thing", "thing", kFields};

TEST(PointerTarget, IsANumberWhereAFieldOrAnElementIsOne) {
  for (const char* pointer : {"/size", "/at/2", "/turn/0/2"}) {
    const PointerTarget target = pointer_target(kTable, pointer);
    EXPECT_TRUE(target.is_number) << pointer;
    EXPECT_FALSE(target.fault) << pointer;
    ASSERT_NE(target.field, nullptr);
    EXPECT_TRUE(std::string_view(pointer).starts_with(target.field->pointer)) << pointer;
  }
  for (const char* pointer : {"/at", "/turn/0", "/parts/7", "/parts/0/word", "/set/0"}) {
    EXPECT_FALSE(pointer_target(kTable, pointer).is_number) << pointer;
    EXPECT_FALSE(pointer_target(kTable, pointer).fault) << pointer;
  }
}

TEST(PointerTarget, SaysWhyThereCanBeNone) {
  for (const char* pointer :
       {"", "size", "/sise", "/at/3", "/at/x", "/size/0", "/parts/x", "/parts/*", "/_note", "/turn/0/3"}) {
    EXPECT_TRUE(pointer_target(kTable, pointer).fault) << pointer;
    EXPECT_FALSE(pointer_target(kTable, pointer).is_number) << pointer;
  }
  EXPECT_NE(pointer_target(kTable, "/sise").fault->find("did you mean \"size\""), std::string::npos);
}

TEST(NodeAt, FollowsMembersAndIndices) {
  Node root;
  Findings findings;
  ASSERT_EQ(read_json(R"({"a": [1, {"b/c": 2}], "d": {"0": 3}})", "", false, root, findings), ReadOutcome::complete);
  EXPECT_EQ(node_at(root, "/a/0")->number, 1);
  EXPECT_EQ(node_at(root, "/a/1/b~1c")->number, 2);
  EXPECT_EQ(node_at(root, "/d/0")->number, 3);
  for (const char* pointer : {"/a/2", "/a/00", "/a/-", "/b", "/a/0/x", "d"})
    EXPECT_EQ(node_at(root, pointer), nullptr) << pointer;
}

}  // namespace
}  // namespace earthtop::input
