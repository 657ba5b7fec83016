/// Reads JSON, or HyperMesh's criteria line by line: a number, the name in words, then columns.

#include "mesher/io/limits_reader.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>

#include "geometry/base/error.hpp"
#include "geometry/base/text_parts.hpp"
#include "mesher/io/readers.hpp"

namespace quadrille {
namespace {

using nlohmann::json;

/// Reads one file. Error messages begin with the file's name.
class LimitsReader {
 public:
  explicit LimitsReader(const std::filesystem::path& path) : name_(path.string()) {}

  CriteriaLimits read() {
    const std::string content = whole_file(name_);
    const std::size_t first = content.find_first_not_of(" \t\r\n");
    if (first == std::string::npos) fail("is empty");
    if (content[first] == '{')
      read_json(content);
    else
      read_hypermesh(content);
    return std::move(limits_);
  }

 private:
  [[noreturn]] void fail(const std::string& problem) const {
    throw failure(name_, fmt::format("{}: {}", name_, problem));
  }

  void set(std::size_t criterion, double limit) {
    const CriterionInfo& info = criteria_info[criterion];
    const bool above = info.has_most() || criterion == static_cast<std::size_t>(Criterion::min_length);
    if (!(above ? limit > info.ideal : limit < info.ideal) || !std::isfinite(limit))
      fail(fmt::format("the limit of {} must be {} {}, not {}", info.name, above ? "above" : "below",
                       info.ideal, limit));
    limits_.values[criterion] = limit;
  }

  void read_json(const std::string& text) {
    const json object = json::parse(text, nullptr, false);
    if (!object.is_object()) fail("is not valid JSON: write it as {\"aspect\": 5, \"skew\": 40}");
    for (const auto& [key, value] : object.items()) {
      std::size_t criterion = 0;
      while (criterion < criterion_count && criteria_info[criterion].name != key) ++criterion;
      if (criterion == criterion_count) {
        std::vector<std::string_view> known;
        known.reserve(criteria_info.size());
        for (const CriterionInfo& info : criteria_info) known.push_back(info.name);
        fail(fmt::format("{} is not one of the criteria {}", key, fmt::join(known, ", ")));
      }
      if (value.is_null())
        limits_.values[criterion] = CriteriaLimits::unchecked;
      else if (value.is_number())
        set(criterion, value.get<double>());
      else
        fail(fmt::format("the limit of {} must be a number, or null where it is not to be checked", key));
    }
  }

  /// A line is: number of the criterion, its name in words, then numbers.
  void read_hypermesh(const std::string& text) {
    limits_.values.fill(CriteriaLimits::unchecked);
    std::istringstream lines(text);
    std::string line;
    bool any = false;
    for (int row = 1; std::getline(lines, line); ++row) {
      std::istringstream words(line);
      std::string word, criterion;
      std::vector<double> numbers;
      words >> word;
      if (!exactly<double>(word)) continue;
      while (words >> word) {
        const auto number = exactly<double>(word);
        if (number) numbers.push_back(*number);
        if (!number && numbers.empty()) criterion += (criterion.empty() ? "" : " ") + word;
        if (!number && !numbers.empty()) break;
      }
      any |= read_criterion(criterion, numbers, row);
    }
    if (!any)
      fail(
          "is neither JSON, such as {\"aspect\": 5}, nor a HyperMesh criteria file: no line names a "
          "criterion");
  }

  /// Reads one line. \return false if its criterion is not measured here.
  bool read_criterion(const std::string& criterion, const std::vector<double>& numbers, int row) {
    constexpr std::array<std::string_view, criterion_count> names{
        "aspect ratio",   "warpage",  "skew",  "min angle quad",
        "max angle quad", "jacobian", "taper", "min length"};
    enum Column { checked, weight, ideal, good, warn, fail_limit, worst, columns };
    const auto at = std::find(names.begin(), names.end(), criterion);
    const bool is_checked = !numbers.empty() && numbers[checked] == 1;
    if (at == names.end()) {
      if (is_checked && numbers.size() >= columns) limits_.not_measured.push_back(criterion);
      return false;
    }
    if (numbers.size() < columns)
      fail(fmt::format("line {}: {} needs the columns on, weight, ideal, good, warn, fail and worst", row,
                       criterion));
    if (is_checked) set(static_cast<std::size_t>(at - names.begin()), numbers[fail_limit]);
    return true;
  }

  std::string name_;
  CriteriaLimits limits_;
};

}  // namespace

CriteriaLimits read_limits(const std::filesystem::path& path) {
  return LimitsReader(path).read();
}

}  // namespace quadrille
