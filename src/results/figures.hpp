// SPDX-License-Identifier: GPL-3.0-or-later
/// The one table of summary.json: every member with its path, its value from a result, what is needed to know it, and how two
/// results are compared in it. What writes a summary, takes one number of it, or compares two of them reads this table; a
/// figure that is not in it cannot be written, and one that says neither how it is compared nor why it is not does not compile.
/// Units are in the names.
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
  cost,            ///< work and how it was done: only limits on the cost look at it
  word,            ///< equal or not
  outcome,         ///< a word about the motion: equal, in the profile "physics", too
  drift_axis,      ///< has the error bound of the axis drift
  drift_tilt,      ///< the same, and what the attitudes' errors make of the drift's direction
  drift_azimuth,   ///< that at the axis's distance from the vertical; an angle modulo 2 pi
  azimuth_rate,    ///< the same, over the duration
  drift_attitude,  ///< has the error bound of the attitude drift
  drift_spin,      ///< the same; an angle modulo 2 pi
  attitude,        ///< has the error bound of the attitudes
  ratio,           ///< relative error of the axis drift
  error,           ///< an error or its bound: of its size counts the order of magnitude
  conserved,       ///< change of an invariant
  input,           ///< known to rounding
  derived,         ///< of several numbers, to some digits
  time,            ///< of an event, or of a growth
  threshold_time   ///< the same, with a bound of its own
};

/// Figures whose value hangs on more than the motion are compared only where that is the same in both runs.
enum class FigureScope {
  any,  ///< it hangs on nothing else
  end,  ///< it hangs on the end of the run, and what led there
  rows  ///< it is a maximum or a mean of the rows, and hangs on which there are
};

/// Whether a run without rows between release and end knows a figure as well.
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
  /// Gives a value, vector, words or document; of a member of a list's elements that of the element with this number. It is
  /// called only where the objects and lists above the member are there. A member whose value is discarded is left out.
  nlohmann::ordered_json (*value)(const RunResult&, std::size_t element);
  /// Gives the number of a list's elements, 1 for an object; none where the result has no such list or object, which is then
  /// null or left out.
  std::optional<std::size_t> (*count)(const RunResult&);
  bool left_out;  ///< an object or list without which the document has no such member, instead of null
  bool of_rows;   ///< a top-level member that says what rows say: without a row beyond the release all its numbers are null
};

/// All members in the document's order; an object or a list comes right before what is in it.
std::span<const SummaryMember> summary_members();

/// The member that a dotted path leads to or into; of an element of a list its number or its name. None where there is none.
const SummaryMember* find_member(std::string_view path);

/// Whether all that lies at or below a dotted path is known without rows between release and end. A whole object or vector is
/// not taken for it: where integrations end their steps at rows, its last digits are those of a run with rows.
bool is_known_at_the_end(std::string_view path);

/// The part of a result's summary at a dotted path, in which lists' elements are called by their numbers; null where this
/// result has no such member. Nothing else of the summary is computed.
nlohmann::ordered_json summary_part(const RunResult& result, std::string_view path);

/// Why no run's summary.json has a member at this dotted path ("drift.secular.azimuth_rate_rad_s", "theory.0.computed"), with
/// what was probably meant; nothing where a run's may have one. What some runs lack is not at fault.
std::optional<std::string> summary_path_fault(std::string_view path);

}  // namespace earthtop
