/// Builds the field of each model several times and prints blocks, memory and time by level.

#include "field.hpp"

#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>
#include <BRepFilletAPI_MakeFillet.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepTools.hxx>
#include <BRep_Tool.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <optional>

#include "geometry/base/threads.hpp"
#include "geometry/cad/cad_model.hpp"
#include "geometry/sizing/sizing_field.hpp"

namespace quadrille {
namespace {

constexpr double length = 1000, width = 400, height = 50, radius = 0.1;

/// Writes the plate to a file; returns its path.
std::string plate_with_fillet(const std::filesystem::path& folder) {
  const TopoDS_Shape box = BRepPrimAPI_MakeBox(length, width, height).Shape();
  BRepFilletAPI_MakeFillet fillet(box);
  for (TopExp_Explorer it(box, TopAbs_EDGE); it.More(); it.Next()) {
    const TopoDS_Edge edge = TopoDS::Edge(it.Current());
    const gp_Pnt a = BRep_Tool::Pnt(TopExp::FirstVertex(edge)), b = BRep_Tool::Pnt(TopExp::LastVertex(edge));
    if (a.Y() == width && b.Y() == width && a.Z() == height && b.Z() == height) {
      fillet.Add(radius, edge);
      break;
    }
  }
  std::string path = (folder / "plate.brep").string();
  BRepTools::Write(fillet.Shape(), path.c_str());
  return path;
}

double peak_megabytes() {
  rusage usage{};
  ::getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024;
}

void print_field(const std::string& path, const SizingOptions& options, int threads, int repeat) {
  const CadModel model = CadModel::read(path);
  const double before = peak_megabytes();
  double seconds = 0;
  std::optional<SizingField> field;
  on_threads(threads, [&] {
    for (int i = 0; i < repeat; ++i) {
      field.reset();
      ExecutionContext context(threads);
      const auto start = std::chrono::steady_clock::now();
      field.emplace(SizingField::build(model, options, context));
      const double now = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
      seconds = i == 0 ? now : std::min(seconds, now);
    }
  });
  fmt::print("{}, gradation {}, sizes {:.3g} to {:.3g} mm\n{:>6}{:>12}{:>10}{:>10}\n",
             std::filesystem::path(path).filename().string(),
             options.gradation == Gradation::surface ? "surface" : "space", field->limits().least,
             field->limits().largest, "level", "voxel mm", "blocks", "MB");
  double megabytes = 0;
  int number = 0;
  for (const SizingField::Level& level : field->levels()) {
    const double own = static_cast<double>(level.bytes) / 1e6;
    megabytes += own;
    fmt::print("{:>6}{:>12.4g}{:>10}{:>10.2f}\n", number++, level.voxel, level.blocks, own);
  }
  fmt::print("{:<28}{:>20.2f}{:>10.3f}  all of it, from the clock; the process grew by {:.0f} MB\n\n",
             "field", megabytes, seconds, peak_megabytes() - before);
}

}  // namespace

void print_fields(const std::vector<std::string>& models, const SizingOptions& options, int threads,
                  int repeat) {
  const std::filesystem::path folder =
      std::filesystem::temp_directory_path() / fmt::format("quadrille-bench-field-{}", ::getpid());
  std::filesystem::create_directory(folder);
  std::vector<std::string> paths = models;
  SizingOptions own = options;
  if (paths.empty()) {
    paths.push_back(plate_with_fillet(folder));
    if (own.size_min == 0) own.size_min = radius / 2;
  }
  for (const std::string& path : paths) {
    for (const Gradation gradation : {Gradation::space, Gradation::surface}) {
      own.gradation = gradation;
      print_field(path, own, threads, repeat);
    }
  }
  std::filesystem::remove_all(folder);
}

}  // namespace quadrille
