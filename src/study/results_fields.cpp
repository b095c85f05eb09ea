// SPDX-License-Identifier: GPL-3.0-or-later
// Every key of the document of a study's results, in the same table form as a study file's.
#include "earthtop/study/run_study.hpp"
#include "input/fields.hpp"
#include "input/schema.hpp"

namespace earthtop {
namespace study {
namespace {

using input::Field, input::Range;

namespace results {
using enum input::FieldKind;
constexpr bool kAlways = true;
constexpr Range kAny = {};
constexpr Range kCount = {0, 9007199254740992, false};

constexpr Field kFields[] = {
    {"/$schema", word, "", kAny, "earthtop-study-results-1.json", "", "version of this format", kAlways},
    {"/name", text, "", kAny, "", "", "the study's name", kAlways},
    {"/title", text, "", kAny, "", "", "its title, purpose and finding, as its file has them", kAlways},
    {"/purpose", text, "", kAny, "", "", "what it is for", kAlways},
    {"/finding", text, "", kAny, "", "", "what it showed", kAlways},
    {"/design", object, "", kAny, "", "", "which points were computed", kAlways},
    {"/design/kind", word, "", kAny, "grid|random|latin_hypercube|sobol|one_at_a_time", "", "kind of the design", kAlways},
    {"/design/seed", number, "", kCount, "", "", "seed of a drawn design", kAlways},
    {"/design/indices", flag, "", kAny, "", "", "whether Sobol indices were computed", kAlways},
    {"/points_planned", number, "", kCount, "", "", "number of points of the design", kAlways},
    {"/points_computed", number, "", kCount, "", "", "number of points in the store", kAlways},
    {"/points_failed", number, "", kCount, "", "", "number of those among them that failed", kAlways},
    {"/statuses", anything, "", kAny, "", "", "number of points by status", kAlways},
    {"/failures", anything, "", kAny, "", "", "an array of the first points that failed, at most 20: point, status, reason",
     kAlways},
    {"/axes", list, "", kAny, "", "", "what was varied", kAlways},
    {"/axes/*", object, "", kAny, "", "", "one axis"},
    {"/axes/*/name", text, "", kAny, "", "", "name of its column", kAlways},
    {"/axes/*/pointers", anything, "", kAny, "", "", "the scenario's keys that were varied, an array of JSON pointers",
     kAlways},
    {"/axes/*/range", object, "", kAny, "", "", "equal steps"},
    {"/axes/*/range/from", anything, "", kAny, "", "", "first value, one number for each pointer", kAlways},
    {"/axes/*/range/to", anything, "", kAny, "", "", "last value", kAlways},
    {"/axes/*/range/points", number, "", kCount, "", "", "how many values; 0 where the design draws them", kAlways},
    {"/axes/*/log_range", object, "", kAny, "", "", "instead: equal ratios"},
    {"/axes/*/log_range/from", anything, "", kAny, "", "", "first value, one number for each pointer", kAlways},
    {"/axes/*/log_range/to", anything, "", kAny, "", "", "last value", kAlways},
    {"/axes/*/log_range/points", number, "", kCount, "", "", "how many values; 0 where the design draws them", kAlways},
    {"/axes/*/values", anything, "", kAny, "", "", "instead: the listed values of the first pointer, at most 500"},
    {"/quantities", list, "", kAny, "", "", "what was collected", kAlways},
    {"/quantities/*", object, "", kAny, "", "", "one quantity"},
    {"/quantities/*/name", text, "", kAny, "", "", "name of its column", kAlways},
    {"/quantities/*/path", text, "", kAny, "", "", "dotted path in summary.json", kAlways},
    {"/statistics", anything, "", kAny, "", "",
     "for each quantity that has numbers: count, mean, standard_deviation, min, quantile_05, median, quantile_95, max",
     kAlways},
    {"/marginals", anything, "", kAny, "", "",
     "for each axis of at most 500 values: an array of objects with value, the axis's label, and for each quantity count, "
     "mean, "
     "standard_deviation, quantile_05, median, quantile_95; the quantiles are null beyond 150,000 numbers (points times "
     "quantities times such axes)",
     kAlways},
    {"/fits", anything, "", kAny, "", "",
     "an array of the fitted curves: kind, axis, quantity, law, points, a, b, their standard errors and the residual, null "
     "where "
     "there is none",
     kAlways},
    {"/indices", anything, "", kAny, "", "",
     "for each quantity and axis: first_order and total_order, Sobol indices, each with its _standard_error"},
    {"/indices_basis", anything, "", kAny, "", "",
     "for each quantity: base_points (planned, _computed, _used), points, points_without_value and their share, basis in "
     "words, sentence on "
     "what matters; warning where points are left out; no_indices, the reason, where there are none"},
    {"/indices_note", text, "", kAny, "", "", "why the design gives no indices"},
    {"/derivative_indices", anything, "", kAny, "", "",
     "for each drift of which derivatives were collected, and each axis: the mean of squared derivatives, and the bound on the "
     "total index"},
    {"/derivative_notes", anything, "", kAny, "", "", "an array of sentences on derivatives without such an index"},
    {"/points", anything, "", kAny, "", "",
     "an array of the points: point, its number, each axis and quantity by name, null in an empty cell, and status; study.json "
     "has "
     "null where there are more than 1000, study export --json has all, and a reason for those that failed",
     kAlways},
    {"/figures", anything, "", kAny, "", "",
     "an array of the figures known from elsewhere: figure, value, tolerance, origin, computed, difference, met", kAlways},
    {"/provenance", object, "", kAny, "", "", "what made the results", kAlways},
    {"/provenance/study_sha256", text, "", kAny, "", "", "identity of design, axes, quantities and base", kAlways},
    {"/provenance/base", text, "", kAny, "", "", "file of the base", kAlways},
    {"/provenance/version", text, "", kAny, "", "", "version of earthtop", kAlways},
    {"/provenance/commit", text, "", kAny, "", "", "commit of its source", kAlways},
    {"/provenance/compiler", text, "", kAny, "", "", "compiler", kAlways},
    {"/provenance/flags", text, "", kAny, "", "", "its flags", kAlways},
    {"/provenance/libraries", anything, "", kAny, "", "", "versions of libraries by name", kAlways},
    {"/files", anything, "", kAny, "", "", "in study.json: checksums of the files beside it"},
    {"/checksum", text, "", kAny, "", "", "checksum of the document itself"},
};
constexpr input::FieldTable kTable = {"study-results", "document of a study's results", kFields};
}  // namespace results

}  // namespace
}  // namespace study

std::string study_results_schema() {
  return input::schema(study::results::kTable,
                       "The results of a study: study.json, and what study show --json and study export "
                       "--json print.");
}
std::string study_results_reference_markdown() { return input::reference_markdown(study::results::kTable); }

}  // namespace earthtop
