// SPDX-License-Identifier: GPL-3.0-or-later
// The drawing code of the page's engine, compiled for the processor at hand: it fits the library as it is.
#include "../../tools/play/engine/pictures.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "earthtop/results/results.hpp"
#include "earthtop/run.hpp"

namespace earthtop::play {
namespace {

TEST(PlayPictures, AreTheMotionsOwn) {
  const RunResult result =
      run(parse_scenario(read_scenario_source(EARTHTOP_SCENARIOS "/toy-top.json"), {{"/motion/duration_s", "3"}}));
  const nlohmann::json pictures = nlohmann::json::parse("{" + pictures_json(result, summary_json(result)) + "}");
  for (const char* width : {"wide", "narrow"}) {
    const std::string picture = pictures["chart"][width];
    EXPECT_TRUE(picture.starts_with("<svg ")) << width;
    EXPECT_EQ(picture.find("<style>"), picture.npos) << width;
  }
  EXPECT_TRUE(pictures["chart"]["words"].get<std::string>().starts_with("Drawn: the motion at "));
  EXPECT_GT(pictures["motion"]["packed"]["times"]["count"], 100);
}

}  // namespace
}  // namespace earthtop::play
