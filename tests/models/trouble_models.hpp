#pragma once
/// Small CAD models, one for each class of trouble that real files bring.

#include <TopoDS_Shape.hxx>
#include <functional>
#include <string>
#include <vector>

namespace quadrille {

struct TroubleModel {
  std::string name;     ///< fit for a file name
  std::string trouble;  ///< in a few words
  std::function<TopoDS_Shape()> make;
  bool closed = false;  ///< a watertight skin
  double area = 0;      ///< of all faces, shared ones once
  int corners = -1;     ///< CAD vertices that must be nodes; -1 = all of the model's
  double diagonal = 0;  ///< 0 = of the bounding box; else what sizes refer to
};

const std::vector<TroubleModel>& trouble_models();

/// Shapes side by side, as files hold the parts of an assembly.
TopoDS_Shape compound(const std::vector<TopoDS_Shape>& parts);

/// A rod of radius 3 in the middle of a sleeve of length 10 that fits it without a gap: two solids that share
/// nothing.
TopoDS_Shape rod_in_sleeve(double length = 30);

/// A square of 20 with a face of 0.01 by 0.00004 at its side, whose edges cross: no element fits there, and
/// it is far below any size.
TopoDS_Shape tiny_cusp();

}  // namespace quadrille
