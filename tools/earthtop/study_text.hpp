/// A study for people: its results as text, its progress as a line.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace earthtop {
struct StudyProgress;
}

namespace earthtop::tool {

/// Of the document that `study_json` makes: points, statistics, means along the axes, fits, indices, figures.
std::string study_text(const nlohmann::ordered_json& document);

/// "12% 1200 of 10000 points, 35.2 a second, 4 min left": for a terminal, no line end.
std::string progress_text(const StudyProgress& progress);

/// "3.2 s", "12 min", "4.5 h", "2.1 days".
std::string duration_text(double seconds);

}  // namespace earthtop::tool
