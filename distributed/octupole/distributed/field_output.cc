#include "octupole/distributed/field_output.h"

#include <petscviewerhdf5.h>

#include <algorithm>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "octupole/distributed/distributed_error.h"
#include "octupole/distributed/internal/petsc.h"
#include "octupole/io/atomic_file.h"
#include "octupole/io/field_writer.h"

namespace octupole {
namespace {

using internal::Check;
using Vector = internal::PetscHandle<Vec, VecDestroy>;
using Viewer = internal::PetscHandle<PetscViewer, PetscViewerDestroy>;

int RankOf(MPI_Comm comm) {
  int rank = 0;
  MPI_Comm_rank(comm, &rank);
  return rank;
}

// Beside the file, on the same file system.
std::filesystem::path TemporaryFor(const std::filesystem::path& path) {
  return path.parent_path() / (".octupole-" + path.filename().string());
}

std::filesystem::path PieceOf(const std::filesystem::path& path, int rank) {
  return path.parent_path() /
         (path.stem().string() + "_" + std::to_string(rank) + path.extension().string().erase(1, 1));
}

// The owned tetrahedra with their points, and the values of these.
template <int kDegree>
void WritePiece(const std::filesystem::path& path, const MeshPart& part, const DistributedField<kDegree>& field) {
  constexpr int kUnused = -1;
  std::vector<int> place(part.mesh.points.size(), kUnused);
  std::vector<Eigen::Vector3d> points;
  std::vector<Harmonic<kDegree>> coefficients;
  std::vector<Eigen::Matrix3d> frames;
  std::vector<Alignment> alignments;
  std::vector<std::int32_t> numbers;
  std::vector<int> corners;
  for (std::size_t t = 0; t < part.num_owned_tets; ++t) {
    for (const int v : part.mesh.tets[t]) {
      if (place[v] == kUnused) {
        place[v] = static_cast<int>(points.size());
        points.push_back(part.mesh.points[v]);
        coefficients.push_back(field.coefficients[v]);
        frames.push_back(field.frames[v]);
        alignments.push_back(field.alignments[v]);
        numbers.push_back(static_cast<std::int32_t>(part.numbers[v]));
      }
      corners.push_back(place[v]);
    }
  }
  std::vector<VtuArray> cell_data;
  if (!part.mesh.regions.empty()) cell_data.push_back({"region", 1, part.mesh.regions.data()});
  WriteField<kDegree>(path, points, {{VtuCellType::kTet, corners.data(), part.num_owned_tets}}, coefficients, frames,
                      alignments, {{"vertex", 1, numbers.data()}}, cell_data);
}

void WriteIndex(std::ostream& out, const std::vector<std::string>& pieces, int degree, bool has_regions) {
  const auto array = [&](const char* type, const std::string& name, int components) {
    out << "<PDataArray type=\"" << type << "\" Name=\"" << name << "\" NumberOfComponents=\"" << components
        << "\"/>\n";
  };
  out << "<?xml version=\"1.0\"?>\n<VTKFile type=\"PUnstructuredGrid\" version=\"1.0\" header_type=\"UInt64\">\n"
      << "<PUnstructuredGrid GhostLevel=\"0\">\n<PPoints>\n";
  array("Float64", "Points", 3);
  out << "</PPoints>\n<PPointData>\n";
  for (const char* axis : {"frame_x", "frame_y", "frame_z"}) array("Float64", axis, 3);
  array("Float64", degree == 3 ? "octupole" : "hexadecapole", degree == 3 ? 7 : 9);
  array("Int32", "alignment", 1);
  array("Int32", "vertex", 1);
  out << "</PPointData>\n<PCellData>\n";
  if (has_regions) array("Int32", "region", 1);
  out << "</PCellData>\n";
  for (const std::string& piece : pieces) out << "<Piece Source=\"" << piece << "\"/>\n";
  out << "</PUnstructuredGrid>\n</VTKFile>\n";
}

// One more than the largest number.
std::int64_t NumNumbers(MPI_Comm comm, const MeshPart& part) {
  std::int64_t end = 0;
  for (const std::int64_t number : part.numbers) end = std::max(end, number + 1);
  MPI_Allreduce(MPI_IN_PLACE, &end, 1, MPI_INT64_T, MPI_MAX, comm);
  return end;
}

std::vector<PetscInt> OwnedNumbers(const MeshPart& part) {
  return {part.numbers.begin(), part.numbers.begin() + static_cast<std::ptrdiff_t>(part.num_owned_points)};
}

void View(MPI_Comm comm, PetscViewer viewer, const char* name, const MeshPart& part, PetscInt block_size,
          const double* values) {
  Vector vector;
  Check(VecCreate(comm, &vector));
  Check(VecSetSizes(vector, PETSC_DECIDE, static_cast<PetscInt>(block_size * NumNumbers(comm, part))));
  Check(VecSetBlockSize(vector, block_size));
  Check(VecSetType(vector, VECSTANDARD));
  Check(PetscObjectSetName(reinterpret_cast<PetscObject>(static_cast<Vec>(vector)), name));
  const std::vector<PetscInt> numbers = OwnedNumbers(part);
  Check(VecSetValuesBlocked(vector, static_cast<PetscInt>(numbers.size()), numbers.data(), values, INSERT_VALUES));
  Check(VecAssemblyBegin(vector));
  Check(VecAssemblyEnd(vector));
  Check(VecView(vector, viewer));
}

std::vector<double> Load(MPI_Comm comm, PetscViewer viewer, const char* name, const MeshPart& part,
                         PetscInt block_size) {
  Vector whole, mine;
  Check(VecCreate(comm, &whole));
  Check(VecSetBlockSize(whole, block_size));
  Check(PetscObjectSetName(reinterpret_cast<PetscObject>(static_cast<Vec>(whole)), name));
  Check(VecLoad(whole, viewer));
  PetscInt size = 0;
  Check(VecGetSize(whole, &size));
  if (const std::int64_t expected = block_size * NumNumbers(comm, part); size != expected) {
    throw std::runtime_error("the field of another mesh: " + std::to_string(size / block_size) +
                             " vertices instead of " + std::to_string(expected / block_size));
  }
  const std::vector<PetscInt> numbers = OwnedNumbers(part);
  const auto num_owned = static_cast<PetscInt>(numbers.size());
  internal::PetscHandle<IS, ISDestroy> from;
  internal::PetscHandle<VecScatter, VecScatterDestroy> scatter;
  std::vector<double> values(block_size * numbers.size());
  Check(ISCreateBlock(PETSC_COMM_SELF, block_size, num_owned, numbers.data(), PETSC_COPY_VALUES, &from));
  Check(VecCreateSeqWithArray(PETSC_COMM_SELF, block_size, block_size * num_owned, values.data(), &mine));
  Check(VecScatterCreate(whole, from, mine, nullptr, &scatter));
  Check(VecScatterBegin(scatter, whole, mine, INSERT_VALUES, SCATTER_FORWARD));
  Check(VecScatterEnd(scatter, whole, mine, INSERT_VALUES, SCATTER_FORWARD));
  return values;
}

}  // namespace

template <int kDegree>
void WritePvtu(MPI_Comm comm, const std::filesystem::path& path, const MeshPart& part,
               const DistributedField<kDegree>& field) {
  int rank = RankOf(comm), num_ranks = 0;
  MPI_Comm_size(comm, &num_ranks);
  const int has_piece = part.num_owned_tets > 0;
  std::vector<int> have_pieces(num_ranks);
  MPI_Allgather(&has_piece, 1, MPI_INT, have_pieces.data(), 1, MPI_INT, comm);
  const std::filesystem::path piece = PieceOf(path, rank);
  try {
    DoTogether(comm, [&] {
      if (has_piece != 0) WritePiece(TemporaryFor(piece), part, field);
    });
  } catch (const DistributedError&) {
    std::error_code ignored;
    std::filesystem::remove(TemporaryFor(piece), ignored);
    throw;
  }
  DoTogether(comm, [&] {
    if (has_piece != 0) std::filesystem::rename(TemporaryFor(piece), piece);
  });
  int has_regions = !part.mesh.regions.empty();
  MPI_Allreduce(MPI_IN_PLACE, &has_regions, 1, MPI_INT, MPI_MAX, comm);
  DoTogether(comm, [&] {
    if (rank > 0) return;
    std::vector<std::string> pieces;
    for (int i = 0; i < num_ranks; ++i) {
      if (have_pieces[i] != 0) pieces.push_back(PieceOf(path, i).filename().string());
    }
    WriteFileAtomically(path, [&](std::ostream& out) { WriteIndex(out, pieces, kDegree, has_regions != 0); });
  });
}

template <int kDegree>
void WriteFieldHdf5(MPI_Comm comm, const std::filesystem::path& path, const MeshPart& part,
                    const DistributedState<kDegree>& state) {
  const std::filesystem::path temporary = TemporaryFor(path);
  const int rank = RankOf(comm);
  // PETSc's message says little of a folder that is not there or not writable.
  DoTogether(comm, [&] {
    if (rank == 0) WriteFileAtomically(temporary, [](std::ostream&) {});
  });
  int has_frames = !state.frames.empty();
  MPI_Allreduce(MPI_IN_PLACE, &has_frames, 1, MPI_INT, MPI_MAX, comm);
  DoTogether(comm, [&] {
    Viewer viewer;
    const PetscInt degree = kDegree, level = state.level;
    Check(PetscViewerHDF5Open(comm, temporary.c_str(), FILE_MODE_WRITE, &viewer));
    View(comm, viewer, "coefficients", part, kDimension<kDegree>,
         reinterpret_cast<const double*>(state.coefficients.data()));
    if (has_frames != 0) View(comm, viewer, "frames", part, 9, reinterpret_cast<const double*>(state.frames.data()));
    Check(PetscViewerHDF5WriteAttribute(viewer, "/", "degree", PETSC_INT, &degree));
    Check(PetscViewerHDF5WriteAttribute(viewer, "/", "level", PETSC_INT, &level));
  });
  DoTogether(comm, [&] {
    if (rank == 0) std::filesystem::rename(temporary, path);
  });
}

template <int kDegree>
DistributedState<kDegree> ReadFieldHdf5(MPI_Comm comm, const std::filesystem::path& path, const MeshPart& part) {
  DistributedState<kDegree> state;
  const int rank = RankOf(comm);
  DoTogether(comm, [&] {
    if (rank == 0 && !std::filesystem::is_regular_file(path))
      throw std::runtime_error(path.string() + ": no such file");
  });
  DoTogether(comm, [&] {
    try {
      Viewer viewer;
      PetscInt degree = 0, level = 0;
      PetscBool has_frames = PETSC_FALSE;
      Check(PetscViewerHDF5Open(comm, path.c_str(), FILE_MODE_READ, &viewer));
      Check(PetscViewerHDF5ReadAttribute(viewer, "/", "degree", PETSC_INT, nullptr, &degree));
      Check(PetscViewerHDF5ReadAttribute(viewer, "/", "level", PETSC_INT, nullptr, &level));
      if (degree != kDegree) {
        throw std::runtime_error("a field of degree " + std::to_string(degree) + ", not " + std::to_string(kDegree));
      }
      state.level = static_cast<int>(level);
      const std::vector<double> coefficients = Load(comm, viewer, "coefficients", part, kDimension<kDegree>);
      for (std::size_t i = 0; i < coefficients.size(); i += kDimension<kDegree>) {
        state.coefficients.emplace_back(Eigen::Map<const Harmonic<kDegree>>(coefficients.data() + i));
      }
      Check(PetscViewerHDF5HasDataset(viewer, "frames", &has_frames));
      if (has_frames == PETSC_FALSE) return;
      const std::vector<double> frames = Load(comm, viewer, "frames", part, 9);
      for (std::size_t i = 0; i < frames.size(); i += 9) {
        state.frames.emplace_back(Eigen::Map<const Eigen::Matrix3d>(frames.data() + i));
      }
    } catch (const std::exception& error) {
      throw std::runtime_error(path.string() + ": " + error.what());
    }
  });
  return state;
}

template void WritePvtu<3>(MPI_Comm, const std::filesystem::path&, const MeshPart&, const DistributedField<3>&);
template void WritePvtu<4>(MPI_Comm, const std::filesystem::path&, const MeshPart&, const DistributedField<4>&);
template void WriteFieldHdf5<3>(MPI_Comm, const std::filesystem::path&, const MeshPart&, const DistributedState<3>&);
template void WriteFieldHdf5<4>(MPI_Comm, const std::filesystem::path&, const MeshPart&, const DistributedState<4>&);
template DistributedState<3> ReadFieldHdf5<3>(MPI_Comm, const std::filesystem::path&, const MeshPart&);
template DistributedState<4> ReadFieldHdf5<4>(MPI_Comm, const std::filesystem::path&, const MeshPart&);

}  // namespace octupole
