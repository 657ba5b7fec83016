#pragma once
/// The settings of a run: one table, from which the command's options, the Python module's arguments, and
/// FreeCAD's properties and panel are made.

#include <filesystem>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "geometry/base/api.hpp"
#include "mesher/options.hpp"

namespace quadrille {

class CadModel;

/// The values of all settings of the table.
struct Settings {
  MeshOptions mesh;             ///< how the model is meshed
  WriteOptions write;           ///< without title and threads, which are not in the table
  double sew = 0;               ///< millimeters, see CadModel::sewn(); 0 = not
  double read_time_limit = 60;  ///< seconds for reading the CAD file; 0 = any
  double time_limit = 0;        ///< seconds for all of the run; 0 = any
  int threads = 0;              ///< 0 = all cores
};

/// What users give: a number, yes or no, a word or file name, names of faces or words, sizes by name.
using SettingValue =
    std::variant<double, bool, std::string, std::vector<std::string>, std::map<std::string, double>>;

/// One entry of the table.
struct QUADRILLE_API Setting {
  /// When it takes effect: while the model is read, while it is meshed, or while files are written.
  enum class Use { read, mesh, write };
  /// Entries of a form that the help tells: read from and written to the sizing options.
  struct EntryList {
    void (*set)(SizingOptions&, const std::vector<std::string>&);  ///< throws Error (usage) on bad entries
    std::vector<std::string> (*get)(const SizingOptions&);         ///< as set() takes them
  };
  /// The same for one text.
  struct Text {
    void (*set)(SizingOptions&, const std::string&);  ///< throws Error (usage) on a bad text
    std::string (*get)(const SizingOptions&);         ///< as set() takes it
  };
  /// Where its value is kept, which tells what it takes: a number, a whole number, yes or no, a word of
  /// `choices` (Strategy, MshVersion, Gradation), a file, faces, sizes on faces, edges and vertices, several
  /// words of `choices`, entries, a text.
  using Place = std::variant<
      double& (*)(Settings&), int& (*)(Settings&), bool& (*)(Settings&), Strategy& (*)(Settings&),
      std::filesystem::path& (*)(Settings&), std::vector<int>& (*)(Settings&), SizingOptions& (*)(Settings&),
      MshVersion& (*)(Settings&), GroupKinds& (*)(Settings&), Gradation& (*)(Settings&), EntryList, Text>;

  std::string_view name;      ///< as Python has it; messages of the library give it in backquotes
  std::string_view option;    ///< as the command has it, without the two hyphens
  std::string_view property;  ///< as FreeCAD has it; empty = not there
  std::string_view label;     ///< in FreeCAD's panel; empty = not there
  Use use = Use::mesh;        ///< what it is for
  std::string_view unit;      ///< "mm", "s" or empty
  double low = 0 /**< least value */, high = 0; /**< largest */
  bool above_low = false;                       ///< `low` itself is not taken
  std::string_view otherwise;                   ///< what holds where it is not given, if that is no value
  std::string_view help;                        ///< a line on it
  Place place;                                  ///< where Settings has it

  std::string_view kind() const;  ///< number, count, flag, choice, file, names, sizes, words, entries, text
  std::vector<std::string_view> choices()
      const;  ///< the words taken; empty unless the kind is choice or words
  SettingValue value(const Settings& settings) const;  ///< as it is set
};

/// The table, in the order in which users read it.
QUADRILLE_API const std::vector<Setting>& all_settings();

/// The entry of that name; null if there is none.
QUADRILLE_API const Setting* find_setting(std::string_view name);

/// The command's option, "--size-min", for a name that sentences of the library have in backquotes: a
/// setting's, or one that recombining and remeshing have besides. Empty for other names.
QUADRILLE_API std::string option_of(std::string_view name);

/// What a text stands for. Throws Error (usage, subject: the setting's name).
QUADRILLE_API SettingValue parse(const Setting& setting, const std::vector<std::string>& texts);

/// Sets it. Throws Error (usage, subject: the setting's name) for a value that it does not take.
QUADRILLE_API void assign(Settings& settings, const Setting& setting, const SettingValue& value);

/// Throws Error (usage, subject: the setting's name) where a value, or two together, make no sense on the
/// model: numbers out of their limits, names that it does not have, lengths larger than it is.
QUADRILLE_API void check(const Settings& settings, const CadModel& model);

/// The table as an array of objects: name, option, property, label, kind, use, unit, default (null: see
/// otherwise), low, high (null: none), above_low, choices, otherwise, help.
QUADRILLE_API nlohmann::ordered_json settings_table();

}  // namespace quadrille
