#include "octupole/io/field_writer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <fstream>
#include <iterator>
#include <sstream>
#include <stdexcept>

#include "octupole/frames/frame.h"
#include "octupole/mesh/box_mesh.h"
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

TEST(WriteFra, WritesTheAxesOfEachTet) {
  const TemporaryFolder folder;
  std::mt19937 generator(2);
  const std::vector<Eigen::Matrix3d> frames = {Eigen::Matrix3d::Identity(), RandomFrame(&generator)};
  WriteFra(folder / "a.fra", frames);
  std::ifstream file(folder / "a.fra");
  std::string format;
  int version = 0, tets = 0, vectors = 0, type = -1;
  file >> format >> version >> tets >> vectors >> type;
  EXPECT_EQ(format, "FRA");
  EXPECT_EQ(std::vector<int>({version, tets, vectors, type}), std::vector<int>({1, 2, 3, 0}));
  for (const Eigen::Matrix3d& frame : frames) {
    for (int k = 0; k < 3; ++k) {
      for (int i = 0; i < 3; ++i) {
        double x = 0;
        file >> x;
        EXPECT_EQ(x, frame(i, k));
      }
    }
  }
  std::string rest;
  EXPECT_FALSE(file >> rest);
  EXPECT_THAT(ReadText(folder / "a.fra"), testing::StartsWith("FRA 1\n2 3 0\n1 0 0\n0 1 0\n0 0 1\n"));
}

TEST(WriteQuaternions, WritesWFirstAndNotNegative) {
  const TemporaryFolder folder;
  std::mt19937 generator(3);
  std::vector<Eigen::Matrix3d> frames = {
      Eigen::AngleAxisd(EIGEN_PI / 3, Eigen::Vector3d::UnitY()).toRotationMatrix(),
      Eigen::AngleAxisd(1.5 * EIGEN_PI, Eigen::Vector3d::UnitZ()).toRotationMatrix()};
  for (int i = 0; i < 50; ++i) frames.push_back(RandomFrame(&generator));
  const ScopedCommaLocale locale;
  WriteQuaternions(folder / "q.txt", frames);
  std::istringstream lines(ReadText(folder / "q.txt"));
  lines.imbue(std::locale::classic());
  Eigen::Quaterniond q;
  for (const Eigen::Matrix3d& frame : frames) {
    lines >> q.w() >> q.x() >> q.y() >> q.z();
    ASSERT_TRUE(lines);
    EXPECT_GE(q.w(), 0);
    EXPECT_NEAR(q.norm(), 1, 1e-15);
    EXPECT_LT((q.toRotationMatrix() - frame).norm(), 1e-14);
  }
  std::string rest;
  EXPECT_FALSE(lines >> rest);
  EXPECT_THROW(WriteQuaternions(folder / "q.txt", {2 * Eigen::Matrix3d::Identity()}), std::invalid_argument);
}

}  // namespace
}  // namespace octupole
