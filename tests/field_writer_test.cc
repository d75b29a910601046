#include "octupole/field_writer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <stdexcept>

#include "octupole/box_mesh.h"
#include "octupole/frame.h"
#include "random_inputs.h"
#include "test_files.h"

namespace octupole {
namespace {

using testing::HasSubstr;
using testing::Not;

template <int kDegree>
std::string Written(const TetMesh& mesh) {
  std::mt19937 generator(1);
  std::vector<Harmonic<kDegree>> coefficients;
  std::vector<Eigen::Matrix3d> frames;
  for (std::size_t v = 0; v < mesh.points.size(); ++v) {
    frames.push_back(RandomFrame(&generator));
    coefficients.push_back(HarmonicFromFrame<kDegree>(frames.back()));
  }
  const TemporaryFolder folder;
  WriteField<kDegree>(folder / "field.vtu", mesh, coefficients, frames, std::vector<Alignment>(mesh.points.size()));
  std::ifstream file(folder / "field.vtu");
  return {std::istreambuf_iterator<char>(file), {}};
}

// What the numbers are is for WriteVtu's test, and for the tool's, which reads them back with meshio.
TEST(WriteField, NamesItsArrays) {
  TetMesh mesh = MakeBoxMesh({1, 1, 1}, {1, 1, 1});
  const std::string octupoles = Written<3>(mesh);
  for (const char* name : {"frame_x", "frame_y", "frame_z", "octupole", "alignment"}) {
    EXPECT_THAT(octupoles, HasSubstr("Name=\"" + std::string(name) + "\""));
  }
  EXPECT_THAT(octupoles, HasSubstr("NumberOfComponents=\"7\""));
  EXPECT_THAT(octupoles, Not(HasSubstr("region")));
  mesh.regions.assign(mesh.tets.size(), 5);
  const std::string hexadecapoles = Written<4>(mesh);
  EXPECT_THAT(hexadecapoles, HasSubstr("Name=\"hexadecapole\""));
  EXPECT_THAT(hexadecapoles, HasSubstr("NumberOfComponents=\"9\""));
  EXPECT_THAT(hexadecapoles, HasSubstr("Name=\"region\""));
}

TEST(WriteField, WantsOneValueOfEachPerPoint) {
  const TetMesh mesh = MakeBoxMesh({1, 1, 1}, {1, 1, 1});
  const TemporaryFolder folder;
  EXPECT_THROW(WriteField<3>(folder / "field.vtu", mesh, std::vector<Octupole>(8), std::vector<Eigen::Matrix3d>(7),
                             std::vector<Alignment>(8)),
               std::invalid_argument);
}

}  // namespace
}  // namespace octupole
