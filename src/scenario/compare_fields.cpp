// SPDX-License-Identifier: GPL-3.0-or-later
// Every key of the files that a comparison takes, in the same table form as a scenario's.
#include "scenario/fields.hpp"

namespace earthtop::scenario {
namespace {

using enum FieldKind;

constexpr double kEndless = std::numeric_limits<double>::infinity();
constexpr bool kIsNeeded = true;
constexpr Range kFree = {};
constexpr Range kNotNegative = {0, kEndless, false};
constexpr Range kPositive = {0, kEndless, true};

constexpr Field kMappingFields[] = {
    {"mapping:/$schema", word, "", kFree, "earthtop-mapping-1.json", "\"earthtop-mapping-1.json\"", "version of this format"},
    {"mapping:/about", text, "", kFree, "", "\"\"", "whose output it is"},
    {"mapping:/separator", text, "", kFree, "", "\",\"", "one character between the cells"},
    {"mapping:/comment", text, "", kFree, "", "\"#\"", "one character; lines that begin with it are passed over"},
    {"mapping:/time", object, "", kFree, "", "", "when", kIsNeeded},
    {"mapping:/time/column", text, "", kFree, "", "", "its name in the header line", kIsNeeded},
    {"mapping:/time/unit", word, "", kFree, "s|ms|us|min|h", "\"s\"", "unit"},
    {"mapping:/time/offset_s", number, "s", kFree, "", "0", "added, so that the release is at 0"},
    {"mapping:/quaternion", object, "", kFree, "", "", "attitude"},
    {"mapping:/quaternion/columns", anything, "", kFree, "", "", "names of the four columns", kIsNeeded},
    {"mapping:/quaternion/order", word, "", kFree, "wxyz|xyzw", "\"wxyz\"", "which of them is the scalar part"},
    {"mapping:/quaternion/rotation", word, "", kFree, "body_to_world|world_to_body", "\"body_to_world\"",
     "what it turns: components in body axes into components in world axes, or the reverse"},
    {"mapping:/rates", object, "", kFree, "", "", "angular velocity of the body relative to the laboratory"},
    {"mapping:/rates/columns", anything, "", kFree, "", "", "names of the three columns", kIsNeeded},
    {"mapping:/rates/unit", word, "", kFree, "rad/s|deg/s|rev/s|rpm", "\"rad/s\"", "unit"},
    {"mapping:/rates/axes", word, "", kFree, "body|world", "\"body\"", "whose axes the components are along"},
    {"mapping:/axis", object, "", kFree, "", "", "direction of body axis 3, the spin axis, in world axes"},
    {"mapping:/axis/columns", anything, "", kFree, "", "", "names of the three columns", kIsNeeded},
    {"mapping:/world_axes", anything, "", kFree, "", "\"ENU\"",
     "where the file's world axes x, y, z point: \"ENU\", \"NED\", \"NWU\" (x forward, to the North), \"y-up\" (East, Up, "
     "South) "
     "or three of north, south, east, west, up, down"},
    {"mapping:/body_axes", anything, "", kFree, "", "\"z-spin\"",
     "where the file's body axes point: \"z-spin\" (as here), \"x-forward\" (x is the spin axis, y and z are body axes 1 and "
     "2), "
     "or three of \"1\", \"-1\", \"2\", ..., ours by number"},
    {"mapping:/attitude_error_rad", number, "rad", kNotNegative, "", "",
     "bound on the error of the file's attitudes, where its author states one"},
};

constexpr Field kTolerancesFields[] = {
    {"tolerances:/$schema", word, "", kFree, "earthtop-tolerances-1.json", "\"earthtop-tolerances-1.json\"",
     "version of this format"},
    {"tolerances:/about", text, "", kFree, "", "\"\"", "what they are for"},
    {"tolerances:/profile", word, "", kFree, "bitwise|regression|physics", "\"regression\"",
     "what holds where nothing else is said"},
    {"tolerances:/quantities", anything, "", kFree, "", "{}",
     "by name, e.g. {\"drift_axis_rad\": {\"absolute\": 1e-10, \"relative\": 1e-6, \"bounds\": 2}}: a difference passes up to "
     "the largest of absolute (unit of the quantity), relative x its largest size in the reference, and bounds x the sum of "
     "both error bounds"},
    {"tolerances:/cost", object, "", kFree, "", "{}", "limits of the cost; without them it is reported only"},
    {"tolerances:/cost/steps_ratio", number, "", kPositive, "", "", "most that steps and evaluations may grow by"},
    {"tolerances:/cost/seconds_ratio", number, "", kPositive, "", "", "most that the wall time may grow by"},
};

}  // namespace

std::span<const Field> mapping_fields() { return kMappingFields; }
std::span<const Field> tolerances_fields() { return kTolerancesFields; }

}  // namespace earthtop::scenario
