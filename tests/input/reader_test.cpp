// SPDX-License-Identifier: GPL-3.0-or-later
// The reader of JSON text: syntax, encoding, numbers, duplicates, depth, and the processor time that hostile texts cost.
#include "input/reader.hpp"

#include <ctime>
#include <random>

#include "scenario/support.hpp"
#include "support/json.hpp"

namespace earthtop::scenario_test {
namespace {

using namespace std::string_literals;

TEST(ScenarioSyntax, FirstSyntaxErrorStandsWhereItIs) {
  expect_one("", "1:1 ", "the text ends here; a JSON value");
  expect_one("{\"a\": 1,\n \"b\" 2}", "2:6 /b", "':' is expected here");
  expect_one("{\"_a\": [1, 2,]}", "1:13 /_a", "a comma after the last element");
  expect_one("{\"_a\": 1,\n}", "1:9 ", "a comma after the last member");
  expect_one("{\"_a\": 1\n \"_b\": 2}", "2:2 ", "',' or '}'");
  expect_one("{\"_a\": .5}", "1:8 /_a", "write 0.5");
  expect_one("{\"_a\": 01}", "1:8 /_a", "leading zero");
  expect_one("{\"_a\": 1.}", "1:10 /_a", "decimal point");
  expect_one("{\"_a\": 1e}", "1:10 /_a", "exponent");
  expect_one("{\"_a\": -}", "1:9 /_a", "'-' must be followed by a digit");
  expect_one("{\"_a\": True}", "1:8 /_a", "\"True\" is not a JSON value");
  expect_one("{\"_a\": 'x'}", "1:8 /_a", "single quotes");
  expect_one("{ // note\n}", "1:3 ", "JSON has no comments");
  expect_one("{\"_a\": \"x\ny\"}", "1:10 /_a", "line break");
  expect_one("{\"_a\": \"\\q\"}", "1:9 /_a", "escape");
  expect_one("{\"_a\": \"\\ud800\"}", "1:9 /_a", "surrogate");
  expect_one("{\"_a\": \"abc", "1:8 /_a", "closing quote");
  expect_one("{\"_a\": [1, {\"b\": }]}", "1:18 /_a/1/b", "a JSON value is expected here");
  expect_one(kMinimal + "x", "5:1 ", "text after the end");
  expect_one(kMinimal + "{}", "5:1 ", "text after the end");
  expect_one("[1]", "1:1 ", "a scenario is an object");
}

TEST(ScenarioSyntax, ColumnsAreBytesAndAByteOrderMarkHasNone) {
  expect_one("{\"_\u00e9\": tru}", "1:9 /_\u00e9", "tru");
  expect_one("\xEF\xBB\xBF{\"_a\": tru}", "1:8 /_a", "tru");
  EXPECT_NO_THROW(parse("\xEF\xBB\xBF" + kMinimal));
}

TEST(ScenarioSyntax, NulAndOtherEncodingsAreRefused) {
  expect_one("{\"_a\":\n \"x\0y\"}"s, "2:4 ", "NUL byte");
  expect_one(kMinimal + "\0garbage"s, "5:1 ", "NUL byte");
  expect_one(replaced(kMinimal, "{", "{\"title\": \"\\u0000\","), "1:12 /title", "NUL character");
  expect_one("\xFF\xFE{\0\"\0}\0"s, "1:1 ", "UTF-16LE; save it as UTF-8");
  expect_one("{\0\"\0}\0"s, "1:1 ", "UTF-16LE");
  expect_one("{\0"s, "1:1 ", "UTF-16LE");
  expect_one("\xFE\xFF\0{\0}"s, "1:1 ", "UTF-16BE");
  expect_one("\0{\0}"s, "1:1 ", "UTF-16BE");
  expect_one("\xFF\xFE\0\0{\0\0\0"s, "1:1 ", "UTF-32LE");
  expect_one("{\0\0\0}\0\0\0"s, "1:1 ", "UTF-32LE");
  expect_one("\0\0\xFE\xFF\0\0\0{"s, "1:1 ", "UTF-32BE");
  expect_one("\0\0\0{\0\0\0}"s, "1:1 ", "UTF-32BE");
  expect_one(std::string(100, '\0'), "1:1 ", "NUL byte");
  expect_one("{\"_a\": \"\xC3\x28\"}", "1:9 ", "0xc3 is not valid UTF-8");
  expect_one("{\"_a\": \"\xC0\xAF\"}", "1:9 ", "not valid UTF-8");          // overlong
  expect_one("{\"_a\": \"\xED\xA0\x80\"}", "1:9 ", "not valid UTF-8");      // surrogate
  expect_one("{\"_a\": \"\xF4\x90\x80\x80\"}", "1:9 ", "not valid UTF-8");  // over U+10FFFF
}

TEST(ScenarioSyntax, ATextHasAtMost16MiB) {
  expect_one(std::string((std::size_t{16} << 20) + 1, ' '), "1:1 ", "the text has 16777217 bytes; at most 16 MiB are allowed");
  EXPECT_NO_THROW(parse(kMinimal + std::string((std::size_t{16} << 20) - kMinimal.size(), ' ')));
}

TEST(ScenarioSyntax, NumbersNeitherOverflowNorVanishSilently) {
  const auto with_mass = [](const std::string& mass) { return replaced(kMinimal, "0.1", mass); };
  for (const std::string number : {"1e999", "-1e999", "1e309", "123456789e308", "1e99999999999999999999"})
    expect_one(with_mass(number), "2:22 /body/mass_kg", "too large for a double");
  for (const std::string number : {"1e-400", "-1e-400", "2e-324", "0.000001e-320", "1e-99999999999999999999"})
    expect_one(with_mass(number), "2:22 /body/mass_kg", "too small for a double");
  expect_one(with_mass("1" + std::string(400, '0')), "2:22 /body/mass_kg", "too large for a double");
  expect_one(with_mass("0." + std::string(400, '0') + "1"), "2:22 /body/mass_kg", "too small for a double");
  EXPECT_DOUBLE_EQ(parse(with_mass("0." + std::string(400, '0') + "1e400")).body.mass_kg, 0.1);
  EXPECT_EQ(parse(replaced(kMinimal, "20,", "0e999,")).release.tilt_deg, 0);
  expect_one(replaced(kMinimal, "0, 0, 0.03", "0, 1e999, 0.03"), "2:51 /body/center_of_mass_m/1", "too large");
}

TEST(ScenarioSyntax, NotFiniteLiteralsAreNamedAndTheRestIsStillChecked) {
  for (const std::string word : {"NaN", "nan", "Infinity", "-Infinity", "-inf"}) {
    const Found found = found_in(replaced(replaced(kMinimal, "0.1", word), "60", "-1"));
    EXPECT_EQ(found.places, (std::vector<std::string>{"2:22 /body/mass_kg", "4:27 /motion/duration_s"}));
    EXPECT_TRUE(found.says(0, word + " is not a finite number"));
  }
}

TEST(ScenarioSyntax, DuplicateKeysNameBothPlaces) {
  expect_one(replaced(kMinimal, "\"spin_rad_s\": 200", "\"spin_rad_s\": 200,\n  \"tilt_deg\": 20"), "4:3 /release/tilt_deg",
             "given already at 3:14");
  expect_one(replaced(kMinimal, "\"spin_rad_s\": 200", "\"spin_rad_s\": 200, \"tilt\\u005fdeg\": 20"), "3:49 /release/tilt_deg",
             "given already at 3:14");  // the same key, written with an escape
  EXPECT_NO_THROW(parse(replaced(kMinimal, "{\"site\"", "{\"_c\": [{\"a\": 1, \"a\": 2}], \"site\"")));  // a comment's value
  expect_one(replaced(kMinimal, "{\"site\"", "{\"_c\": {}, \"report\": {}, \"report\": {}, \"site\""), "1:26 /report",
             "given already at 1:12");
  EXPECT_NO_THROW(parse(replaced(kMinimal, "{\"site\"", "{\"//\": 1, \"//\": 2, \"_c\": 1, \"_c\": 2, \"site\"")));
}

TEST(ScenarioSyntax, DepthIsLimitedTo64) {
  const auto nested = [](int depth) { return std::string(depth - 1, '[') + std::string(depth - 1, ']'); };
  const auto commented = [](const std::string& value) {
    return replaced(kMinimal, "{\"site\"", "{\"_c\": " + value + ", \"site\"");
  };
  EXPECT_NO_THROW(parse(commented(nested(64))));
  const Found found = found_in(commented(nested(65)));
  ASSERT_EQ(found.places.size(), 1u);
  EXPECT_TRUE(found.places[0].starts_with("1:71 /_c/0/0")) << found.places[0];
  EXPECT_TRUE(found.says(0, "more than 64 levels deep"));
}

#if defined(__SANITIZE_ADDRESS__) || !defined(NDEBUG)
constexpr double kPatience = 40;  // s of processor time; builds that are not optimised are an order of magnitude slower
#else
constexpr double kPatience = 2;  // s of processor time, as promised
#endif

TEST(ScenarioSyntax, HostileTextsAreRefusedInUnderTwoSeconds) {
  const auto repeated = [](const std::string& unit, std::size_t bytes) {
    std::string text;
    text.reserve(bytes + unit.size());
    while (text.size() < bytes) text += unit;
    return text;
  };
  const std::size_t most = (std::size_t{16} << 20) - 100;
  std::string many_keys = "{", many_duplicates = "{";
  for (int i = 0; i < 190'000; ++i) many_keys += "\"mass_" + std::to_string(i) + "\": 1,\n", many_duplicates += "\"a\": 1,\n";
  const std::vector<std::pair<const char*, std::string>> texts = {
      {"brackets", std::string(100'000, '[')},
      {"braces", repeated("{\"a\":", most)},
      {"too long", std::string((std::size_t{16} << 20) + 1, ' ')},
      {"one string", "{\"a\": \"" + std::string(most, 'x') + "\"}"},
      {"one key", "{\"" + std::string(most, 'x') + "\": 1}"},
      {"one number", "{\"a\": 1" + std::string(most, '0') + "}"},
      {"one fraction", "{\"a\": 0." + std::string(most, '1') + "}"},
      {"many values", "{\"a\": [" + repeated("0,", most) + "0]}"},
      {"many keys", many_keys + "\"z\": 1}"},
      {"many duplicates", many_duplicates + "\"z\": 1}"},
      {"escapes", "{\"a\": \"" + repeated("\\u00e9", most) + "\"}"},
      {"line ends", std::string(most, '\n') + "x"},
  };
  for (const auto& [name, text] : texts) {
    const std::clock_t start = std::clock();
    const Found found = found_in(text);
    const double used_s = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
    EXPECT_FALSE(found.places.empty()) << name;
    EXPECT_LT(used_s, kPatience) << name;
    std::size_t bytes = 0;
    for (std::size_t i = 0; i < found.places.size(); ++i) bytes += found.places[i].size() + found.messages[i].size();
    EXPECT_LT(bytes, 30'000u) << name;
    EXPECT_LE(found.places.size(), 21u) << name;
  }
}

// Compares the reader with nlohmann's: both accept or refuse the same mutated texts. What only this reader refuses by design
// (NUL, duplicates, numbers out of range, depth) is reported as something other than `not_json`.
TEST(ScenarioSyntax, AcceptsTheJsonThatAnotherReaderAccepts) {
  const std::string seed_text =
      R"({"a": [1, -2.5e+3, 0, true, false, null, "x\n\u00e9\ud83d\ude00"], "b": {"c": {}, "d": []}, "e": 1E-2})";
  const std::string alphabet = "{}[]:,\"\\ \n0123456789eE+-.truefalsn/u'x";
  std::mt19937 random(20240607);
  int accepted = 0, refused = 0;
  for (int i = 0; i < 20'000; ++i) {
    std::string text = seed_text;
    for (unsigned k = 0; k < 1 + random() % 3; ++k) {
      const std::size_t at = random() % text.size();
      const char c = alphabet[random() % alphabet.size()];
      switch (random() % 3) {
        case 0: text[at] = c; break;
        case 1: text.insert(at, 1, c); break;
        default: text.erase(at, 1); break;
      }
    }
    input::Findings findings;
    input::Node root;
    const auto outcome = input::read_json(text, "", false, root, findings);
    const bool is_json = outcome == input::ReadOutcome::complete;
    if (findings.empty()) {
      EXPECT_TRUE(testing::is_json(text)) << text;
      ++accepted;
    } else if (!is_json) {
      EXPECT_FALSE(testing::is_json(text)) << text;
      ++refused;
    }
  }
  EXPECT_GT(accepted, 1000);
  EXPECT_GT(refused, 1000);
}

}  // namespace
}  // namespace earthtop::scenario_test
