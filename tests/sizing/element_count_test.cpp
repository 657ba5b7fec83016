/// The number of elements that sizes take, before a mesh or a field is made.

#include "geometry/sizing/element_count.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "geometry/base/error.hpp"
#include "geometry/sizing/sizing_field.hpp"
#include "mesher/quadrille.hpp"
#include "tests/support/sample_models.hpp"

namespace quadrille {
namespace {

TEST(ElementCount, IsTheAreaOverTheSizeSquared) {
  for (const SampleModel& sample : sample_models()) {
    SCOPED_TRACE(sample.name);
    const CadModel model = CadModel::read(sample.path());
    ExecutionContext context;
    const auto samples = sample_faces(model.shape(), FaceFlags(model.face_count(), 1), context);
    const double count = count_elements(samples, [](FaceId, const FaceSample&) { return 0.5; });
    EXPECT_NEAR(count / (4 * model.area()), 1, 0.1);
  }
}

TEST(ElementBudget, RegionsAndSizesOfFacesAreEstimatedBeforeAFieldIsMade) {
  const CadModel model = CadModel::read(sample_model("box").path());
  const FaceFlags used(model.face_count(), 1);
  ExecutionContext context;
  SizingOptions options;
  options.size = model.diagonal() / 20;
  const auto refused = [&] {
    try {
      ElementBudget(model, options, used, context);
    } catch (const Error& error) {
      return std::string(error.what()).find("million") != std::string::npos;
    }
    return false;
  };
  const double area = model.area(), reach = 2 * model.diagonal();
  for (const double share : {0.5, 2.0}) {
    SizeRegion region;
    region.a = model.box_min() - Vector3::Constant(reach);
    region.b = model.box_max() + Vector3::Constant(reach);
    region.size = std::sqrt(area / (share * options.budget.elements));
    options.regions = {region};
    options.budget.blocks = 1e12;
    options.budget.bytes_an_element = 0;
    EXPECT_EQ(refused(), share > 1) << share;
  }
  // A small ball takes what lies in it, and no more.
  const double radius = 0.1 * model.diagonal();
  for (const double share : {0.5, 2.0}) {
    SizeRegion region;
    region.shape = SizeRegion::Shape::sphere;
    region.a = model.box_min();
    region.radius = radius;
    region.size = std::sqrt(0.75 * M_PI * radius * radius / (share * options.budget.elements));
    options.regions = {region};
    EXPECT_EQ(refused(), share > 1) << share;
  }
  options.regions.clear();
  options.face_sizes[1] = 1e-6;
  EXPECT_TRUE(refused());
  options.face_sizes.clear();
  options.budget = Budget();
  options.edge_sizes[1] = 1e-7;
  EXPECT_THROW(SizingField::build(model, options, context), Error);
}

}  // namespace
}  // namespace quadrille
