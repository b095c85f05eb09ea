// SPDX-License-Identifier: GPL-3.0-or-later
/// The one table of summary.json. It lists every member with its path, its value from a result, what is needed to know the
/// value, and how two results are compared in it. Code that writes a summary, takes one number of it, or compares two summaries
/// reads this table. A figure that is not in it cannot be written, and an entry that states neither how the figure is compared
/// nor why it is not does not compile. Units are in the names.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "earthtop/run.hpp"

namespace earthtop {

/// The kinds of figures: a comparison lets figures of one kind differ by the same rule.
enum class FigureKind {
  not_compared,    ///< its entry says why
  cost,            ///< amount and kind of work: used only by the limits on cost
  word,            ///< a word, which is equal or not
  outcome,         ///< a word about the motion: must be equal in the profile "physics", too
  drift_axis,      ///< has the error bound of the axis drift
  drift_tilt,      ///< the same, plus the effect of the attitudes' errors on the drift's direction
  drift_azimuth,   ///< the bound of the tilt drift, larger near the vertical; an angle modulo 2 pi
  azimuth_rate,    ///< has a bound of its own
  drift_attitude,  ///< has the error bound of the attitude drift
  drift_spin,      ///< has the error bound of the attitude drift; an angle modulo 2 pi
  drift_tip,       ///< has the error bound of the drift of the contact point
  attitude,        ///< has the error bound of the attitudes
  ratio,           ///< relative error of the axis drift
  error,           ///< an error or its bound: only its order of magnitude is compared
  conserved,       ///< change of an invariant
  input,           ///< known to rounding
  derived,         ///< computed from several numbers, known to some digits
  time,            ///< time of an event, or of a growth
  threshold_time,  ///< time of passing the threshold, which has a bound of its own
  event_time       ///< time of an event of the contact, which has a bound of its own
};

/// The part of a run on which a figure depends besides the motion. The figure is compared only if both runs agree in it. The same
/// decides what two runs of unlike lengths have in common: `any` is the same in both, `end` is compared at the earlier end, from
/// the rows, `at_event` up to that end, and the rest is left out.
enum class FigureScope {
  any,       ///< it depends on nothing else: it follows from the scenario or the release
  end,       ///< it depends on the end of the run, and on the motion that led there
  at_event,  ///< it belongs to an event, at a time of its own
  span,      ///< it is told of the whole run, such as a fit, a growth or a verdict
  /// It comes from the motion between release and end, such as a largest value. A result that does not say when its largest drift is
  /// reached has taken it from its rows.
  motion,
  rows  ///< it is a mean over the rows, and depends on which rows there are
};

/// Whether a figure is known from the end of a run alone, or needs rows between release and end.
enum class KnownFrom { end, rows };

/// The forms in which a member stands in the document.
enum class MemberForm {
  value,     ///< a number, a word, a flag, or null
  vector,    ///< an array of three numbers
  words,     ///< an array of words
  document,  ///< JSON of its own
  object,    ///< the members whose paths begin with this one's
  list       ///< an array of objects whose members' paths go on with a star
};

/// One member of summary.json.
struct SummaryMember {
  std::string_view path;  ///< dotted; a star stands for any element of a list
  MemberForm form;
  FigureKind kind;
  FigureScope scope;
  KnownFrom known;
  std::string_view why_not;  ///< why it is not compared; empty where it is
  /// Gives the member's value, vector, words or document. If the member belongs to a list's elements, `element` is the number
  /// of the element. It is called only where the objects and lists that hold the member exist. If it gives a discarded JSON
  /// value, the member is left out.
  nlohmann::ordered_json (*value)(const RunResult&, std::size_t element);
  /// Gives the number of a list's elements, or 1 for an object; none where the result has no such list or object: it is then
  /// null or left out.
  std::optional<std::size_t> (*count)(const RunResult&);
  bool left_out;  ///< whether an object or list that the result does not have is left out instead of being null
  bool of_rows;   ///< a top-level member whose numbers come from the rows: all are null without a row after the release
  /// Whether the figure follows from the scenario alone, so that a summary that was written before there was such a figure needs
  /// none.
  bool of_scenario = false;
  std::string_view of_row = "";  ///< of a figure of the end: the quantity of the last row that it is; empty where it is none
  /// For a figure of an event, the members beside it with the event's time and the bound on that.
  std::string_view event_time = "", event_bound = "";
  /// The member beside it that states its error or the size of what it is made of. A value of zero has no size of its own.
  std::string_view sized_by = "";
};

/// All members in the document's order; an object or a list comes right before what is in it.
std::span<const SummaryMember> summary_members();

/// The member at a dotted path, or the member that contains it. An element of a list is given by its number or its name. Null
/// where there is no such member.
const SummaryMember* find_member(std::string_view path);

/// Whether all that lies at or below a dotted path is known without rows between release and end. False for a whole
/// object or vector: where integrations end their steps at rows, its last digits depend on the rows.
bool is_known_at_the_end(std::string_view path);

/// The part of a result's summary at a dotted path, in which elements of lists are given by their numbers; null where this
/// result has no such member. Only this part of the summary is computed.
nlohmann::ordered_json summary_part(const RunResult& result, std::string_view path);

/// An error message if no run's summary.json can have a member at this dotted path, with a suggestion of the path that was
/// meant; none for a path that some runs have ("drift.secular.azimuth_rate_rad_s", "theory.0.computed").
std::optional<std::string> summary_path_fault(std::string_view path);

/// The dotted path of a member of summary.json that a user names: "drift.axis_final_rad", "/drift/axis_final_rad", or a bare name: of the
/// member that has it nearest to the document's top, or else of a key of the scenario. Anything else is returned as it is.
std::string summary_path(std::string_view given);

}  // namespace earthtop
