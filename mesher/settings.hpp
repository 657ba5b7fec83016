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
#include "geometry/base/number_rule.hpp"
#include "mesher/options.hpp"

namespace quadrille {

class CadModel;

/// The values of all settings of the table.
struct Settings {
  MeshOptions mesh;             ///< how the model is meshed
  WriteOptions write;           ///< how files are written; title and threads are not in the table
  bool imprint = false;         ///< see CadModel::imprinted(), with `sew` as its tolerance
  double sew = 0;               ///< millimeters, see CadModel::sewn(); 0 = not sewn
  double read_time_limit = 60;  ///< seconds for reading the CAD file; 0 = no limit
  double time_limit = 0;        ///< seconds for the whole run; 0 = no limit
  int threads = 0;              ///< 0 = all cores
};

/// A value given by a user: a number, yes or no, a word or file name, names of faces or words, sizes by name.
using SettingValue =
    std::variant<double, bool, std::string, std::vector<std::string>, std::map<std::string, double>>;

/// One entry of the table.
struct QUADRILLE_API Setting {
  /// When the setting takes effect: while the model is read, while it is meshed, or while files are written.
  enum class Use { read, mesh, write };
  /// Accessors of texts, kept in the sizing options; the help describes their form.
  template <class Value>
  struct Accessors {
    void (*set)(SizingOptions&, const Value&);  ///< throws std::invalid_argument
    Value (*get)(const SizingOptions&);         ///< in the form that set() takes
  };
  using EntryList = Accessors<std::vector<std::string>>;  ///< for entries, one text each
  using Text = Accessors<std::string>;                    ///< for one text
  /// Where the value is kept. The type determines what the setting takes: a number, a whole number, yes or
  /// no, one word of `choices` (Strategy, MshVersion, Gradation, InpElement), a file, faces, sizes on faces,
  /// edges and vertices, several words of `choices` (GroupKinds), entries, a text.
  using Place = std::variant<double& (*)(Settings&), int& (*)(Settings&), bool& (*)(Settings&),
                             Strategy& (*)(Settings&), std::filesystem::path& (*)(Settings&),
                             std::vector<int>& (*)(Settings&), SizingOptions& (*)(Settings&),
                             MshVersion& (*)(Settings&), GroupKinds& (*)(Settings&),
                             Gradation& (*)(Settings&), EntryList, Text, InpElement& (*)(Settings&)>;

  std::string_view name;       ///< in Python; library messages quote it in backquotes
  std::string_view option;     ///< of the command, without the two hyphens
  std::string_view property;   ///< in FreeCAD; empty = no such property
  std::string_view label;      ///< in FreeCAD's panel; empty = not in the panel
  Use use = Use::mesh;         ///< when it takes effect
  std::string_view unit;       ///< "mm", "s" or empty
  NumberRule range;            ///< the numbers allowed
  std::string_view otherwise;  ///< describes the default if that is not a plain value
  std::string_view help;       ///< one line that explains the setting
  Place place;                 ///< where Settings keeps the value

  std::string_view kind() const;  ///< number, count, flag, choice, file, names, sizes, words, entries, text
  std::vector<std::string_view> choices()
      const;  ///< the allowed words; empty unless the kind is choice or words
  SettingValue value(const Settings& settings) const;  ///< the current value
};

/// The table, in the order in which users read it.
QUADRILLE_API const std::vector<Setting>& all_settings();

/// The entry of that name; null if there is none.
QUADRILLE_API const Setting* find_setting(std::string_view name);

/// The command's option, such as "--size-min", for a name that library messages quote in backquotes: a
/// setting, or an extra option of recombining and remeshing. Empty for other names.
QUADRILLE_API std::string option_of(std::string_view name);

/// The value that the texts stand for. Throws Error (usage, subject: the setting's name).
QUADRILLE_API SettingValue parse(const Setting& setting, const std::vector<std::string>& texts);

/// Sets a value. Throws Error (usage, subject: the setting's name) if the setting does not allow it.
QUADRILLE_API void assign(Settings& settings, const Setting& setting, const SettingValue& value);

/// Throws Error (usage, subject: the setting's name) if a value, or two values together, make no sense for
/// the model: numbers outside their limits, names that the model does not have, lengths larger than it.
QUADRILLE_API void check(const Settings& settings, const CadModel& model);

/// The model imprinted, then sewn, if the settings request it. Throws Error as those functions of CadModel.
QUADRILLE_API CadModel joined(const Settings& settings, const CadModel& model);

/// The settings with the names of faces, edges and vertices replaced by those in the imprinted model: a name
/// becomes the names of all its pieces. Unchanged for other models. Throws Error (usage) where a number of
/// segments or a bias would go to several pieces. \param model as joined() gives it.
QUADRILLE_API Settings with_pieces(const Settings& settings, const CadModel& model);

/// The table as an array of objects: name, option, property, label, kind, use, unit, default (null: see
/// otherwise), low, high (null: none), above_low, choices, otherwise, help.
QUADRILLE_API nlohmann::ordered_json settings_table();

}  // namespace quadrille
