// SPDX-License-Identifier: GPL-3.0-or-later
// Every input that once broke a property of its door, and one seed of each door, go through the same properties again.
#include <gtest/gtest.h>

#include <filesystem>

#include "fuzz/door.hpp"
#include "fuzz/properties.hpp"

namespace earthtop::fuzz {
namespace {

namespace fs = std::filesystem;

const fs::path kCorpus = fs::path(EARTHTOP_TESTS) / "fuzz" / "corpus";

TEST(Doors, KeepTheirPropertiesForEveryKeptInput) {
  for (const auto& directory : fs::directory_iterator(kCorpus))
    for (const auto& entry : fs::directory_iterator(directory.path()))
      EXPECT_NO_THROW(door(directory.path().filename().string()).enter(content_of(entry.path()))) << entry.path();
}

TEST(Doors, AcceptTheirFirstSeed) {
  for (const Door& each : doors()) EXPECT_NO_THROW(each.enter(each.seeds().front())) << each.name;
}

// The properties can break.
TEST(Doors, NoticeWhatIsBroken) {
  EXPECT_THROW(check_message(std::string(2048, 'x')), Broken);
  EXPECT_THROW(check_message("a\nb"), Broken);
  EXPECT_THROW(check_message("a\xFF"), Broken);
  EXPECT_THROW(check_json("{\"a\": NaN}"), Broken);
  EXPECT_THROW(check_json("{\"a\": 1, \"a\": 2}"), Broken);
  EXPECT_THROW(check_csv("a,b\n1\n"), Broken);
  EXPECT_THROW(check_csv("a,b\n1,nan\n"), Broken);
  EXPECT_THROW(check_csv("a,b\n1,\"2\n"), Broken);
  EXPECT_EQ(check_csv("a,b\n1,\"2,\n\"\"\"\n"), 1U);
  for (const char* text : {"<p>a</p", "<p>", "<p></b>", "<p>a & b</p>", "<p onclick=\"x\"></p>", "<p class=\"<\"></p>",
                           "<img/>", "<a href=\"http:x\"></a>", "<p>\x07</p>", "<p>\xE2\x80\xAE</p>", "<script>1</script>"})
    EXPECT_THROW(check_markup(text), Broken) << text;
  EXPECT_NO_THROW(check_markup("<p class=\"a\">a &lt; b</p>"));
  EXPECT_THROW(accepts([] { throw std::runtime_error("no documented exception"); }), std::runtime_error);
  EXPECT_FALSE(accepts([] { throw ScenarioError("", "refused"); }));
}

}  // namespace
}  // namespace earthtop::fuzz
