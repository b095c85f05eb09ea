// SPDX-License-Identifier: GPL-3.0-or-later
// Every key of a study file, in the same table form as a scenario's.
#include "study/fields.hpp"

#include "earthtop/study/study.hpp"
#include "input/schema.hpp"

namespace earthtop {
namespace study {
namespace {

using input::Field, input::Range;
using enum input::FieldKind;

constexpr double kNoLimit = std::numeric_limits<double>::infinity();
constexpr double kLargestWhole = 9007199254740992;  // beyond it a double skips whole numbers
constexpr bool kNeeded = true;

constexpr Range kAny = {};
constexpr Range kCounts = {1, kLargestWhole, false};

constexpr Field kStudyFields[] = {
    {"/$schema", word, "", kAny, "earthtop-study-1.json", "\"earthtop-study-1.json\"", "version of this format"},
    {"/name", name, "", kAny, "", "", "names the results; default: the file's stem, \"unnamed\" from standard input"},
    {"/title", text, "", kAny, "", "\"\"", "any text"},
    {"/purpose", text, "", kAny, "", "\"\"", "what the study is for"},
    {"/finding", text, "", kAny, "", "\"\"", "what it showed, in a sentence"},
    {"/base", anything, "", kAny, "", "",
     "the scenario that is varied: a file, its path relative to this one, or the scenario itself", kNeeded},
    {"/set", anything, "", kAny, "", "{}",
     "changes to the base for all points: an object of JSON pointers and values, e.g. {\"/motion/duration_s\": 600}"},

    {"/axes", list, "", kAny, "", "", "what is varied, at most 20 of them", kNeeded},
    {"/axes/*", object, "", kAny, "", "", "one axis"},
    {"/axes/*/name", text, "", kAny, "", "",
     "name of its column in the results, made of a-z, 0-9 and _; default: the last key of the pointer"},
    {"/axes/*/pointer", text, "", kAny, "", "", "the scenario's key that is varied, as a JSON pointer"},
    {"/axes/*/pointers", anything, "", kAny, "", "", "instead: several keys, varied together"},
    {"/axes/*/values", anything, "", kAny, "", "",
     "an array of values (numbers, words, true or false, ...); with several pointers, each may be an array with one value for "
     "each pointer"},
    {"/axes/*/range", object, "", kAny, "", "", "instead: equal steps"},
    {"/axes/*/range/from", anything, "", kAny, "", "", "first value; with several pointers, an array may give each its own",
     kNeeded},
    {"/axes/*/range/to", anything, "", kAny, "", "", "last value", kNeeded},
    {"/axes/*/range/points", number, "", kCounts, "", "",
     "how many values, the ends included; not needed where the design draws them"},
    {"/axes/*/log_range", object, "", kAny, "", "", "instead: equal ratios; ends of one sign"},
    {"/axes/*/log_range/from", anything, "", kAny, "", "", "first value", kNeeded},
    {"/axes/*/log_range/to", anything, "", kAny, "", "", "last value", kNeeded},
    {"/axes/*/log_range/points", number, "", kCounts, "", "", "how many values, the ends included"},

    {"/design", object, "", kAny, "", "{}", "which points of the axes' space are computed"},
    {"/design/kind", word, "", kAny, "grid|random|latin_hypercube|sobol|one_at_a_time", "\"grid\"",
     "every combination (the first axis slowest); drawn points; or the base, then each axis by itself"},
    {"/design/points", number, "", kCounts, "", "",
     "for a drawn design: the number of points; for Sobol indices: the number of base points"},
    {"/design/seed", number, "", {0, kLargestWhole, false}, "", "1", "seed of a drawn design; recorded with the results"},
    {"/design/indices", flag, "", kAny, "", "false",
     "for the designs sobol and random: whether to compute (axes + 2) x points runs, and first- and total-order Sobol indices "
     "from "
     "them"},

    {"/collect", anything, "", kAny, "",
     "[\"drift.axis_final_rad\",\"drift.axis_bound_rad\",\"drift.azimuth_final_rad\",\"drift.tilt_final_rad\",\"drift."
     "verdict\"]",
     "an array of paths in summary.json, or {\"name\": ..., \"path\": ...}"},
    {"/rows", word, "", kAny, "needed|all", "\"needed\"",
     "needed: rows between release and end, and sensitivities, are not computed where no quantity depends on them"},

    {"/fits", list, "", kAny, "", "", "curves fitted to the points by least squares"},
    {"/fits/*", object, "", kAny, "", "", "one fit"},
    {"/fits/*/kind", word, "", kAny, "linear|sin_latitude|cos_latitude|logarithmic|power_law", "",
     "y = a + b x; y = a + b sin(x) or a + b cos(x), x in degrees; y = a + b ln|x|; |y| = a |x|^b", kNeeded},
    {"/fits/*/axis", text, "", kAny, "", "", "the axis taken as x", kNeeded},
    {"/fits/*/quantity", text, "", kAny, "", "", "the quantity taken as y", kNeeded},

    {"/figures", list, "", kAny, "", "", "figures known from other sources, against which the results are checked"},
    {"/figures/*", object, "", kAny, "", "", "one figure"},
    {"/figures/*/figure", text, "", kAny, "", "",
     "a JSON pointer into study.json, e.g. /fits/0/b, /statistics/drift.axis_final_rad/max or /points/3/drift.axis_final_rad",
     kNeeded},
    {"/figures/*/value", number, "", kAny, "", "", "the figure", kNeeded},
    {"/figures/*/tolerance", number, "", {0, kNoLimit, true}, "", "", "largest difference allowed", kNeeded},
    {"/figures/*/origin", text, "", kAny, "", "", "where the figure comes from", kNeeded},

    {"/limits", object, "", kAny, "", "{}", "limits on the estimate of the study, which is refused beyond them"},
    {"/limits/points", number, "", kCounts, "", "10000000", "points"},
    {"/limits/core_hours", number, "h", {0, kNoLimit, true}, "", "1000", "time on one core"},
    {"/limits/disk_gb", number, "GB", {0, kNoLimit, true}, "", "20", "size of the store and of the exported table"},
    {"/limits/stops_beyond_estimate", flag, "", kAny, "", "true",
     "whether a point that takes ten times the steps estimated for it ends with step_limit"},
};

constexpr input::FieldTable kTable = {"study", "study", kStudyFields};

}  // namespace

const input::FieldTable& fields() { return kTable; }

}  // namespace study

std::string study_schema() {
  return input::schema(study::fields(),
                       "A base scenario, axes along which its keys are changed, a design that chooses the points, and the "
                       "quantities to collect.");
}
std::string study_reference_markdown() { return input::reference_markdown(study::fields()); }

}  // namespace earthtop
