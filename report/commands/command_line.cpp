#include "report/commands/command_line.h"

#include <cstdlib>
#include <map>

#include "mysim/base/command_line.h"
#include "reference/method.h"
#include "reference/truth/cache.h"

namespace crosscheck {
namespace {

/// Validator that accepts a number or a fraction, with a unit of time if `times` is true, and replaces it by a decimal.
CLI::Validator number(bool zero_allowed, bool times) {
  const auto read = [times](const std::string& text) -> std::optional<double> {
    static const std::map<std::string, double> seconds = {{"s", 1},     {"ms", 1e-3}, {"us", 1e-6},
                                                          {"µs", 1e-6}, {"ns", 1e-9}, {"min", 60}};
    const auto number = number_and_rest(text);
    if (!number) return std::nullopt;
    if (number->second.empty()) return number->first;
    const auto unit = seconds.find(number->second);
    return times && unit != seconds.end() ? std::optional(number->first * unit->second) : std::nullopt;
  };
  return CLI::Validator(
      [=](std::string& text) {
        const std::optional<double> value = read(text);
        if (value && (*value > 0 || (zero_allowed && *value == 0))) {
          text = fmt::format("{}", *value);
          return std::string();
        }
        std::string point = text;
        std::replace(point.begin(), point.end(), ',', '.');
        return fmt::format("expected a finite number {} zero{}, got '{}'{}", zero_allowed ? "not below" : "above",
                           times ? " (s), as in 0.001, 1ms or 1/1000" : "", text.substr(0, 40),
                           point != text && read(point) ? fmt::format("; did you mean '{}'?", point) : "");
      },
      "");
}

/// Throws InputError if a blank follows a comma of --methods: the remaining methods would be taken for scenes.
void require_lists_in_one_word(std::span<const std::string> words) {
  for (size_t i = 1; i + 1 < words.size(); ++i)
    if ((words[i - 1] == "--methods" || words[i - 1] == "--method") && words[i].ends_with(",")) {
      std::string list = words[i];
      for (size_t j = i + 1; j < words.size() && list.ends_with(","); ++j) list += words[j];
      throw InputError(fmt::format("{0}: expected a list without spaces; did you mean `{0} {1}`?", words[i - 1],
                                   list.substr(0, 100)));
    }
}

bool is_method(const std::string& word) {
  try {
    find_method(word);
    return true;
  } catch (const InputError&) {
    return false;
  }
}

/// Throws InputError with the probable command line if a method or number is given in place of a scene.
void require_words_in_place(const CLI::App& command, std::span<const std::string> words) {
  const auto named = [&](std::initializer_list<const char*> names) -> std::string {
    for (const char* name : names)
      if (command.get_option_no_throw(name)) return name;
    return "";
  };
  if (named({"SCENE", "scenes"}).empty()) return;
  const auto shipped = shipped_scenes();
  std::string scenes, options, stray, kind;
  for (size_t i = 0; i < words.size(); ++i) {
    const std::string& word = words[i];
    if (word.starts_with("-")) {
      const CLI::Option* option = command.get_option_no_throw(word.substr(0, word.find('=')));
      if (!option) return;  // reported elsewhere
      options += " " + shell_quote(word);
      if (option->get_items_expected_max() > 0 && word.find('=') == std::string::npos && i + 1 < words.size())
        options += " " + shell_quote(words[++i]);
      continue;
    }
    const bool file = word.ends_with(".toml") || std::filesystem::exists(word);
    if (file || std::find(shipped.begin(), shipped.end(), word) != shipped.end()) {
      scenes += " " + shell_quote(word);
      continue;
    }
    const auto read = number_and_rest(word);
    const bool number = read && (read->second.empty() || read->second == "%");
    const std::string option = number            ? named({"--tolerance", "--step"})
                               : is_method(word) ? named({"--method", "--methods", "--to"})
                                                 : "";
    if (option.empty()) continue;
    options += fmt::format(" {} {}", option, shell_quote(word));
    stray = word, kind = number ? "a number" : "a method";
  }
  if (stray.empty()) return;
  throw InputError(fmt::format("{}: '{}' is {}, not a scene; did you mean `crosscheck {}{}{}`?", command.get_name(),
                               stray.substr(0, 30), kind, command.get_name(), scenes.empty() ? " SCENE" : scenes,
                               options));
}

void require_known_command(const CLI::App& app, const std::string& word) {
  std::vector<std::string> known;
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; })) {
    if (command->get_name() == word) return;
    if (!command->get_group().empty()) known.push_back(command->get_name());
  }
  if (word == "help" || word == "version")
    throw InputError(fmt::format("unknown command '{0}'; did you mean `crosscheck --{0}`?", word));
  if (word == "test") throw InputError("test: run `./crosscheck test` in a source tree");
  throw InputError(unknown_name("command", word, known, "crosscheck --help"));
}

}  // namespace

std::optional<std::pair<double, std::string>> number_and_rest(const std::string& text) {
  char* end = nullptr;
  double value = std::strtod(text.c_str(), &end);
  if (end == text.c_str() || !std::isfinite(value)) return std::nullopt;
  if (*end == '/') {
    const char* below = end + 1;
    value /= std::strtod(below, &end);
    if (end == below || !std::isfinite(value)) return std::nullopt;
  }
  std::string rest(end);
  std::erase(rest, ' ');
  return std::pair{value, rest};
}

void require_output_file(const std::filesystem::path& file) {
  std::error_code unknown;
  if (std::filesystem::is_directory(file, unknown))
    throw InputError(fmt::format("-o {}: expected the name of a file, got a folder", file.string()));
  require_writable(file.has_parent_path() ? file.parent_path() : ".");
}

CLI::Validator above_zero() { return number(false, false); }
CLI::Validator time_above_zero() { return number(false, true); }
CLI::Validator time_not_below_zero() { return number(true, true); }

void add_quick_and_full(CLI::App& command, bool& full) {
  auto* quick = command.add_flag("--quick")->description("few scenes and measurements (default)");
  command.add_flag("--full", full, "more scenes, more measurements and finer pictures")->excludes(quick);
}

std::string program_and_version() { return "crosscheck " CROSSCHECK_VERSION; }

int run_command_line(std::span<const AddCommand> commands, int argc, char** argv) {
  std::vector<std::string> words(argv, argv + argc);
  words[0] = "crosscheck";
  Invocation call{shell_join(words)};
  CLI::App app{
      "Crosscheck compares physics engines on mass-spring and cloth scenes: mysim, Bullet, and your own programs."};
  const std::string id = build_id();
  app.set_version_flag("--version", program_and_version() + (id.empty() ? "" : " (build " + id.substr(0, 12) + ")"),
                       "the version of this program");
  app.require_subcommand(1);
  for (const AddCommand add : commands) add(app, call);
  if (argc > 1 && argv[1][0] != '-') {
    require_known_command(app, argv[1]);
    require_lists_in_one_word(words);
    require_words_in_place(*app.get_subcommand(argv[1]), std::span(words).subspan(2));
  }
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& done) {
    return app.exit(done);
  } catch (const CLI::ParseError& error) {
    throw InputError(usage_error("crosscheck", app, error));
  }
  return call.status;
}

}  // namespace crosscheck
