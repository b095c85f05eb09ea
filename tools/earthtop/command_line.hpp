// SPDX-License-Identifier: GPL-3.0-or-later
/// The table of verbs and their options. Each is described once: the parser of the command line, --help, shell completion and
/// the manual are all made from it.
#pragma once

#include <functional>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "exit_status.hpp"

namespace earthtop::tool {

/// The work of a verb. @returns the exit status. @throws ScenarioError, ReadError, WriteError, UsageError
using Action = std::function<int()>;

/// The variable that receives an option's value. A bool is a flag: it takes no value.
using Target = std::variant<bool*, int*, unsigned*, double*, std::string*, std::optional<double>*, std::optional<std::string>*,
                            std::vector<std::string>*>;

struct Range {
  double low, high;
};

/// An option ("--out"), or an operand ("SCENARIO"): one whose name has no dashes and which is recognised by its place.
struct Option {
  std::string name;
  Target target;
  std::string help;

  std::string short_name;              ///< "-V", if it has one
  std::string value;                   ///< name of the option's value in the help: "DIR"
  bool is_required = false;            ///< the verb cannot do without it
  bool has_commas = false;             ///< one argument may hold several values, separated by commas
  bool is_json_file = false;           ///< shells complete it to directories and *.json
  std::optional<Range> range;          ///< allowed range of a number
  std::vector<std::string> words;      ///< words to which shells complete it, if any
  bool has_other_words = true;         ///< values other than these words are allowed, too
  std::string group;                   ///< at most one of the options of a group may be given
  std::vector<std::string> conflicts;  ///< names of options that may not be given together with it

  bool is_operand() const { return !name.starts_with('-'); }
  bool is_flag() const { return std::holds_alternative<bool*>(target); }
  /// Whether this option states that it may not be given together with the other one.
  bool excludes(const Option& other) const;
  /// Whether the option may be given several times (each time with one value), or the operand any number of times.
  bool is_repeatable() const { return std::holds_alternative<std::vector<std::string>*>(target); }

  Option& abbreviated(std::string_view text);
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

/// A command line and its purpose, as an example in help and manual.
struct CommandExample {
  std::string command;
  std::string purpose;
};

/// The meaning of an exit status of one verb.
struct VerbStatus {
  ExitStatus status;
  std::string meaning;
};

/// A verb, a verb below another verb, or the program itself.
struct Verb {
  std::string name;
  std::string help;         ///< one line without a full stop
  std::string description;  ///< whole sentences
  std::string group;        ///< title under which the program's overview lists it
  Action action;
  std::vector<Option> options;
  std::vector<Verb> verbs;
  std::vector<CommandExample> examples;
  std::vector<VerbStatus> statuses;  ///< that say more of this verb than kExitStatuses does

  Verb(std::string_view its_name, std::string_view one_line, Action what_it_does);
  /// @returns the option, for setting its other members; valid until the next option is added
  Option& add(std::string_view option, Target target, std::string_view option_help);
  void describe(std::string_view sentences);
  void example(std::string_view command, std::string_view purpose);
  void ends_with(ExitStatus status, std::string_view meaning);
  /// The statuses that the verb can end with, and what they mean: the verb's own meanings, and the general ones of the others.
  std::vector<std::pair<std::string_view, std::string_view>> exit_statuses() const;
};

/// The option that every verb has besides its own.
inline constexpr std::string_view kHelpOption = "--help", kHelpShort = "-h",
                                  kHelpText = "print options, examples and exit statuses, and do nothing";

/// An error in the command line.
class UsageError : public std::runtime_error {
 public:
  /// @param path the words of the verb whose help may be of use
  explicit UsageError(const std::string& what, std::string path = "earthtop")
      : std::runtime_error(what), path_(std::move(path)) {}
  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

/// A verb and the words that name it: "earthtop study merge".
struct NamedVerb {
  const Verb& verb;
  std::string path;
};

struct Request {
  NamedVerb named;   ///< the innermost verb named; the program itself if there is none
  bool is_for_help;  ///< --help was given: nothing else is to be done
};

/// Reads a command line and writes the given values to the options' targets. @throws UsageError
Request read_command_line(const Verb& program, int argc, char** argv);

}  // namespace earthtop::tool
