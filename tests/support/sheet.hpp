#pragma once
/// Shells of polygons in a plane.

#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakePolygon.hxx>
#include <BRepBuilderAPI_Sewing.hxx>

#include <array>
#include <memory>
#include <vector>

#include "mesher/quadrille.hpp"

namespace quadrille::testing {

using Polygon = std::vector<std::array<double, 2>>;

/// A shell of polygons in the plane z = 0 that share their edges.
inline CadModel sheet(const std::vector<Polygon>& polygons) {
  BRepBuilderAPI_Sewing sewing(1e-5);
  for (const Polygon& polygon : polygons) {
    BRepBuilderAPI_MakePolygon wire;
    for (const auto& [x, y] : polygon) wire.Add(gp_Pnt(x, y, 0));
    wire.Close();
    sewing.Add(BRepBuilderAPI_MakeFace(wire.Wire()).Face());
  }
  sewing.Perform();
  return CadModel(std::make_shared<CadShape>(sewing.SewedShape(), "sheet"));
}

}  // namespace quadrille::testing
