/// quadrille adapt MESH RESULT -o SIZES.vdb: sizes from a solution.

#include <fmt/format.h>

#include <array>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>

#include "geometry/base/atomic_file.hpp"
#include "mesher/adapt/adapt.hpp"
#include "mesher/command/command.hpp"
#include "mesher/quadrille.hpp"

namespace quadrille::command {

namespace {

struct AdaptArguments : RunArguments {
  std::filesystem::path result, before;
  AdaptOptions options;
};

/// The stress peaks in the report on the previous mesh. Throws Error (failure) if the file is not such a
/// report.
std::vector<StressPeak> peaks_in(const std::filesystem::path& report) {
  std::vector<StressPeak> peaks;
  try {
    std::ifstream file(report);
    const auto told = nlohmann::json::parse(file);
    for (const auto& peak : told.at("peaks")) {
      const auto at = peak.at("at").get<std::array<double, 3>>();
      peaks.push_back({Vector3(at.data()), peak.at("stress"), peak.at("size"), peak.at("sharp_corner")});
    }
  } catch (const nlohmann::json::exception&) {
    throw failure(report.string(), fmt::format("{} is not a report of quadrille adapt", report.string()));
  }
  return peaks;
}

/// What has not converged although the error is small enough, one sentence each.
std::vector<std::string> warnings_on(const AdaptResult& result) {
  std::vector<std::string> warnings;
  for (const PeakChange& change : result.changes)
    if (result.is_met) warnings.push_back(change.sentence());
  return warnings;
}

nlohmann::ordered_json report_on(const AdaptResult& result) {
  nlohmann::ordered_json peaks = nlohmann::ordered_json::array(), changes = peaks;
  for (const StressPeak& peak : result.peaks)
    peaks.push_back(
        {{"at", peak.at}, {"stress", peak.stress}, {"size", peak.size}, {"sharp_corner", peak.sharp_corner}});
  for (const PeakChange& change : result.changes)
    changes.push_back(
        {{"at", change.peak.at}, {"change", change.change}, {"singular", change.is_singular()}});
  return {{"error", result.error},
          {"met", result.is_met},
          {"quads", result.quads},
          {"quads_wanted", result.quads_wanted},
          {"error_wanted", result.error_wanted},
          {"size_min", result.least},
          {"size_max", result.largest},
          {"peaks", peaks},
          {"changes", changes},
          {"warnings", warnings_on(result)}};
}

void tell(const AdaptResult& result, const AdaptArguments& arguments) {
  for (const std::string& warning : warnings_on(result)) say("warning: {}", warning);
  print(fmt::format("error        {:.3g} % of the energy norm, with {} quads\n", 100 * result.error,
                    result.quads));
  if (result.is_met)
    return print(fmt::format("target       {:.3g} %: reached, so this mesh can be kept; {} has its sizes\n",
                             100 * arguments.options.error, arguments.outputs.front().string()));
  print(
      fmt::format("target       {:.3g} %, with about {:.0f} quads of {:.3g} to {:.3g} mm\n"
                  "mesh with    --size {:.3g} --size-min {:.3g} --size-field {}\n",
                  100 * result.error_wanted, result.quads_wanted, result.least, result.largest,
                  result.largest, result.least, arguments.outputs.front().string()));
}

void run(const AdaptArguments& arguments) {
  require_usable(arguments, "MESH", {{"RESULT", arguments.result}, {"--before", arguments.before}}, ".vdb");
  report_crashes(arguments.input, "reading");
  ExecutionContext context;
  const CancelOnSignal cancel(context);
  if (arguments.end_with_input) end_with_input();
  AdaptOptions options = arguments.options;
  if (!arguments.before.empty()) options.before = peaks_in(arguments.before);
  const AdaptResult result =
      adapt(read_mesh(arguments.input), arguments.result, arguments.outputs.front(), options, context);
  if (!arguments.report.empty()) write_file(arguments.report, report_on(result).dump(2) + "\n");
  if (!arguments.quiet) tell(result, arguments);
}

}  // namespace

void add_adapt_command(CLI::App& app) {
  auto [command, arguments] =
      add_command<AdaptArguments>(app, "adapt", "sizes for the next mesh from a solution on this one");
  AdaptOptions& options = arguments.options;
  command.add_option("MESH", arguments.input, "mesh that was solved: .inp or .msh")->required();
  command
      .add_option("RESULT", arguments.result,
                  "result of CalculiX with U, with shells expanded to solid elements: .frd or .vtu")
      ->required();
  command.add_option("-o,--output", arguments.outputs, "sizes as OpenVDB grids (.vdb), for --size-field")
      ->required()
      ->expected(1);
  CLI::Option* error =
      command
          .add_option("--error", options.error,
                      "target error of the stresses, relative to their energy norm (default 0.05: 5 %)")
          ->check(number(AdaptOptions::error_rule));
  command.add_option("--count", options.count, "target number of elements, instead of a target error")
      ->excludes(error)
      ->check(number(positive));
  command.add_option("--size-min", options.size_min, "no size below this, in mm")->check(number(positive));
  command.add_option("--size-max", options.size_max, "no size above this, in mm")->check(number(positive));
  command.add_option("--growth", options.growth, "how fast the size may change (default 0.3)")
      ->check(number(positive));
  command.add_option("--poisson", options.poisson, "Poisson's ratio (default 0.3)")
      ->check(number(AdaptOptions::poisson_rule));
  command.add_option("--report", arguments.report, "write error, counts, sizes and stress peaks as JSON");
  command.add_option("--before", arguments.before,
                     "report on the previous mesh: warn of stress peaks that have changed since");
  add_run_options(command, arguments, "print nothing");
}

}  // namespace quadrille::command
