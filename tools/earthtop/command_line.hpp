// SPDX-License-Identifier: GPL-3.0-or-later
/// What can be said on the command line: verbs and their options, each described once. Reading a command line, --help, the
/// completion of shells and the manual all take it from here.
#pragma once

#include <functional>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace earthtop::tool {

/// What a verb does. @returns the exit status. @throws ScenarioError, ReadError, WriteError, UsageError
using Action = std::function<int()>;

/// Where what is given goes to. A bool is a flag: it takes no value.
using Target = std::variant<bool*, int*, unsigned*, double*, std::string*, std::optional<double>*, std::optional<std::string>*,
                            std::vector<std::string>*>;

struct Range {
  double low, high;
};

/// An option ("--out") or, if its name has no dashes, an operand ("SCENARIO"): it is known by its place.
struct Option {
  std::string name;
  Target target;
  std::string help;

  std::string value;                   ///< what help calls the value of an option: "DIR"
  bool is_required = false;            ///< the verb cannot do without it
  bool has_commas = false;             ///< several values may stand in one, with commas between them
  bool is_json_file = false;           ///< shells complete it to directories and *.json
  std::optional<Range> range;          ///< of a number
  std::vector<std::string> words;      ///< if any, what shells complete it to
  bool has_other_words = true;         ///< whether it may be something else than these words
  std::string group;                   ///< at most one of the options of a group can be given
  std::vector<std::string> conflicts;  ///< names of options that cannot be given with it

  bool is_operand() const { return !name.starts_with('-'); }
  bool is_flag() const { return std::holds_alternative<bool*>(target); }
  /// Any number of operands; an option with one value that may be given again and again.
  bool is_repeatable() const { return std::holds_alternative<std::vector<std::string>*>(target); }

  Option& called(std::string_view text);
  Option& required();
  Option& with_commas();
  Option& json_file();
  Option& within(double low, double high);
  Option& completed_to(std::vector<std::string> list);
  Option& one_of(std::vector<std::string> list);
  Option& in_group(std::string_view title);
  Option& without(std::string_view other);
};

/// A command line to begin with, and what it does: for the manual.
struct CommandExample {
  std::string command;
  std::string purpose;
};

/// A verb, a verb of a verb, or the program itself.
struct Verb {
  std::string name;
  std::string help;         ///< one line without a full stop
  std::string description;  ///< whole sentences for the manual: what does not fit into one line
  Action action;
  std::vector<Option> options;
  std::vector<Verb> verbs;
  std::vector<CommandExample> examples;

  Verb(std::string_view its_name, std::string_view one_line, Action what_it_does);
  /// @returns what can be said more of it, until the next one is added
  Option& add(std::string_view option, Target target, std::string_view option_help);
  void describe(std::string_view sentences);
  void example(std::string_view command, std::string_view purpose);
};

/// The option that every verb has, beside its own.
inline constexpr std::string_view kHelpOption = "--help", kHelpShort = "-h", kHelpText = "Print this help message and exit";

/// A command line that is not understood.
class UsageError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

struct Request {
  const Verb& verb;  ///< the program itself where none was named
  std::string help;  ///< if not empty, --help was given: this is to be printed, and nothing done
};

/// Reads a command line; the targets of its options get their values. @throws UsageError
Request read_command_line(const Verb& program, int argc, char** argv);

}  // namespace earthtop::tool
