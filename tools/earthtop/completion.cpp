#include <fmt/format.h>
#include <fmt/ranges.h>

#include <memory>

#include "earthtop/scenario/reference.hpp"
#include "examples.hpp"
#include "output.hpp"
#include "verbs.hpp"

namespace earthtop::tool {
namespace {

struct Flag {
  std::string name;  // with its dashes
  std::string help;
  bool takes_value;
};

struct Verb {
  std::string name;
  std::string help;
  std::vector<Flag> flags;
  bool takes_files;
};

constexpr const char* kShells[] = {"bash", "zsh", "fish"};

/// The verbs as the command line knows them.
std::vector<Verb> verbs_of(const CLI::App& app) {
  std::vector<Verb> verbs;
  for (const CLI::App* sub : app.get_subcommands([](const CLI::App*) { return true; })) {
    Verb verb{sub->get_name(), sub->get_description(), {}, false};
    for (const CLI::Option* option : sub->get_options()) {
      if (option->get_positional())
        verb.takes_files = verb.takes_files || (option->get_name() == "SCENARIO" || option->get_name() == "STUDY");
      for (const std::string& name : option->get_lnames())
        verb.flags.push_back({"--" + name, option->get_description(), option->get_items_expected_max() > 0});
    }
    verbs.push_back(std::move(verb));
  }
  return verbs;
}

std::string example_names() {
  std::string names;
  for (const Example& example : examples()) names += fmt::format("{}{}", names.empty() ? "" : " ", example.name);
  return names;
}

std::string set_words() {
  std::string words;
  for (const std::string& pointer : scenario_pointers()) words += fmt::format("{}{}=", words.empty() ? "" : " ", pointer);
  return words;
}

/// For a single-quoted string of the shells; a colon would end a name in zsh.
std::string quoted(std::string text) {
  for (std::size_t at = 0; (at = text.find('\'', at)) != std::string::npos; at += 4) text.replace(at, 1, "'\\''");
  return text;
}

std::string flag_names(const Verb& verb) {
  std::string names;
  for (const Flag& flag : verb.flags) names += (names.empty() ? "" : " ") + flag.name;
  return names;
}

/// What stands where a file or a name is expected: shell code for each verb.
std::string words_of(const Verb& verb) {
  if (verb.name == "example") return example_names();
  if (verb.name == "completion") return fmt::format("{}", fmt::join(kShells, " "));
  return "";
}

std::string bash_script(const std::vector<Verb>& verbs) {
  std::string names, flags, words;
  for (const Verb& verb : verbs) {
    names += (names.empty() ? "" : " ") + verb.name;
    flags += fmt::format("      {}) words='{}' ;;\n", verb.name, flag_names(verb));
    if (verb.takes_files)
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
    names += fmt::format("    '{}:{}'\n", verb.name, quoted(verb.help));
    flags += fmt::format("      {}) flags=(", verb.name);
    for (const Flag& flag : verb.flags) flags += fmt::format("'{}:{}' ", flag.name, quoted(flag.help));
    flags += ") ;;\n";
    if (verb.takes_files)
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
      "complete -c earthtop -n __fish_use_subcommand -l version -d 'what was built, from what and how'\n";
  for (const Verb& verb : verbs) {
    text += fmt::format("complete -c earthtop -n __fish_use_subcommand -a {} -d '{}'\n", verb.name, quoted(verb.help));
    const std::string here = fmt::format("complete -c earthtop -n '__fish_seen_subcommand_from {}'", verb.name);
    if (verb.takes_files) text += fmt::format("{} -k -a '(__fish_complete_suffix .json)'\n", here);
    if (const std::string list = words_of(verb); !list.empty()) text += fmt::format("{} -a '{}'\n", here, list);
    for (const Flag& flag : verb.flags) {
      text += fmt::format("{} -l {} -d '{}'", here, flag.name.substr(2), quoted(flag.help));
      if (flag.name == "--set")
        text += fmt::format(" -x -a '{}'", set_words());
      else if (flag.name == "--out")
        text += " -r -a '(__fish_complete_directories)'";
      else if (flag.takes_value)
        text += " -x";
      text += '\n';
    }
  }
  return text;
}

}  // namespace

void add_completion(CLI::App& app, Action& action) {
  auto shell = std::make_shared<std::string>();
  CLI::App* completion = app.add_subcommand("completion", "print a script that completes earthtop's command lines");
  completion->add_option("SHELL", *shell, "bash, zsh or fish")
      ->required()
      ->check(CLI::IsMember(std::vector<std::string>(std::begin(kShells), std::end(kShells))));
  completion->callback([&app, &action, shell] {
    action = [&app, shell] {
      const auto verbs = verbs_of(app);
      print(*shell == "bash" ? bash_script(verbs) : *shell == "zsh" ? zsh_script(verbs) : fish_script(verbs));
      return static_cast<int>(kDone);
    };
  });
}

}  // namespace earthtop::tool
