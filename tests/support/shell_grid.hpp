#pragma once
/// A structured shell mesh of two faces side by side, made by hand, for the tests of writers and readers.

#include <cmath>

#include "mesher/mesh/mesh_types.hpp"

namespace quadrille::test {

/// Face1 and Face2, each a square of n x n quads and side 1, share Edge2. Edge1, Edge2, Edge3 lie at x = 0,
/// 1, 2; Edge4 and Edge5 at y = 0 and y = 1 of Face1, Edge6 and Edge7 of Face2. Vertex1 .. Vertex3 lie at y =
/// 0, Vertex4 .. Vertex6 at y = 1. \param wave height of z = wave sin(3 x); 0 gives a plane.
class ShellGrid {
 public:
  ShellGrid(int n, int order, double wave = 0.3) : n_(n), columns_(2 * n + 1), wave_(wave) {
    mesh_.order = order;
    add_points();
    add_quads();
    add_segments();
    for (int j = 0; j < 2; ++j)
      for (int i = 0; i < 3; ++i) mesh_.corners.push_back({corner(i * n_, j * n_), 1 + i + 3 * j});
  }

  const ShellMesh& mesh() const { return mesh_; }

 private:
  int corner(int i, int j) const { return j * columns_ + i; }
  int across(int i, int j) const { return columns_ * (n_ + 1) + j * (columns_ - 1) + i; }
  int along(int i, int j) const { return columns_ * (n_ + 1) + (columns_ - 1) * (n_ + 1) + j * columns_ + i; }

  void add_point(double i, double j) {
    const double x = i / n_;
    mesh_.points.push_back({x, j / n_, wave_ * std::sin(3 * x)});
  }

  void add_points() {
    for (int j = 0; j <= n_; ++j)
      for (int i = 0; i < columns_; ++i) add_point(i, j);
    if (mesh_.order == 1) return;
    for (int j = 0; j <= n_; ++j)
      for (int i = 0; i + 1 < columns_; ++i) add_point(i + 0.5, j);
    for (int j = 0; j < n_; ++j)
      for (int i = 0; i < columns_; ++i) add_point(i, j + 0.5);
  }

  void add_quads() {
    for (int j = 0; j < n_; ++j)
      for (int i = 0; i < 2 * n_; ++i) {
        mesh_.quads.push_back({corner(i, j), corner(i + 1, j), corner(i + 1, j + 1), corner(i, j + 1)});
        mesh_.quad_faces.push_back(i < n_ ? 1 : 2);
        if (mesh_.order == 2)
          mesh_.midsides.push_back({across(i, j), along(i + 1, j), across(i, j + 1), along(i, j)});
      }
  }

  void add_segments() {
    const bool second = mesh_.order == 2;
    for (int k = 0; k < 3; ++k)
      for (int j = 0; j < n_; ++j)
        mesh_.segments.push_back(
            {{corner(k * n_, j), corner(k * n_, j + 1)}, second ? along(k * n_, j) : -1, 1 + k});
    for (int k = 0; k < 4; ++k)
      for (int i = 0; i < n_; ++i) {
        const int column = k < 2 ? i : n_ + i, row = k % 2 * n_;
        mesh_.segments.push_back(
            {{corner(column, row), corner(column + 1, row)}, second ? across(column, row) : -1, 4 + k});
      }
  }

  int n_, columns_;
  double wave_;
  ShellMesh mesh_;
};

}  // namespace quadrille::test
