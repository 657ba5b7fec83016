/// The module libquadrille_med.so: MED 4 (Salome, code_aster, FreeCAD), by libmed. Families carry the groups
/// Face3, Edge7, Vertex2.

// Debian's med.h declares functions for MPI, which are not called here, without including its header.
using MPI_Comm = void*;
using MPI_Info = void*;
#include <med.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <map>
#include <string>

#include "geometry/base/error.hpp"
#include "geometry/base/module_loader.hpp"
#include "mesher/io/modules.hpp"

namespace quadrille {

namespace {

void check(med_int status, const char* what) {
  if (status < 0) throw failure(what, std::string("libmed could not write ") + what);
}

/// A MED file in memory. AtomicFile writes it to disk later, since its error messages are sentences.
class MemoryFile {
 public:
  MemoryFile() {
    id_ = MEDmemFileOpen("quadrille.med", &image_, MED_FALSE, MED_ACC_CREAT);
    if (id_ < 0) throw failure("", "libmed could not make a file in memory");
  }
  ~MemoryFile() {
    if (id_ >= 0) MEDfileClose(id_);
    std::free(image_.app_image_ptr);
  }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;

  med_idt id() const { return id_; }

  std::string_view close() {
    const med_err status = MEDfileClose(id_);
    id_ = -1;
    check(status, "the file");
    return {static_cast<const char*>(image_.app_image_ptr), image_.app_image_size};
  }

 private:
  med_memfile image_ = MED_MEMFILE_INIT;
  med_idt id_ = -1;
};

/// Family numbers of nodes (dimension 0), segments (1) and shell elements (2), as MED defines them: positive
/// for nodes, negative for elements; 0 = in no group.
using Families = std::array<std::vector<med_int>, 3>;

/// Elements of one geometric type, written together.
struct ElementTable {
  std::vector<med_int> nodes, families;
};

class MedWriter {
 public:
  MedWriter(med_idt file, const OutputMesh& mesh, const std::string& name)
      : file_(file), mesh_(mesh), name_(name.substr(0, MED_NAME_SIZE)) {}

  void write(const std::string& description, const std::string& unit) const {
    make_mesh(description.substr(0, MED_COMMENT_SIZE), unit);
    const Families families = make_families();
    write_nodes(families[0]);
    for (const int dimension : {1, 2}) write_elements(dimension, families[dimension]);
  }

 private:
  void make_mesh(const std::string& description, const std::string& unit) const {
    std::string axes(3 * MED_SNAME_SIZE, ' '), units(3 * MED_SNAME_SIZE, ' ');
    for (int i = 0; i < 3; ++i) {
      axes.replace(i * MED_SNAME_SIZE, 1, 1, static_cast<char>('x' + i));
      units.replace(i * MED_SNAME_SIZE, unit.size(), unit);
    }
    check(MEDmeshCr(file_, name_.c_str(), 3, 3, MED_UNSTRUCTURED_MESH, description.c_str(), "", MED_SORT_DTIT,
                    MED_CARTESIAN, axes.c_str(), units.c_str()),
          "the mesh");
  }

  /// \param groups names of the groups to which the family belongs, at least one.
  void make_family(const std::vector<std::string>& groups, med_int number) const {
    std::string family = "FAM_" + std::to_string(number) + "_" + groups.front();
    // The name of a family is a path in the file.
    std::replace(family.begin(), family.end(), '/', '_');
    family.resize(std::min<std::size_t>(family.size(), MED_NAME_SIZE));
    std::string names;
    for (const std::string& group : groups) {
      names += group.substr(0, MED_LNAME_SIZE);
      names.resize((names.size() + MED_LNAME_SIZE - 1) / MED_LNAME_SIZE * MED_LNAME_SIZE, '\0');
    }
    check(MEDfamilyCr(file_, name_.c_str(), family.c_str(), number, static_cast<med_int>(groups.size()),
                      names.c_str()),
          "a family");
  }

