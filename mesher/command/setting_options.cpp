/// Makes one CLI11 option of each row of the settings, with lists that may be given in several arguments.

#include "mesher/command/setting_options.hpp"

#include <algorithm>
#include <cstddef>
#include <regex>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "geometry/base/error.hpp"
#include "geometry/base/file_access.hpp"
#include "geometry/base/text_parts.hpp"
#include "mesher/io/io.hpp"

namespace quadrille::command {

namespace {

/// "no size goes below this, in mm (default: size / 8)".
std::string help_of(const Setting& setting) {
  std::string text(setting.help);
  if (setting.kind() == "flag") return text;
  if (!setting.unit.empty()) text += fmt::format(", in {}", setting.unit);
  if (!setting.otherwise.empty())
    return text + fmt::format(" (default: {})", with_options(std::string(setting.otherwise)));
  const SettingValue value = setting.value(Settings());
  if (const auto* number = std::get_if<double>(&value)) text += fmt::format(" (default {:g})", *number);
  if (const auto* word = std::get_if<std::string>(&value)) text += fmt::format(" (default {})", *word);
  if (const auto* words = std::get_if<std::vector<std::string>>(&value))
    text += fmt::format(" (of {}; default {})", fmt::join(setting.choices(), ", "), fmt::join(*words, ","));
  return text;
}

/// Whether the setting takes a list, of which each value may be an argument of its own.
bool is_list(const Setting& setting) {
  const std::string_view kind = setting.kind();
  return kind == "names" || kind == "sizes" || kind == "words" || kind == "entries";
}

void add_setting(CLI::App& command, const Setting& setting, RunArguments& target) {
  const std::string option = fmt::format("--{}", setting.option);
  const auto take = [&target, &setting](const std::vector<std::string>& texts) {
    assign(target.settings, setting, parse(setting, texts));
    target.given.insert(setting.name);
  };
  if (setting.kind() == "flag") {
    command.add_flag_callback(
        option, [take] { take({"true"}); }, help_of(setting));
  } else if (is_list(setting)) {
    command.add_option_function<std::vector<std::string>>(option, take, help_of(setting))
        ->delimiter(setting.kind() == "entries" ? '\0' : ',')  // an entry contains commas itself
        ->allow_extra_args(false);
  } else {
    command.add_option_function<std::string>(
        option, [take](const std::string& text) { take({text}); }, help_of(setting));
  }
}

/// Whether an argument is a value of a list, by its form: it may be a file too.
bool is_value_of(const Setting& setting, const std::string& argument) {
  static const std::regex names("Face[0-9]+(,Face[0-9]+)*");
  static const std::regex entries(
      "((Face|Edge|Vertex)[0-9]+=|(box|sphere|cylinder|halfspace):).*|([A-Za-z][A-Za-z0-9_-]*=)?[-+0-9.eE]+"
      "(,[-+0-9.eE]+){2}");
  const std::string_view kind = setting.kind();
  if (kind == "names") return std::regex_match(argument, names);
  if (kind == "sizes" || kind == "entries") return std::regex_match(argument, entries);
  if (kind != "words") return false;
  const auto choices = setting.choices();
  return std::find(choices.begin(), choices.end(), argument.substr(0, argument.find(','))) != choices.end();
}

/// The list that the option of an argument such as `--segments` or `--segments=Edge1=4` sets; null if none.
const Setting* list_of(const std::string& argument) {
  if (!argument.starts_with("--")) return nullptr;
  const std::string_view option = std::string_view(argument).substr(2, argument.find('=') - 2);
  const auto& all = all_settings();
  const auto found =
      std::find_if(all.begin(), all.end(), [&](const Setting& s) { return s.option == option; });
  return found != all.end() && is_list(*found) ? &*found : nullptr;
}

bool is_inp(const std::filesystem::path& path) {
  return lower_ending(path) == ".inp";
}

}  // namespace

CLI::Validator number(const NumberRule& rule) {
  return {[rule](const std::string& text) {
            const std::optional<double> value = exactly<double>(text);
            if (value && rule.allows(*value)) return std::string();
            return fmt::format("must be {}, not '{}'", rule.sentence(), text);
          },
          ""};
}

std::vector<std::string> with_options_repeated(const std::vector<std::string>& arguments) {
  std::vector<std::string> result;
  const Setting* list = nullptr;
  bool has_value = false;
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    const std::string& argument = arguments[i];
    if (argument == "--") {  // only files follow
      result.insert(result.end(), arguments.begin() + static_cast<std::ptrdiff_t>(i), arguments.end());
      break;
    }
    if (argument.starts_with("-")) {
      list = list_of(argument);
      has_value = list != nullptr && argument.find('=') != std::string::npos;
    } else if (list != nullptr && has_value) {
      if (is_value_of(*list, argument)) {
        result.push_back(fmt::format("--{}", list->option));
      } else {
        list = nullptr;
      }
    } else {
      has_value = true;
    }
    result.push_back(argument);
  }
  return result;
}

void add_settings(CLI::App& command, RunArguments& target, const std::set<std::string_view>& names) {
  for (const Setting& setting : all_settings()) {
    if (names.empty() || names.count(setting.name) > 0) add_setting(command, setting, target);
  }
}

void add_model(CLI::App& command, RunArguments& target) {
  command.add_option("IN", target.input, "CAD file: .step, .stp, .iges, .igs, .brep")->required();
}

CLI::Option* add_outputs(CLI::App& command, RunArguments& target, const std::string& help) {
  return command.add_option("-o,--output", target.outputs, help + "; may be given more than once")
      ->required()
      ->allow_extra_args(false);
}

void add_run_options(CLI::App& command, RunArguments& target, const std::string& quiet) {
  command.add_flag("--end-with-input", target.end_with_input,
                   "end the work when standard input closes, for programs that start this one");
  command.add_flag("--quiet", target.quiet, quiet);
}

int order_of(const RunArguments& arguments) {
  if (arguments.given.count("order") > 0) return arguments.settings.mesh.order;
  if (arguments.settings.write.quad_nodes == 9) return 2;
  const int of_element = quadrille::order_of(arguments.settings.write.element);
  const std::vector<std::filesystem::path>& outputs = arguments.outputs;
  if (of_element != 0 && std::any_of(outputs.begin(), outputs.end(), is_inp)) return of_element;
  return std::any_of(outputs.begin(), outputs.end(), is_solver_format) ? 2 : 1;
}

void check_formats(const RunArguments& arguments) {
  const int quad_nodes = arguments.settings.write.quad_nodes, order = order_of(arguments);
  if (quad_nodes == 9 && order == 1)
    throw usage_error("nodes", "`nodes` 9 is for quads of second order: leave out `order` 1");
  for (const std::filesystem::path& output : arguments.outputs) {
    check_format(output, order == 1 ? 4 : quad_nodes);
    if (is_inp(output)) check_element(arguments.settings.write.element, order);
  }
}

std::string with_options(std::string sentence) {
  for (std::size_t start = 0; (start = sentence.find('`', start)) != std::string::npos;) {
    const std::size_t end = sentence.find('`', start + 1);
    if (end == std::string::npos) break;
    const std::string option = option_of(sentence.substr(start + 1, end - start - 1));
    if (option.empty()) {  // a file name may have backquotes too
      start = end;
      continue;
    }
    sentence.replace(start, end + 1 - start, option);
    start += option.size();
  }
  return sentence;
}

}  // namespace quadrille::command
