// SPDX-License-Identifier: GPL-3.0-or-later
// Every key of mapping and tolerance files, in the same table form as a scenario's.
#include "compare/fields.hpp"

#include "earthtop/compare/compare.hpp"
#include "input/schema.hpp"

namespace earthtop {
namespace compare {
namespace {

using input::Field, input::Range;
using enum input::FieldKind;

constexpr double kEndless = std::numeric_limits<double>::infinity();
constexpr bool kIsNeeded = true;
constexpr Range kFree = {};
constexpr Range kNotNegative = {0, kEndless, false};
constexpr Range kPositive = {0, kEndless, true};

constexpr Field kMappingFields[] = {
    {"/$schema", word, "", kFree, "earthtop-mapping-1.json", "\"earthtop-mapping-1.json\"", "version of this format"},
    {"/about", text, "", kFree, "", "\"\"", "the program that writes such files"},
    {"/separator", text, "", kFree, "", "\",\"", "the character between the cells"},
    {"/comment", text, "", kFree, "", "\"#\"", "a character; lines that begin with it are skipped"},
    {"/time", object, "", kFree, "", "", "the time of a row", kIsNeeded},
    {"/time/column", text, "", kFree, "", "", "its name in the header line", kIsNeeded},
    {"/time/unit", word, "", kFree, "s|ms|us|min|h", "\"s\"", "unit"},
    {"/time/offset_s", number, "s", kFree, "", "0", "added to the times, so that the release is at 0"},
    {"/time/repeated", word, "", kFree, "refused|first|last", "\"refused\"",
     "which of several rows at one time counts; some tools write one before and one after an event"},
    {"/quaternion", object, "", kFree, "", "", "attitude"},
    {"/quaternion/columns", anything, "", kFree, "", "", "names of the four columns", kIsNeeded},
    {"/quaternion/order", word, "", kFree, "wxyz|xyzw", "\"wxyz\"", "which of them is the scalar part"},
    {"/quaternion/rotation", word, "", kFree, "body_to_world|world_to_body", "\"body_to_world\"",
     "what it turns: components in body axes into components in world axes, or the reverse"},
    {"/rates", object, "", kFree, "", "", "angular velocity of the body relative to the laboratory"},
    {"/rates/columns", anything, "", kFree, "", "", "names of the three columns", kIsNeeded},
    {"/rates/unit", word, "", kFree, "rad/s|deg/s|rev/s|rpm", "\"rad/s\"", "unit"},
    {"/rates/axes", word, "", kFree, "body|world", "\"body\"", "axes along which the components are taken"},
    {"/axis", object, "", kFree, "", "", "direction of body axis 3, the spin axis, in world axes"},
    {"/axis/columns", anything, "", kFree, "", "", "names of the three columns", kIsNeeded},
    {"/world_axes", anything, "", kFree, "", "\"ENU\"",
     "where the file's world axes x, y, z point: \"ENU\", \"NED\", \"NWU\" (x forward, to the North), \"y-up\" (East, Up, "
     "South) or three of north, south, east, west, up, down"},
    {"/body_axes", anything, "", kFree, "", "\"z-spin\"",
     "where the file's body axes point: \"z-spin\" (as here), \"x-forward\" (x is the spin axis, y and z are body axes 1 and "
     "2), or three of \"1\", \"-1\", \"2\", ..., ours by number"},
    {"/attitude_error_rad", number, "rad", kNotNegative, "", "",
     "bound on the error of the file's attitudes, where its author states one"},
};

constexpr Field kTolerancesFields[] = {
    {"/$schema", word, "", kFree, "earthtop-tolerances-1.json", "\"earthtop-tolerances-1.json\"", "version of this format"},
    {"/about", text, "", kFree, "", "\"\"", "what the tolerances are for"},
    {"/profile", word, "", kFree, "bitwise|regression|physics", "\"regression\"",
     "tolerances of the quantities for which none is given"},
    {"/quantities", anything, "", kFree, "", "{}",
     "by name, e.g. {\"drift_axis_rad\": {\"absolute\": 1e-10, \"relative\": 1e-6, \"bounds\": 2}}: a difference passes up to "
     "the largest of absolute (unit of the quantity), relative x its largest size in the reference, and bounds x the sum of "
     "both error bounds"},
    {"/cost", object, "", kFree, "", "{}", "limits on the cost; without them it is only reported"},
    {"/cost/steps_ratio", number, "", kPositive, "", "", "largest ratio allowed of steps and evaluations, new to reference"},
    {"/cost/seconds_ratio", number, "", kPositive, "", "", "largest ratio allowed of the wall time, new to reference"},
};

constexpr input::FieldTable kMappingTable = {"mapping", "mapping file", kMappingFields};
constexpr input::FieldTable kTolerancesTable = {"tolerances", "tolerance file", kTolerancesFields};

}  // namespace

const input::FieldTable& mapping_fields() { return kMappingTable; }
const input::FieldTable& tolerances_fields() { return kTolerancesTable; }

}  // namespace compare

std::string mapping_schema() {
  return input::schema(compare::mapping_fields(), "What the columns of another program's CSV file mean.");
}
std::string mapping_reference_markdown() { return input::reference_markdown(compare::mapping_fields()); }
std::string tolerances_schema() {
  return input::schema(compare::tolerances_fields(), "The differences that a comparison allows, quantity by quantity.");
}
std::string tolerances_reference_markdown() { return input::reference_markdown(compare::tolerances_fields()); }

}  // namespace earthtop
