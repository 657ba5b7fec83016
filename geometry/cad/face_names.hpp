#pragma once
/// The names that faces have in a CAD file, which become groups of the mesh. Internal: users see
/// CadModel::face_names().

#include <TopoDS_Shape.hxx>
#include <map>
#include <set>
#include <string>
#include <utility>

namespace quadrille {

/// Numbers of the faces, from 1, that have a name: their own, or that of their solid or part.
using FaceNames = std::map<std::string, std::set<int>>;

/// A shape as it was read, with the names in its file.
struct NamedShape {
  NamedShape() = default;
  /// \param names_in_file none for formats without names.
  NamedShape(TopoDS_Shape shape_read, FaceNames names_in_file = {})
      : shape(std::move(shape_read)), names(std::move(names_in_file)) {}

  TopoDS_Shape shape;
  FaceNames names;
};

/// Whether a group of ours may have this name, as Face3 or Thickness2.5, whatever the case of its letters.
bool is_own_group(const std::string& name);

/// The names for groups: without those that say nothing (no letter in them, NONE, OpenCASCADE's own) and
/// those of more than 80 bytes, which .med files cannot hold; made printable; with CAD_ before what
/// is_own_group().
FaceNames names_of_groups(const FaceNames& in_file);

}  // namespace quadrille
