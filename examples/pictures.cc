// Surfaces and points behind the pictures of docs/figures/: the paper's figures 1, 2 and 5.
//
// Usage: pictures [FOLDER]
// Writes basis_-3.vtp to basis_3.vtp, reference.vtp, rotated.vtp, hexadecapole.vtp, and zone_vertices.csv: the vertices
// of the truncated cube and, for each, the number of its class of glued vertices. scripts/figures draws them.

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <stdexcept>
#include <string>
#include <vector>

#include "octupole/frames/frame.h"
#include "octupole/frames/fundamental_zone.h"
#include "octupole/io/spherical_plot.h"

namespace {

constexpr octupole::SymmetryGroup kGroup = octupole::SymmetryGroup::kOctahedral;

// Where three faces meet in a point of the zone.
std::vector<Eigen::Vector3d> ZoneVertices() {
  const std::vector<octupole::ZoneFace>& faces = octupole::ZoneFaces(kGroup);
  std::vector<Eigen::Vector3d> vertices;
  for (std::size_t i = 0; i < faces.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      for (std::size_t k = 0; k < j; ++k) {
        Eigen::Matrix3d normals;
        normals << faces[i].normal, faces[j].normal, faces[k].normal;
        if (normals.determinant() * normals.determinant() < 1e-6) continue;
        const Eigen::Vector3d distances(faces[i].distance, faces[j].distance, faces[k].distance);
        const Eigen::Vector3d vertex = normals.transpose().inverse() * distances;
        if (octupole::IsInZone(vertex, kGroup, 1e-9)) vertices.push_back(vertex);
      }
    }
  }
  return vertices;
}

void WriteZoneVertices(const std::filesystem::path& path) {
  const std::vector<Eigen::Vector3d> vertices = ZoneVertices();
  std::ofstream file(path);
  file << "x,y,z,class\n";
  std::vector<Eigen::Matrix3d> classes;
  for (const Eigen::Vector3d& vertex : vertices) {
    const Eigen::Matrix3d rotation = octupole::RotationFromRodrigues(vertex);
    std::size_t number = 0;
    while (number < classes.size() && octupole::AngleBetween(classes[number], rotation, kGroup) > 1e-9) ++number;
    if (number == classes.size()) classes.push_back(rotation);
    file << vertex.x() << ',' << vertex.y() << ',' << vertex.z() << ',' << number << '\n';
  }
  if (!file.flush()) throw std::runtime_error("cannot write " + path.string());
  if (vertices.size() != 24 || classes.size() != 6)
    throw std::runtime_error("the zone has not 24 vertices in 6 classes");
}

}  // namespace

int main(int argc, char** argv) try {
  constexpr int kResolution = 48;
  const std::filesystem::path folder = argc > 1 ? argv[1] : ".";
  for (int m = -3; m <= 3; ++m) {
    octupole::WriteSphericalPlot<3>(folder / ("basis_" + std::to_string(m) + ".vtp"), octupole::Octupole::Unit(m + 3),
                                    kResolution);
  }
  const Eigen::Matrix3d frame = Eigen::AngleAxisd(0.6, Eigen::Vector3d(1, 2, 2).normalized()).toRotationMatrix();
  octupole::WriteSphericalPlot<3>(folder / "reference.vtp", octupole::ReferenceHarmonic<3>(), kResolution);
  octupole::WriteSphericalPlot<3>(folder / "rotated.vtp", octupole::HarmonicFromFrame<3>(frame), kResolution);
  octupole::WriteSphericalPlot<4>(folder / "hexadecapole.vtp", octupole::ReferenceHarmonic<4>(), kResolution);
  WriteZoneVertices(folder / "zone_vertices.csv");
} catch (const std::exception& error) {
  std::cerr << "pictures: " << error.what() << '\n';
  return 1;
}
