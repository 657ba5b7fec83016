/// CPU time a quad, relative to a fixed loop in the same run: fails when meshing has become a fifth slower.

#include <gtest/gtest.h>

#include <ctime>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <random>
#include <unordered_map>
#include <vector>

#include "mesher/quadrille.hpp"
#include "tests/support/sample_models.hpp"

namespace quadrille {
namespace {

/// CPU seconds of this thread.
double cpu_seconds() {
  timespec now{};
  ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// CPU seconds of work like a mesher's: sorting, hashing, small allocations, square roots. Never change it:
/// what `usual` below was measured with would no longer be known.
double calibration() {
  const double start = cpu_seconds();
  std::mt19937 random(1);
  double sum = 0;
  for (int round = 0; round < 6; ++round) {
    std::vector<double> values(200000);
    for (double& value : values) value = static_cast<double>(random());
    std::sort(values.begin(), values.end());
    std::unordered_map<std::size_t, std::vector<double>> cells;
    for (const double value : values)
      cells[static_cast<std::size_t>(value) % 50021].push_back(std::sqrt(value));
    for (const auto& [cell, entries] : cells)
      for (const double entry : entries) sum += std::sin(entry) + static_cast<double>(cell);
  }
  EXPECT_TRUE(std::isfinite(sum));
  return cpu_seconds() - start;
}

struct Work {
  double seconds = 0;
  double quads = 0;
};

/// Meshes every sample, without reading it.
Work mesh_samples(const std::vector<CadModel>& models) {
  Work result;
  const double start = cpu_seconds();
  for (const CadModel& model : models) {
    MeshOptions options;
    options.sizing.size = model.diagonal() / 60;
    ExecutionContext context(1);
    result.quads += static_cast<double>(mesh(model, options, context).quads.size());
  }
  result.seconds = cpu_seconds() - start;
  return result;
}

/// If this fails after a change that is worth its time, `usual` becomes what the message says.
TEST(Speed, CpuTimeAQuad) {
  constexpr double usual = 35;  // millionths of a loop a quad
  constexpr double most = 1.2;  // times the usual
  constexpr int repetitions = 5;
  std::vector<CadModel> models;
  for (const SampleModel& model : sample_models()) models.push_back(CadModel::read(model.path()));
  double loop = std::numeric_limits<double>::infinity(), a_quad = loop;
  for (int i = 0; i < repetitions; ++i) {
    loop = std::min(loop, calibration());
    const Work work = mesh_samples(models);
    a_quad = std::min(a_quad, work.seconds / work.quads);
  }
  const double ratio = 1e6 * a_quad / loop;
  RecordProperty("millionths_of_a_loop_a_quad", std::to_string(ratio));
  EXPECT_LT(ratio, most * usual) << "a quad takes " << 1e6 * a_quad << " us and the loop " << loop << " s";
}

}  // namespace
}  // namespace quadrille
