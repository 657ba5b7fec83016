/// The same mesh everywhere: its topology on the sample models is the one in topology.json, which was made on
/// Debian 12 and holds on Debian 13 too (other compilers, OpenCASCADE, CGAL). After a change to the mesher:
///
///     QUADRILLE_WRITE_TOPOLOGY=1 build/tests/topology_test

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "mesher/quadrille.hpp"
#include "tests/support/process.hpp"

namespace quadrille {
namespace {

using nlohmann::json;

const std::string digests = QUADRILLE_SOURCE_DIR "/tests/topology.json";

/// FNV-1a over numbers.
class Hash {
 public:
  template <class Range>
  void add(const Range& numbers) {
    for (const int number : numbers)
      state_ = (state_ ^ static_cast<std::uint32_t>(number)) * 1099511628211ULL;
  }
  std::string text() const { return fmt::format("{:016x}", state_); }

 private:
  std::uint64_t state_ = 14695981039346656037ULL;
};

/// Counts, and who is joined to whom in which order; no coordinates.
json topology(const ShellMesh& mesh) {
  Hash hash;
  for (const auto& quad : mesh.quads) hash.add(quad);
  for (const auto& middles : mesh.midsides) hash.add(middles);
  hash.add(mesh.quad_faces);
  for (const auto& segment : mesh.segments)
    hash.add(std::vector<int>{segment.nodes[0], segment.nodes[1], segment.middle, segment.edge});
  for (const auto& corner : mesh.corners) hash.add(std::vector<int>{corner.node, corner.vertex});
  return {{"nodes", mesh.points.size()}, {"quads", mesh.quads.size()}, {"connectivity", hash.text()}};
}

json all_topologies() {
  json result;
  std::vector<std::filesystem::path> models;
  for (const auto& entry : std::filesystem::directory_iterator(QUADRILLE_SOURCE_DIR "/examples/models")) {
    const auto ending = entry.path().extension();
    if (ending == ".brep" || ending == ".step") models.push_back(entry.path());
  }
  std::sort(models.begin(), models.end());
  for (const auto& path : models) {
    const CadModel model = CadModel::read(path);
    for (const Strategy strategy : {Strategy::subdivide, Strategy::direct}) {
      for (const int order : {1, 2}) {
        MeshOptions options;
        options.sizing.elements_per_diagonal = 20;
        options.strategy = strategy;
        options.order = order;
        ExecutionContext context(2);
        const char* name = strategy == Strategy::direct ? "direct" : "subdivide";
        result[path.filename().string()][fmt::format("{}, order {}", name, order)] =
            topology(mesh(model, options, context));
      }
    }
  }
  return result;
}

TEST(Topology, IsTheSameEverywhere) {
  const json found = all_topologies();
  if (std::getenv("QUADRILLE_WRITE_TOPOLOGY") != nullptr) test::write_text(digests, found.dump(1) + "\n");
  const json expected = json::parse(test::file_text(digests));
  EXPECT_GE(found.size(), 13u);
  ASSERT_EQ(found.size(), expected.size());
  for (const auto& [model, meshes] : expected.items()) {
    for (const auto& [kind, digest] : meshes.items())
      EXPECT_EQ(found[model][kind], digest) << model << ", " << kind;
  }
}

}  // namespace
}  // namespace quadrille
