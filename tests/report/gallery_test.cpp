// SPDX-License-Identifier: GPL-3.0-or-later
// The index of a gallery and what its pages say besides, the README's three pictures of it, and the small picture of a study.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include "earthtop/report/report.hpp"
#include "earthtop/results/results.hpp"
#include "earthtop/run.hpp"
#include "earthtop/study/run_study.hpp"
#include "earthtop/study/study.hpp"
#include "report/html.hpp"
#include "report/study_finding.hpp"
#include "report/study_picture.hpp"
#include "support/temporary_directory.hpp"

namespace earthtop {
namespace {

using testing::TemporaryDirectory;

constexpr const char* kReadmeScenes[] = {"foucault-pendulum", "gyrocompass-in-gimbals", "tippe-top"};

Report page_of(const std::string& name, const std::vector<std::pair<std::string, std::string>>& changes = {}) {
  const TemporaryDirectory dir;
  write_results(run(parse_scenario(read_scenario_source(EARTHTOP_SCENARIOS "/" + name + ".json"), changes)), dir.path() / "run",
                false);
  return make_report(dir.path() / "run", {}, "index.html");
}

std::vector<std::string> all_matches(const std::string& text, const char* pattern) {
  const std::regex regex(pattern);
  std::vector<std::string> found;
  for (std::sregex_iterator at(text.begin(), text.end(), regex), end; at != end; ++at) found.push_back((*at)[1]);
  return found;
}

TEST(Gallery, ItsIndexHasThePictureAndTheFindingOfEachPageInItsGroup) {
  std::vector<GalleryPage> pages;
  for (const char* name : {"toy-top", "rolling-ball", "fast-gyro"})
    pages.push_back({std::string(name) + ".html", page_of(name, {{"/motion/duration_s", "3"}})});
  const std::string index = gallery_index(pages);
  EXPECT_NE(index.find("<h1>Tops and gyroscopes on an Earth that turns</h1>"), index.npos);
  EXPECT_NE(index.find("3 pages, each with what was found."), index.npos);
  EXPECT_NE(gallery_index({pages[0]}).find("One page, with what was found."), index.npos);
  EXPECT_NE(pages[1].report.picture.find("<title>The drift of its axis</title>"), index.npos);
  EXPECT_EQ(all_matches(index, "<h2 id=\"title-group[0-9]*\">([^<]*)</h2>"),
            (std::vector<std::string>{"Tops on a point", "On a table"}));
  EXPECT_EQ(all_matches(index, "<li><a href=\"([^#\"]*)\">"),
            (std::vector<std::string>{"toy-top.html", "fast-gyro.html", "rolling-ball.html"}));
  for (const GalleryPage& page : pages) {
    EXPECT_NE(page.report.html.find("<h1>" + page.report.finding + "</h1>"), std::string::npos);
    EXPECT_NE(index.find("<p>" + page.report.finding + ".</p>"), index.npos) << page.file;
    EXPECT_NE(index.find("<span class=\"subject\">" + report::escaped(page.report.title) + "</span>"), index.npos) << page.file;
    EXPECT_NE(page.report.html.find("<p class=\"above\"><a href=\"index.html\">The gallery</a>"), std::string::npos);
  }
  // A screen reader gets each picture's title, and no id is there twice.
  EXPECT_EQ(all_matches(index, "(<span class=\"small\"><svg [^>]*role=\"img\")").size(), pages.size());
  const std::vector<std::string> ids = all_matches(index, " id=\"([^\"]*)\"");
  EXPECT_EQ(std::set<std::string>(ids.begin(), ids.end()).size(), ids.size());
  for (const std::string& used : all_matches(index, "url\\(#([^)]*)\\)")) EXPECT_EQ(std::ranges::count(ids, used), 1) << used;
}

TEST(Gallery, ABodyAndAStudyHaveGroupsOfTheirOwn) {
  EXPECT_EQ(page_of("dzhanibekov").group, "Bodies that tumble");
  EXPECT_EQ(page_of("gyrocompass-in-gimbals", {{"/motion/duration_s", "1"}}).group, "Gyroscopes");
  const TemporaryDirectory dir;
  StudyRunOptions options;
  options.dir = dir.path() / "study";
  options.jobs = 1;
  run_study(parse_study(read_scenario_source(EARTHTOP_SCENARIOS "/studies/flip-seed.json")), options);
  const Report report = make_report(options.dir, {}, "index.html");
  EXPECT_EQ(report.group, "Studies: many runs each");
  EXPECT_NE(report.html.find("</a> The page to play with runs one scene at a time, and no study.</p>"), std::string::npos);
  EXPECT_NE(report.picture.find("<svg "), std::string::npos);
}

TEST(Gallery, ForeignTextStaysText) {
  Report report = page_of("toy-top", {{"/motion/duration_s", "3"}, {"/title", "\"</span><script>alert(1)</script>\""}});
  const std::string index = gallery_index({{"toy-top.html", std::move(report)}});
  EXPECT_EQ(index.find("<script>alert"), index.npos);
  EXPECT_NE(index.find("&lt;script&gt;alert(1)"), index.npos);
}

TEST(Gallery, APageSaysWhetherThePageToPlayWithRunsItsScene) {
  const auto said = [](const Report& report) { return all_matches(report.html, "<p class=\"above\">.*</a> (.*)</p>").at(0); };
  EXPECT_EQ(said(page_of("free-gyro", {{"/motion/duration_s", "3"}})),
            "The page to play with runs this scene, too: it is <code>free gyro</code> there.");
  EXPECT_EQ(said(page_of("free-gyro", {{"/motion/duration_s", "3"}, {"/motion/start_utc", "\"2026-11-22T12:00:00Z\""}})),
            "The page to play with does not run this scene: a page has no places of the Sun and the Moon.");
}

TEST(Gallery, APageOfNoGalleryLeadsNowhere) {
  const TemporaryDirectory dir;
  write_results(run(parse_scenario(read_scenario_source(EARTHTOP_SCENARIOS "/toy-top.json"), {{"/motion/duration_s", "3"}})),
                dir.path() / "run", false);
  EXPECT_EQ(make_report(dir.path() / "run").html.find("class=\"above\""), std::string::npos);
}

// The picture of a study draws the means that its finding tells.
TEST(StudyPicture, DrawsWhatTheFindingTells) {
  using report::Json;
  Json study = Json::parse(R"({"design": {"kind": "grid"}, "points_planned": 4, "points_computed": 4, "points_failed": 0,
    "axes": [{"name": "latitude_deg", "pointers": ["/site/latitude_deg"], "values": [10, 20]},
             {"name": "law", "pointers": ["/contact/law"], "values": ["rolling", "viscous"]}],
    "quantities": [{"name": "drift.axis_final_rad", "path": "drift.axis_final_rad"}],
    "statistics": {"drift.axis_final_rad": {"count": 4, "min": 0.001, "max": 0.004}},
    "marginals": {"latitude_deg": [{"value": "10", "drift.axis_final_rad": {"count": 2, "mean": 0.001}},
                                   {"value": "20", "drift.axis_final_rad": {"count": 2, "mean": 0.004}}],
                  "law": [{"value": "rolling", "drift.axis_final_rad": {"count": 2, "mean": 0.002}},
                          {"value": "viscous", "drift.axis_final_rad": {"count": 2, "mean": 0.003}}]}})");
  const auto told = report::told_means(study);
  ASSERT_TRUE(told);
  EXPECT_EQ(told->setting.key, "latitude_deg");
  std::string picture = report::study_picture(study);
  EXPECT_NE(picture.find("over the latitude"), picture.npos) << picture;
  EXPECT_NE(picture.find("Mean over the other settings"), picture.npos);
  study["marginals"]["latitude_deg"].push_back({{"value", "30"}, {"drift.axis_final_rad", {{"count", 2}, {"mean", 0.003}}}});
  EXPECT_NE(report::study_picture(study), picture);
  study["marginals"]["law"][1]["drift.axis_final_rad"]["mean"] = 0.009;  // now the word moves it more
  picture = report::study_picture(study);
  EXPECT_NE(picture.find("1: rolling; 2: viscous"), picture.npos) << picture;
  // Where no setting does by itself, each point has its bar; without points there is nothing to draw.
  study.erase("marginals");
  EXPECT_EQ(report::study_picture(study), "");
  study["points"] =
      Json::parse(R"([{"drift.axis_final_rad": 0.001}, {"drift.axis_final_rad": null}, {"drift.axis_final_rad": 0.004}])");
  picture = report::study_picture(study);
  EXPECT_EQ(all_matches(picture, "(<path d=\"M[0-9.]* [0-9.]*V)").size(), 2U) << picture;
}

// Each of several settings that are changed one at a time has the change that it makes.
TEST(StudyPicture, ShowsTheChangeOfEachSetting) {
  using report::Json;
  const Json study =
      Json::parse(R"({"design": {"kind": "one_at_a_time"}, "points_planned": 3, "points_computed": 3, "points_failed": 0,
    "axes": [{"name": "tilt_deg", "pointers": ["/release/tilt_deg"], "values": [21]},
             {"name": "spin_rad_s", "pointers": ["/release/spin_rad_s"], "values": [202]}],
    "quantities": [{"name": "drift.axis_final_rad", "path": "drift.axis_final_rad"}],
    "statistics": {"drift.axis_final_rad": {"count": 3, "min": 0.001, "max": 0.004}},
    "points": [{"tilt_deg": null, "spin_rad_s": null, "drift.axis_final_rad": 0.001},
               {"tilt_deg": 21, "spin_rad_s": null, "drift.axis_final_rad": 0.004},
               {"tilt_deg": null, "spin_rad_s": 202, "drift.axis_final_rad": 0.002}],
    "marginals": {"tilt_deg": [{"value": "21", "drift.axis_final_rad": {"count": 1, "mean": 0.004}}],
                  "spin_rad_s": [{"value": "202", "drift.axis_final_rad": {"count": 1, "mean": 0.002}}]}})");
  const auto told = report::told_means(study);
  ASSERT_TRUE(told);
  ASSERT_EQ(told->levels.size(), 2U);
  EXPECT_DOUBLE_EQ(told->levels[0].mean, 0.003);
  EXPECT_DOUBLE_EQ(told->levels[1].mean, 0.001);
  EXPECT_NE(report::study_finding(study).find("the tilt moves the"), std::string::npos) << report::study_finding(study);
  const std::string picture = report::study_picture(study);
  EXPECT_NE(picture.find("Change of the drift"), picture.npos);
  EXPECT_NE(picture.find("1: tilt; 2: spin"), picture.npos) << picture;
  EXPECT_NE(picture.find("Setting that is changed"), picture.npos);
}

