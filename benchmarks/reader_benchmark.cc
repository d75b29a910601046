// How fast files of each format are read: bytes per second of the process's CPU time, the file in the page cache.
//
//   reader_benchmark [FILE ...] [--benchmark_...]
//
// Without files, those of a box of 300,000 tetrahedra with irregular coordinates, written here in every format.
// benchmarks/compare_readers reads the same files with meshio and gmsh.

#include <benchmark/benchmark.h>

#include <filesystem>
#include <random>

#include "mesh_writers.h"
#include "octupole/io/vtu_writer.h"
#include "octupole/mesh/box_mesh.h"
#include "octupole/readers/tet_mesh_reader.h"
#include "test_files.h"

namespace octupole {
namespace {

void BM_Read(benchmark::State& state, const std::filesystem::path& path) {
  for (auto _ : state) {
    benchmark::DoNotOptimize(ReadTetMesh(path));
  }
  std::uintmax_t size = std::filesystem::file_size(path);
  if (path.extension() == ".ele") {
    size += std::filesystem::file_size(std::filesystem::path(path).replace_extension(".node"));
  }
  state.SetBytesProcessed(static_cast<std::int64_t>(state.iterations() * size));
}

TetMesh MakeMesh() {
  TetMesh mesh = MakeBoxMesh({37, 37, 37}, {1, 1, 1});
  std::mt19937 random;
  std::uniform_real_distribution<double> offset(-0.001, 0.001);
  for (auto& point : mesh.points) {
    point += Eigen::Vector3d(offset(random), offset(random), offset(random));
  }
  mesh.regions.assign(mesh.tets.size(), 1);
  return mesh;
}

std::vector<std::filesystem::path> WriteFiles(const TemporaryFolder& folder) {
  const TetMesh mesh = MakeMesh();
  std::vector<std::filesystem::path> paths;
  const auto write = [&](const char* name, const std::string& text) {
    paths.push_back(folder / name);
    WriteText(paths.back(), text);
  };
  write("medit.mesh", MeditText(mesh));
  write("gmsh2_text.msh", GmshFile(mesh, false, Encoding::kText));
  write("gmsh2_binary.msh", GmshFile(mesh, false, Encoding::kLittleEndian));
  write("gmsh4_text.msh", GmshFile(mesh, true, Encoding::kText));
  write("gmsh4_binary.msh", GmshFile(mesh, true, Encoding::kLittleEndian));
  write("vtk3_text.vtk", VtkFile(mesh, false, Encoding::kText));
  write("vtk5_binary.vtk", VtkFile(mesh, true, Encoding::kBigEndian));
  write("text.vtu", VtuFile(mesh, Encoding::kText));
  write("appended.vtu", VtuFile(mesh, Encoding::kLittleEndian));
  paths.push_back(folder / "compressed.vtu");
  WriteVtu(paths.back(), mesh, {});
  const TetGenTexts texts = MakeTetGenTexts(mesh);
  WriteText(folder / "tetgen.node", texts.nodes);
  write("tetgen.ele", texts.elements);
  write("volume.ovm", OpenVolumeMeshText(mesh));
  write("tets.tet", TetText(mesh));
  return paths;
}

}  // namespace
}  // namespace octupole

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  const octupole::TemporaryFolder folder;
  std::vector<std::filesystem::path> paths(argv + 1, argv + argc);
  if (paths.empty()) {
    paths = octupole::WriteFiles(folder);
  }
  for (const std::filesystem::path& path : paths) {
    benchmark::RegisterBenchmark(path.filename().c_str(), octupole::BM_Read, path)->Unit(benchmark::kMillisecond);
  }
  benchmark::RunSpecifiedBenchmarks();
}
