#include "octupole/distributed/internal/partition.h"

#include <petscmat.h>

#include <algorithm>
#include <array>

#include "octupole/distributed/internal/petsc.h"
#include "octupole/distributed/internal/stars.h"
#include "octupole/mesh/morton_order.h"

namespace octupole::internal {
namespace {

// Enough for the blocks' own borders not to matter.
constexpr std::size_t kMinBlocks = 20000;
constexpr std::size_t kBlocksPerPart = 1000;
// Passes that smooth the border between parts, which is ragged after the blocks.
constexpr int kNumSmoothings = 6;
// With fewer than these in a part there is no border to speak of; PT-Scotch does not take a graph without edges.
constexpr std::size_t kMinTetsPerPart = 8;

// The tetrahedra in Morton's order of their centres.
std::vector<std::size_t> OrderOfTets(const TetMesh& mesh) {
  std::vector<Eigen::Vector3d> centres;
  centres.reserve(mesh.tets.size());
  for (const std::array<int, 4>& tet : mesh.tets) {
    Eigen::Vector3d& centre = centres.emplace_back(Eigen::Vector3d::Zero());
    for (const int v : tet) centre += mesh.points[v] / 4;
  }
  return MortonOrder(centres);
}

struct BlockEdge {
  int a;
  int b;
  bool operator<(const BlockEdge& other) const { return a != other.a ? a < other.a : b < other.b; }
};

// For each vertex that two blocks have in common an edge in both directions, in ascending order.
std::vector<BlockEdge> SharedVertices(const Stars& stars, const std::vector<int>& block_of) {
  std::vector<BlockEdge> edges;
  std::vector<int> blocks;
  for (std::size_t v = 0; v + 1 < stars.first.size(); ++v) {
    blocks.clear();
    for (std::size_t i = stars.first[v]; i < stars.first[v + 1]; ++i) blocks.push_back(block_of[stars.tets[i]]);
    std::sort(blocks.begin(), blocks.end());
    blocks.erase(std::unique(blocks.begin(), blocks.end()), blocks.end());
    for (const int a : blocks) {
      for (const int b : blocks) {
        if (a != b) edges.push_back({a, b});
      }
    }
  }
  std::sort(edges.begin(), edges.end());
  return edges;
}

// PETSc frees what it is given.
template <typename Value>
Value* NewArray(std::size_t size) {
  Value* array = nullptr;
  Check(PetscMalloc1(size, &array));
  return array;
}

// The part of each block, by the edges between them and their sizes.
std::vector<PetscInt> PartitionBlocks(const std::vector<BlockEdge>& edges, const std::vector<PetscInt>& sizes,
                                      int num_parts) {
  const auto num_blocks = static_cast<PetscInt>(sizes.size());
  PetscInt* rows = NewArray<PetscInt>(sizes.size() + 1);
  PetscInt* columns = NewArray<PetscInt>(edges.size());
  PetscInt* weights = NewArray<PetscInt>(edges.size());
  PetscInt* vertex_weights = NewArray<PetscInt>(sizes.size());
  std::copy(sizes.begin(), sizes.end(), vertex_weights);
  PetscInt num_edges = 0;
  std::size_t next = 0;
  for (PetscInt block = 0; block < num_blocks; ++block) {
    rows[block] = num_edges;
    for (; next < edges.size() && edges[next].a == block; ++next) {
      if (num_edges > rows[block] && columns[num_edges - 1] == edges[next].b) {
        ++weights[num_edges - 1];
        continue;
      }
      columns[num_edges] = edges[next].b;
      weights[num_edges++] = 1;
    }
  }
  rows[num_blocks] = num_edges;
  PetscHandle<Mat, MatDestroy> adjacency;
  PetscHandle<MatPartitioning, MatPartitioningDestroy> partitioning;
  PetscHandle<IS, ISDestroy> parts;
  Check(MatCreateMPIAdj(PETSC_COMM_SELF, num_blocks, num_blocks, rows, columns, weights, &adjacency));
  Check(MatPartitioningCreate(PETSC_COMM_SELF, &partitioning));
  Check(MatPartitioningSetAdjacency(partitioning, adjacency));
  Check(MatPartitioningSetType(partitioning, MATPARTITIONINGPTSCOTCH));
  Check(MatPartitioningSetVertexWeights(partitioning, vertex_weights));
  Check(MatPartitioningSetNParts(partitioning, num_parts));
  Check(MatPartitioningSetFromOptions(partitioning));
  Check(MatPartitioningApply(partitioning, &parts));
  const PetscInt* indices = nullptr;
  Check(ISGetIndices(parts, &indices));
  std::vector<PetscInt> result(indices, indices + num_blocks);
  Check(ISRestoreIndices(parts, &indices));
  return result;
}

// Each vertex goes to the part of most tetrahedra around it, then each tetrahedron to that of most of its vertices;
// where there is a tie, it stays.
void SmoothBorders(const TetMesh& mesh, const Stars& stars, int num_parts, std::vector<int>* part_of_tet) {
  std::vector<int> part_of_vertex(mesh.points.size(), 0), counts(num_parts, 0);
  const auto most = [&](int favourite, std::size_t size, const auto& part_of) {
    for (std::size_t i = 0; i < size; ++i) ++counts[part_of(i)];
    int winner = favourite;
    for (std::size_t i = 0; i < size; ++i) {
      if (counts[part_of(i)] > counts[winner]) winner = part_of(i);
    }
    for (std::size_t i = 0; i < size; ++i) counts[part_of(i)] = 0;
    return winner;
  };
  for (std::size_t v = 0; v < mesh.points.size(); ++v) {
    if (stars.first[v] < stars.first[v + 1]) part_of_vertex[v] = (*part_of_tet)[stars.tets[stars.first[v]]];
  }
  for (int pass = 0; pass < kNumSmoothings; ++pass) {
    for (std::size_t v = 0; v < mesh.points.size(); ++v) {
      part_of_vertex[v] = most(part_of_vertex[v], stars.first[v + 1] - stars.first[v],
                               [&](std::size_t i) { return (*part_of_tet)[stars.tets[stars.first[v] + i]]; });
    }
    for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
      (*part_of_tet)[t] = most((*part_of_tet)[t], 4, [&](std::size_t i) { return part_of_vertex[mesh.tets[t][i]]; });
    }
  }
}

}  // namespace

