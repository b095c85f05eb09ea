// SPDX-License-Identifier: GPL-3.0-or-later
// The door through which words come into pages and pictures: whatever a title, name, unit or reason holds, it stays text.
#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>

#include "earthtop/plot/plot.hpp"
#include "earthtop/study/run_study.hpp"
#include "fuzz/door.hpp"
#include "fuzz/fixture.hpp"
#include "fuzz/properties.hpp"
#include "report/html.hpp"
#include "study/store.hpp"
#include "text/json.hpp"

namespace earthtop::fuzz {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

/// Chooses which words of a document are replaced, and by which of the texts.
class Replacement {
 public:
  Replacement(std::string_view choice, std::vector<std::string> texts) : choice_(choice), texts_(std::move(texts)) {}

  /// Replaces the strings that are chosen, all down the document.
  void replace(Json& json) {
    if (json.is_string()) {
      const std::size_t at = count_++;
      if (!choice_.empty() && (static_cast<unsigned char>(choice_[at / 8 % choice_.size()]) >> at % 8 & 1U) != 0)
        json = texts_[at % texts_.size()];
      return;
    }
    if (!json.is_structured()) return;
    for (auto& [key, value] : json.items())
      if (!key.starts_with('$')) replace(value);
  }

 private:
  std::string_view choice_;
  std::vector<std::string> texts_;
  std::size_t count_ = 0;
};

/// A page with this text in every place for text, valid UTF-8 or not.
void check_plain_page(const std::string& text) {
  Figure figure{text, text, {text, text}, {}};
  figure.panels.push_back({{text, text}, {{text, {0, 1, 2}, {1, 3, 2}, LineColor::blue, LineStyle::solid, Marker::circle}}});
  check_markup(svg(figure));
  report::Page page("run", text);
  page.headline(report::escaped(text));
  page.verdict(text, report::escaped(text));
  page.data()["text"] = text;
  page.section("all", text,
               page.chart("c", std::move(figure), text) + report::facts_html({{text, report::escaped(text)}}) +
                   report::table_html({text}, {{report::escaped(text)}}) + report::Page::command(text) +
                   report::number_html(1, text));
  check_markup(page.finish().html);
}

/// A study with this text in all its words, and its store.
void check_study(const std::string& text) {
  Json document = json_of(Fixture::get().study().text);
  for (const char* key : {"title", "purpose", "finding"}) document[key] = text;
  document["base"]["title"] = text;
  document["figures"][0]["origin"] = text;
  const fs::path store = study_store(Scratch::empty() / "study");
  fs::create_directories(store.parent_path());
  accepts([&] {
    const Study study = parse_study({"few.json", written_replacing(document)});
    study::Store made = study::Store::create(store, study, {});
    made.begin();
    for (std::uint64_t number = 0; number < 4; ++number)
      made.insert({number, {10.0 * static_cast<double>(number)}, number == 2 ? "refused" : "completed", text, "", {1.0, text}});
    made.commit();
    made.finish();
  });
  check_report(store);
  accepts([&] { check_json(study_json(store)); });
  std::string table;
  accepts([&] {
    study_csv(store, [&](std::string_view piece) { table += piece; });
    demand(check_csv(table, true) == 4, "a point is a line", table);
  });
}

}  // namespace

/// The first byte chooses the document, the next part which of its words are replaced, the others are the texts.
void enter_page_text(std::string_view input) {
  if (input.empty()) return;
  static const std::array<std::string, 5> kDocuments = {Fixture::get().comparison(), Fixture::get().bench(),
                                                        Fixture::get().measurement(), Fixture::get().plan(),
                                                        Fixture::get().result_files().summary};
  const std::size_t which = static_cast<unsigned char>(input.front()) % (kDocuments.size() + 2);
  auto parts = parts_of(input.substr(1));
  const std::string choice = parts.front();
  if (parts.size() > 1) parts.erase(parts.begin());
  if (which == kDocuments.size()) return check_plain_page(parts[0]);
  if (which == kDocuments.size() + 1) return check_study(parts[0]);
  Json document = json_of(kDocuments[which]);
  Replacement(choice, parts).replace(document);
  Scratch::empty();
  if (which + 1 < kDocuments.size())
    return check_report(Scratch::write("document.json", written_replacing(document, 2) + "\n"));
  Scratch::write("results/summary.json", written_replacing(document, 2) + "\n");
  check_report(Scratch::write("results/trajectory.csv", Fixture::get().result_files().trajectory).parent_path());
}

std::vector<std::string> page_text_seeds() {
  constexpr const char* kTexts[] = {"</title><script>alert(1)</script>\"'&\x07",
                                    "a \xE2\x80\xAE \xE2\x80\xA8 b",
                                    "]]><!-- -->",
                                    "\" onload=\"x",
                                    "</script>",
                                    "=1+1",
                                    "\xC0\xAF\xFF",
                                    "'-x\n\r\t,\"",
                                    "\\u003c\\"};
  std::vector<std::string> seeds;
  for (char which = 0; which < 7; ++which)
    for (const char* text : kTexts)
      for (const char* choice : {"\xff", "\x10\x20"})
        seeds.push_back(std::string(1, static_cast<char>('F' + which)) + choice + kBetweenParts + text);  // 'F' is 0 modulo 7
  return seeds;
}

}  // namespace earthtop::fuzz
