/// XDMF 3 (dolfinx, ParaView): the shell elements with their CAD face and q, all numbers as text in the file,
/// since a second file of HDF5 could not appear together with it. Based on: the XDMF Model and Format.

#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "mesher/io/mesh_arrays.hpp"

namespace quadrille {

namespace {

/// Writes a DataItem, whose numbers `write` writes. \param type with its precision, as attributes
template <class Write>
void write_item(const char* type, const std::string& dimensions, TextWriter& out, Write write) {
  out << "<DataItem " << type << " Format=\"XML\" Dimensions=\"" << dimensions << "\">\n";
  write();
  out << "</DataItem>\n";
}

constexpr const char* integer = "DataType=\"Int\" Precision=\"4\"";
constexpr const char* real = "DataType=\"Float\" Precision=\"8\"";

void write_topology(const OutputMesh& mesh, TextWriter& out) {
  const int count = mesh.shell_count();
  int least = 9, most = 0, numbers = 0;
  for (int i = 0; i < count; ++i) {
    const int nodes = mesh.element_nodes(2, i).count;
    least = std::min(least, nodes);
    most = std::max(most, nodes);
    numbers += 1 + nodes;
  }
  const bool mixed = least < most;
  out << "<Topology TopologyType=\"" << (mixed ? "Mixed" : element_type(2, most).xdmf)
      << "\" NumberOfElements=\"" << count << "\">\n";
  write_item(integer, mixed ? std::to_string(numbers) : fmt::format("{} {}", count, most), out, [&] {
    write_in_order(count, out, [&](int i, TextWriter& to) {
      const ElementNodes element = mesh.element_nodes(2, i);
      if (mixed) to << element.type().xdmf_code << ' ';
      for (const int node : element) to << mesh.number(node) - 1 << ' ';
      to << '\n';
    });
  });
  out << "</Topology>\n";
}

}  // namespace

void write_xdmf(const Writing& writing, TextWriter& out) {
  const OutputMesh& mesh = writing.output;
  const std::size_t nodes = mesh.nodes().size();
  out << "<?xml version=\"1.0\"?>\n<Xdmf Version=\"3.0\">\n<Domain>\n"
         "<Grid Name=\"mesh\" GridType=\"Uniform\">\n";
  write_topology(mesh, out);
  out << "<Geometry GeometryType=\"XYZ\">\n";
  write_item(real, fmt::format("{} 3", nodes), out, [&] {
    write_in_order(nodes, out, [&](int i, TextWriter& to) { to << mesh.point(i) << '\n'; });
  });
  out << "</Geometry>\n";
  for (const MeshArray& array : mesh_arrays(writing)) {
    out << "<Attribute Name=\"" << array.name << "\" AttributeType=\"Scalar\" Center=\""
        << (array.of_nodes ? "Node" : "Cell") << "\">\n";
    write_item(array.type == MeshArray::Type::real ? real : integer,
               std::to_string(array.of_nodes ? nodes : mesh.shell_count()), out,
               [&] { write_numbers(array, mesh, out); });
    out << "</Attribute>\n";
  }
  out << "</Grid>\n</Domain>\n</Xdmf>\n";
}

}  // namespace quadrille