std::vector<int> PartitionTets(const TetMesh& mesh, int num_parts) {
  std::vector<int> result(mesh.tets.size(), 0);
  if (num_parts == 1 || mesh.tets.empty()) return result;
  const std::size_t num_tets = mesh.tets.size();
  const std::vector<std::size_t> order = OrderOfTets(mesh);
  if (num_tets < kMinTetsPerPart * num_parts) {
    for (std::size_t i = 0; i < num_tets; ++i) result[order[i]] = static_cast<int>(i * num_parts / num_tets);
    return result;
  }
  const std::size_t num_blocks = std::min(num_tets, std::max(kMinBlocks, kBlocksPerPart * num_parts));
  std::vector<int> block_of(num_tets);
  std::vector<PetscInt> sizes(num_blocks, 0);
  for (std::size_t i = 0; i < num_tets; ++i) {
    const std::size_t block = i * num_blocks / num_tets;
    block_of[order[i]] = static_cast<int>(block);
    ++sizes[block];
  }
  const Stars stars(mesh);
  const std::vector<PetscInt> part_of_block = PartitionBlocks(SharedVertices(stars, block_of), sizes, num_parts);
  for (std::size_t t = 0; t < num_tets; ++t) result[t] = static_cast<int>(part_of_block[block_of[t]]);
  SmoothBorders(mesh, stars, num_parts, &result);
  return result;
}

}  // namespace octupole::internal