  /// The names of the groups to which an entity belongs, including that of its thickness.
  std::vector<std::string> names_of(int dimension, int entity) const {
    std::vector<std::string> names;
    mesh_.for_each_group([&](int of, const NamedGroup& group) {
      if (of == dimension && std::binary_search(group.entities.begin(), group.entities.end(), entity))
        names.push_back(group.name);
    });
    return names;
  }

  Families make_families() const {
    check(MEDfamilyCr(file_, name_.c_str(), "FAMILLE_ZERO", 0, 0, ""), "a family");
    Families families{std::vector<med_int>(mesh_.nodes().size(), 0), std::vector<med_int>(mesh_.count(1), 0),
                      std::vector<med_int>(mesh_.shell_count(), 0)};
    med_int last_node = 0, last_element = 0;
    for (const int dimension : {0, 2, 1})
      for (const CadGroup& entity : mesh_.entities(dimension)) {
        if (entity.number == 0) continue;
        const std::vector<std::string> names = names_of(dimension, entity.number);
        if (names.empty()) continue;
        const med_int family = dimension == 0 ? ++last_node : --last_element;
        make_family(names, family);
        for (const int i : entity.members)
          families[dimension][dimension == 0 ? mesh_.number(mesh_.corner_node(i)) - 1 : i] = family;
      }
    return families;
  }

  void write_nodes(const std::vector<med_int>& families) const {
    std::vector<double> coordinates;
    coordinates.reserve(3 * mesh_.nodes().size());
    for (const int node : mesh_.nodes())
      for (const double coordinate : mesh_.position(node)) coordinates.push_back(coordinate);
    check(MEDmeshNodeCoordinateWr(file_, name_.c_str(), MED_NO_DT, MED_NO_IT, 0.0, MED_FULL_INTERLACE,
                                  static_cast<med_int>(mesh_.nodes().size()), coordinates.data()),
          "the nodes");
    write_family_numbers(MED_NODE, MED_NO_GEOTYPE, families);
  }

  void write_family_numbers(med_entity_type entity, med_geometry_type type,
                            const std::vector<med_int>& numbers) const {
    check(MEDmeshEntityFamilyNumberWr(file_, name_.c_str(), MED_NO_DT, MED_NO_IT, entity, type,
                                      static_cast<med_int>(numbers.size()), numbers.data()),
          "the families");
  }

  /// Writes the segments or the shell elements, with families as they are numbered.
  void write_elements(int dimension, const std::vector<med_int>& families) const {
    std::map<int, ElementTable> tables;  // by number of nodes
    for (int i = 0; i < mesh_.count(dimension); ++i) {
      const ElementNodes element = mesh_.element_nodes(dimension, i);
      ElementTable& table = tables[element.count];
      for (const int node : element) table.nodes.push_back(mesh_.number(node));
      table.families.push_back(families[i]);
    }
    for (const auto& [nodes, table] : tables) {
      const med_geometry_type type = 100 * dimension + nodes;  // MED_SEG2 is 102, MED_QUAD8 208
      check(MEDmeshElementConnectivityWr(file_, name_.c_str(), MED_NO_DT, MED_NO_IT, 0.0, MED_CELL, type,
                                         MED_NODAL, MED_FULL_INTERLACE,
                                         static_cast<med_int>(table.families.size()), table.nodes.data()),
            "the elements");
      write_family_numbers(MED_CELL, type, table.families);
    }
  }

  med_idt file_;
  const OutputMesh& mesh_;
  std::string name_;
};

}  // namespace

}  // namespace quadrille

QUADRILLE_EXPORT const char* quadrille_med_version() {
  return QUADRILLE_VERSION;
}

QUADRILLE_EXPORT std::string quadrille_med_file(const quadrille::OutputMesh& mesh, const std::string& name,
                                                const std::string& description, const std::string& unit,
                                                std::string& bytes) try {
  quadrille::MemoryFile file;
  quadrille::MedWriter(file.id(), mesh, name).write(description, unit);
  bytes = file.close();
  return {};
} catch (const std::exception& error) {
  return quadrille::sentence_of(error);
}
