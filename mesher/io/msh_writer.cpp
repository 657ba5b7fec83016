/// Gmsh .msh, version 2.2 in ASCII. Based on: the Gmsh reference manual, "MSH file format".

#include "mesher/io/msh_parts.hpp"
#include "mesher/io/writers.hpp"

namespace quadrille {

namespace {

/// The elements of one dimension. In this version an element has one physical number, so like Gmsh this
/// repeats the elements of a mesh that was read, once for each further group.
class ElementLines {
 public:
  ElementLines(const OutputMesh& mesh, const PhysicalNumbers& physical, int dimension, int count)
      : mesh_(mesh), physical_(physical), dimension_(dimension), count_(count) {
    for (int i = 0; i < count && mesh.groups_were_read(); ++i) {
      const std::size_t groups = physical.of_entity(dimension, entity(i)).size();
      for (std::size_t k = 1; k < groups; ++k) repeated_.emplace_back(i, k);
    }
  }

  std::size_t size() const { return count_ + repeated_.size(); }

  /// \param before number of elements in the file before these.
  void write(std::size_t before, TextWriter& out) const {
    write_in_order(size(), out, [&](std::size_t line, TextWriter& to) {
      const bool first = line < static_cast<std::size_t>(count_);
      const auto [i, group] =
          first ? std::pair(static_cast<int>(line), std::size_t{0}) : repeated_[line - count_];
      const std::span<const int> numbers = physical_.of_entity(dimension_, entity(i));
      const ElementNodes element = element_nodes(mesh_, dimension_, i);
      to << before + line + 1 << ' ' << msh_element_type(element, dimension_) << " 2 "
         << (numbers.empty() ? 0 : numbers[group]) << ' ' << entity(i);
      write_msh_nodes(mesh_, element, to);
    });
  }

 private:
  int entity(int i) const {
    return dimension_ == 2 ? mesh_.face(i) : dimension_ == 1 ? mesh_.edge(i) : mesh_.vertex(i);
  }

  const OutputMesh& mesh_;
  const PhysicalNumbers& physical_;
  int dimension_, count_;
  std::vector<std::pair<int, std::size_t>> repeated_;  // element, index into its groups
};

}  // namespace

void write_msh2(const OutputMesh& mesh, TextWriter& out) {
  const PhysicalNumbers physical(mesh, false);
  out << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n";
  write_physical_names(mesh, physical, out);
  out << "$Nodes\n" << mesh.nodes().size() << '\n';
  write_in_order(mesh.nodes().size(), out, [&](std::size_t i, TextWriter& to) {
    to << i + 1 << ' ';
    write_msh_point(mesh.point(static_cast<int>(i)), to);
    to << '\n';
  });
  const ElementLines kinds[] = {{mesh, physical, 0, mesh.corner_count()},
                                {mesh, physical, 1, mesh.segment_count()},
                                {mesh, physical, 2, mesh.shell_count()}};
  out << "$EndNodes\n$Elements\n" << kinds[0].size() + kinds[1].size() + kinds[2].size() << '\n';
  std::size_t before = 0;
  for (const ElementLines& kind : kinds) {
    kind.write(before, out);
    before += kind.size();
  }
  out << "$EndElements\n";
  write_periodic(mesh, false, out);
}

}  // namespace quadrille
