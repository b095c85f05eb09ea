// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/core.h>

#include <algorithm>
#include <memory>

#include "command_line.hpp"
#include "earthtop/scenario/reference.hpp"
#include "output.hpp"
#include "text/shell_word.hpp"
#include "verbs.hpp"

namespace earthtop::tool {
namespace {

/// The words with a space between them.
std::string joined(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : " ") + word;
  return text;
}

std::string set_words() {
  std::string words;
  for (const std::string& pointer : scenario_pointers()) words += fmt::format("{}{}=", words.empty() ? "" : " ", pointer);
  return words;
}

/// The options of a verb, --help among them.
std::vector<Option> options_of(const Verb& verb) {
  static bool unused;
  std::vector<Option> options;
  Option help;
  help.name = kHelpOption;
  help.short_name = kHelpShort;
  help.help = kHelpText;
  help.target = &unused;
  options.push_back(std::move(help));
  for (const Option& option : verb.options)
    if (!option.is_operand()) options.push_back(option);
  return options;
}

std::string option_names(const Verb& verb) {
  std::vector<std::string> names;
  for (const Option& option : options_of(verb)) names.push_back(option.name);
  return joined(names);
}

bool takes_json_files(const Verb& verb) {
  return std::any_of(verb.options.begin(), verb.options.end(), [](const Option& option) { return option.is_json_file; });
}

/// The words that may stand where a verb expects a name.
std::string words_of(const Verb& verb) {
  for (const Option& option : verb.options)
    if (option.is_operand() && !option.words.empty()) return joined(option.words);
  return "";
}

std::string bash_script(const std::vector<Verb>& verbs) {
  std::string names, flags, words;
  for (const Verb& verb : verbs) {
    names += (names.empty() ? "" : " ") + verb.name;
    flags += fmt::format("      {}) words='{}' ;;\n", verb.name, option_names(verb));
    if (takes_json_files(verb))
      words += fmt::format(
          "      {}) COMPREPLY=($(compgen -d -- \"$current\") $(compgen -f -X '!*.json' -- \"$current\")) ;;\n", verb.name);
    else if (const std::string list = words_of(verb); !list.empty())
      words += fmt::format("      {}) words='{}' ;;\n", verb.name, list);
  }
  return fmt::format(
      R"(# Completion of earthtop in bash:  source <(earthtop completion bash)
_earthtop() {{
  local current=${{COMP_WORDS[COMP_CWORD]}} previous=${{COMP_WORDS[COMP_CWORD-1]}} words=''
  COMPREPLY=()
  if [[ $COMP_CWORD -eq 1 ]]; then
    words='{} --help --version'
  elif [[ $previous == --set ]]; then
    compopt -o nospace 2>/dev/null
    words='{}'
  elif [[ $previous == --out ]]; then
    COMPREPLY=($(compgen -d -- "$current"))
  elif [[ $current == -* ]]; then
    case ${{COMP_WORDS[1]}} in
{}    esac
  else
    case ${{COMP_WORDS[1]}} in
{}    esac
  fi
  [[ -z $words ]] || COMPREPLY=($(compgen -W "$words" -- "$current"))
}}
complete -F _earthtop earthtop
)",
      names, set_words(), flags, words);
}

std::string zsh_script(const std::vector<Verb>& verbs) {
  std::string names, flags, words;
  for (const Verb& verb : verbs) {
    names += fmt::format("    '{}:{}'\n", verb.name, within_quotes(verb.help));
    flags += fmt::format("      {}) flags=(", verb.name);
    for (const Option& option : options_of(verb)) flags += fmt::format("'{}:{}' ", option.name, within_quotes(option.help));
    flags += ") ;;\n";
    if (takes_json_files(verb))
      words += fmt::format("      {}) _files -g '*.json' ;;\n", verb.name);
    else if (const std::string list = words_of(verb); !list.empty())
      words += fmt::format("      {}) compadd -- {} ;;\n", verb.name, list);
  }
  return fmt::format(
      R"(#compdef earthtop
# Completion of earthtop in zsh:  source <(earthtop completion zsh)
_earthtop() {{
  local -a verbs flags
  verbs=(
{}  )
  if (( CURRENT == 2 )); then
    _describe 'verb' verbs
  elif [[ $words[CURRENT-1] == --set ]]; then
    compadd -S '' -- {}
  elif [[ $words[CURRENT-1] == --out ]]; then
    _files -/
  elif [[ $PREFIX == -* ]]; then
    case $words[2] in
{}    esac
    _describe 'option' flags
  else
    case $words[2] in
{}    esac
  fi
}}
(( $+functions[compdef] )) && compdef _earthtop earthtop
)",
      names, set_words(), flags, words);
}

std::string fish_script(const std::vector<Verb>& verbs) {
  std::string text =
      "# Completion of earthtop in fish:  earthtop completion fish | source\ncomplete -c earthtop -f\n"
      "complete -c earthtop -n __fish_use_subcommand -s V -l version -d 'print the version'\n";
  for (const Verb& verb : verbs) {
    text += fmt::format("complete -c earthtop -n __fish_use_subcommand -a {} -d '{}'\n", verb.name, within_quotes(verb.help));
    const std::string here = fmt::format("complete -c earthtop -n '__fish_seen_subcommand_from {}'", verb.name);
    if (takes_json_files(verb)) text += fmt::format("{} -k -a '(__fish_complete_suffix .json)'\n", here);
    if (const std::string list = words_of(verb); !list.empty()) text += fmt::format("{} -a '{}'\n", here, list);
    for (const Option& option : options_of(verb)) {
      const std::string letter = option.short_name.empty() ? "" : " -s " + option.short_name.substr(1);
      text += fmt::format("{}{} -l {} -d '{}'", here, letter, option.name.substr(2), within_quotes(option.help));
      if (option.name == "--set")
        text += fmt::format(" -x -a '{}'", set_words());
      else if (option.name == "--out")
        text += " -r -a '(__fish_complete_directories)'";
      else if (!option.is_flag())
        text += " -x";
      text += '\n';
    }
  }
  return text;
}

int completion_verb(const Verb& program, std::string_view shell) {
  const auto& verbs = program.verbs;
  print(shell == "bash" ? bash_script(verbs) : shell == "zsh" ? zsh_script(verbs) : fish_script(verbs));
  return kDone;
}

}  // namespace

Verb describe_completion(const Verb& program) {
  auto shell = std::make_shared<std::string>();
  Verb completion("completion", "print a script with which a shell completes earthtop's command lines",
                  [&program, shell] { return completion_verb(program, *shell); });
  completion.add("SHELL", shell.get(), "bash, zsh or fish").required().one_of({"bash", "zsh", "fish"});
  completion.describe(
      "The script completes verbs, options, names of files and examples, and the JSON pointers that --set takes.");
  completion.example("source <(earthtop completion bash)",
                     "completes in this shell; with the same line in ~/.bashrc, in every shell");
  completion.example("earthtop completion fish > ~/.config/fish/completions/earthtop.fish", "completes in every fish");
  return completion;
}

}  // namespace earthtop::tool
