// SPDX-License-Identifier: GPL-3.0-or-later
/// Numbers as people read them: in a unit of their size, and a number with its error in one unit.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>

namespace earthtop {

/// A unit in which a quantity is told.
struct ReadableUnit {
  std::string_view name;    ///< of an axis: "arcseconds"
  std::string_view symbol;  ///< behind a number, with a space where one belongs: "″", " mm"
  double per_si;            ///< how many of it make a radian or a metre
};

/// The unit for an angle of this size: degrees from one degree upward, then arcseconds, milliarcseconds and microarcseconds.
/// @param size_rad  (rad); arcseconds for 0 and for what is not finite
ReadableUnit angle_unit(double size_rad);
/// The unit for a length of this size: kilometres to nanometres.
ReadableUnit length_unit(double size_m);

/// An angle in the unit of its size, with at least this many digits: "235.19″"; with an exponent
/// only below 1e-4 microarcseconds.
std::string angle_text(double rad, int digits = 5);

/// A part as a share of the whole; nothing where the whole is 0 or either is not finite, and nothing where the share is too large
/// for a number. An error relative to nothing is not said.
std::optional<double> share_of(double part, double whole);

/// Two numbers that a message compares, with at least this many digits, and with as many as tell them apart where they differ.
/// @param style  of fmt: 'g', or 'e' for exponents always
std::pair<std::string, std::string> told_apart(double one, double other, int digits, char style = 'g');
/// A limit as a message gives it: rounded to the side that is allowed, so that who writes the number given is not refused again.
std::string least_text(double least, int digits = 6);
std::string most_text(double most, int digits = 6);

/// The number with the fewest decimal digits that is no farther from a value than its rounding error: 0.3 for a third step of 0.1,
/// which is 0.30000000000000004.   @param error  how far rounding may have moved the value
double meant_number(double value, double error);
/// How far rounding may have moved a value at equal steps (or ratios) between two ends.
double rounding_of_step(double from, double to, bool logarithmic, double value);

/// A time as a reader would write it, without the rounding of its last digits: "32.3 s".
std::string time_text(double t_s);

/// An exponent in raised digits: "⁻⁷".
std::string raised(int exponent);
/// A text in which powers of ten are written as a reader writes them: "5.5e-07" becomes "5.5 × 10⁻⁷", and "1e-07" alone "10⁻⁷". For what
/// is looked at, not for what is copied.
std::string with_powers(std::string_view text);

/// A number that is known to within an error: to the second digit of that error, as far as a double goes.
struct KnownNumber {
  std::string value, error;  ///< in the same unit
};
/// @param value, error  finite, error >= 0, in any common unit   @param digits  of the value where the error is 0
KnownNumber known_number(double value, double error, int digits = 7);

}  // namespace earthtop
