// SPDX-License-Identifier: GPL-3.0-or-later
/// The end of the program where memory, threads or stack are lacking.
#pragma once

namespace earthtop::tool {

enum class Lacking { memory, threads };

/// Writes the messages of `report_lacking` beforehand, because there may be no memory for them later, and sets memory aside for
/// clearing up.
/// @param json report as JSON
void prepare_for_exhaustion(bool json);

/// Says what is lacking, on standard error or as JSON on standard output. Allocates nothing.
/// @returns kNumericalFailure
int report_lacking(Lacking what) noexcept;

/// Gives the stacks of this thread and of later ones the room that the program needs, as far as the system's limit allows.
/// @returns false, with a message, if the limit is too low
bool make_room_on_stack();

}  // namespace earthtop::tool
