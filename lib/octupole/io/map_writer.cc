#include "octupole/io/map_writer.h"

#include <charconv>
#include <cstdint>
#include <ostream>
#include <stdexcept>
#include <string>

#include "octupole/io/atomic_file.h"
#include "octupole/io/vtu_writer.h"

namespace octupole {
namespace {

// The shortest digits that read back as the same numbers, one after the other.
class Numbers {
 public:
  explicit Numbers(std::ostream* out) : out_(*out) {}

  template <typename Number>
  void Write(Number x, char after) {
    constexpr int kMaxLength = 32;
    char text[kMaxLength];
    char* end = std::to_chars(text, text + kMaxLength - 1, x).ptr;
    *end++ = after;
    out_.write(text, end - text);
  }

 private:
  std::ostream& out_;
};

void CheckSize(const char* caller, const TetMesh& mesh, const CornerParameters& parameters) {
  if (parameters.size() == mesh.tets.size()) return;
  throw std::invalid_argument(std::string(caller) + ": parameters for " + std::to_string(parameters.size()) +
                              " tetrahedra, not " + std::to_string(mesh.tets.size()));
}

}  // namespace

void WriteHexEx(const std::filesystem::path& path, const TetMesh& mesh, const CornerParameters& parameters) {
  CheckSize("WriteHexEx", mesh, parameters);
  WriteFileAtomically(path, [&](std::ostream& out) {
    Numbers numbers(&out);
    numbers.Write(mesh.points.size(), '\n');
    for (const Eigen::Vector3d& p : mesh.points) {
      for (int k = 0; k < 3; ++k) numbers.Write(p[k], k < 2 ? ' ' : '\n');
    }
    numbers.Write(mesh.tets.size(), '\n');
    for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
      for (const int v : mesh.tets[t]) numbers.Write(v, ' ');
      for (int i = 0; i < 12; ++i) numbers.Write(parameters[t][i / 3][i % 3], i < 11 ? ' ' : '\n');
    }
  });
}

void WriteMapVtu(const std::filesystem::path& path, const TetMesh& mesh, const MapCut& cut,
                 const CornerParameters& parameters) {
  CheckSize("WriteMapVtu", mesh, parameters);
  TetMesh open;
  open.points.resize(cut.num_nodes);
  open.tets = cut.nodes;
  open.regions = mesh.regions;
  std::vector<Eigen::Vector3d> values(cut.num_nodes);
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    for (int i = 0; i < 4; ++i) {
      open.points[cut.nodes[t][i]] = mesh.points[mesh.tets[t][i]];
      values[cut.nodes[t][i]] = parameters[t][i];
    }
  }
  WriteVtu(path, open, {{"parameters", 3, values.empty() ? nullptr : values[0].data()}});
}

void WriteObstacles(const std::filesystem::path& path, const TetMesh& mesh, const std::vector<MapObstacle>& obstacles) {
  std::vector<int> lines, tets;
  std::vector<std::int32_t> kinds, numbers;
  const auto add = [&](std::size_t number) {
    kinds.push_back(static_cast<std::int32_t>(obstacles[number].kind));
    numbers.push_back(static_cast<std::int32_t>(number));
  };
  for (std::size_t i = 0; i < obstacles.size(); ++i) {
    for (const auto& edge : obstacles[i].edges) {
      lines.insert(lines.end(), edge.begin(), edge.end());
      add(i);
    }
  }
  for (std::size_t i = 0; i < obstacles.size(); ++i) {
    for (const int t : obstacles[i].tets) {
      tets.insert(tets.end(), mesh.tets[t].begin(), mesh.tets[t].end());
      add(i);
    }
  }
  WriteVtu(path, mesh.points,
           {{VtuCellType::kLine, lines.data(), lines.size() / 2}, {VtuCellType::kTet, tets.data(), tets.size() / 4}},
           {}, {{"obstacle", 1, kinds.data()}, {"number", 1, numbers.data()}});
}

}  // namespace octupole