/// Whether two drawings differ in no more than the last digit of a coordinate, which depends on the compiler.
bool is_same_drawing(const std::string& a, const std::string& b) {
  const std::regex number(R"(-?[0-9]+\.[0-9]+)");
  if (std::regex_replace(a, number, "") != std::regex_replace(b, number, "")) return false;
  const auto numbers = [&](const std::string& text) { return std::sregex_iterator(text.begin(), text.end(), number); };
  for (std::sregex_iterator at = numbers(a), other = numbers(b), end; at != end && other != end; ++at, ++other)
    if (std::abs(std::stod(at->str()) - std::stod(other->str())) > 0.011) return false;
  return true;
}

// The README's three pictures are the gallery's.
TEST(ReadmePicture, ThreeAreOfTheGallery) {
  const auto text_of = [](const std::string& path) {
    std::ifstream file(std::string(EARTHTOP_TESTS "/../") + path);
    return std::string(std::istreambuf_iterator<char>(file), {});
  };
  const std::string readme = text_of("README.md");
  for (const std::string name : kReadmeScenes) {
    const std::string file = "tools/readme/gallery-" + name + ".svg";
    EXPECT_NE(readme.find(file), readme.npos) << file;
    const std::string drawn = page_of(name).picture;
    EXPECT_TRUE(is_same_drawing(text_of(file), drawn))
        << "make " << file << " again: earthtop gallery gallery --only " << name << " --svg";
  }
}

}  // namespace
}  // namespace earthtop
