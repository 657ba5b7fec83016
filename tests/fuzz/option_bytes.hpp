#pragma once
/// The first bytes of an input choose the options, the rest is the file.

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "mesher/options.hpp"
#include "mesher/shell/from_triangles.hpp"

namespace quadrille::fuzz {

/// Takes the options off an input. Seeds begin with as many zeros, which choose the defaults at a coarse
/// size.
class OptionBytes {
 public:
  static constexpr std::size_t count = 8;

  OptionBytes(const std::uint8_t* data, std::size_t size)
      : data_(data + std::min(size, count)), size_(size - std::min(size, count)) {
    std::copy(data, data_, bytes_.begin());
  }

  const std::uint8_t* data() const { return data_; }  ///< the file
  std::size_t size() const { return size_; }          ///< of the file

  SizingOptions sizing() const {
    SizingOptions options;
    options.elements_per_diagonal = 5 + bytes_[0] % 16;
    options.elements_per_circle = bytes_[1] % 4 == 0 ? 12 : 8 * (bytes_[1] % 4 - 1);
    options.growth = 0.3 + 0.01 * (bytes_[2] % 128);
    options.gradation = flag(0) ? Gradation::space : Gradation::surface;
    options.proximity = bytes_[3] % 4;
    options.budget.elements = 2e4;
    return options;
  }

  MeshOptions meshing() const {
    MeshOptions options;
    options.sizing = sizing();
    options.strategy = flag(1) ? Strategy::direct : Strategy::subdivide;
    options.order = flag(2) ? 2 : 1;
    options.partial = flag(3);
    options.strict = flag(4);
    options.keep_features = flag(5);
    options.rings = bytes_[4] % 4;
    options.merge_tiny = 0.01 * bytes_[5];
    options.fill_holes = 0.05 * bytes_[6];
    return options;
  }

  FromTrianglesOptions recombining() const {
    FromTrianglesOptions options;
    options.recombine.seed = bytes_[0];
    options.recombine.method = flag(0) ? Method::paper : Method::quality;
    options.recombine.leftovers = flag(2) ? Leftovers::leave : Leftovers::pair;
    options.improve = !flag(3);
    options.merge = flag(4) ? 0.01 * bytes_[1] : -1;
    options.feature_angle = 40 - bytes_[2] % 41;
    return options;
  }

 private:
  bool flag(int bit) const { return (bytes_[count - 1] >> bit & 1) != 0; }

  const std::uint8_t* data_;
  std::size_t size_;
  std::array<std::uint8_t, count> bytes_{};
};

}  // namespace quadrille::fuzz
