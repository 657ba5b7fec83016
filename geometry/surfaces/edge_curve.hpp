#pragma once
/// The curve of one CAD edge. Internal.

#include <BRepAdaptor_Curve.hxx>

#include "geometry/cad/cad_shape.hpp"

namespace quadrille {

/// Evaluates an edge's curve in space. Use one object per thread.
class EdgeCurve {
 public:
  explicit EdgeCurve(const CadEdge& edge) : curve_(edge.edge) {}

  Vector3 point(double t) const { return to_vector(curve_.Value(t)); }
  Vector3 derivative(double t) const {
    gp_Pnt p;
    gp_Vec d;
    curve_.D1(t, p, d);
    return to_vector(d);
  }
  /// 1 / length; 0 where the derivative vanishes.
  double curvature(double t) const {
    gp_Pnt p;
    gp_Vec d1, d2;
    curve_.D2(t, p, d1, d2);
    const double speed = d1.Magnitude();
    return speed > 1e-12 ? d1.Crossed(d2).Magnitude() / (speed * speed * speed) : 0;
  }
  bool straight() const { return curve_.GetType() == GeomAbs_Line; }
  /// Whether the curve is a circle or an arc, so that its curvature is constant.
  bool circular() const { return curve_.GetType() == GeomAbs_Circle; }
  /// Number of spans of a piecewise polynomial curve; 1 for others.
  int spans() const {
    return curve_.GetType() == GeomAbs_BSplineCurve ? std::max(1, curve_.NbKnots() - 1) : 1;
  }

 private:
  BRepAdaptor_Curve curve_;
};

}  // namespace quadrille
