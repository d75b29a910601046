#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "octupole/alignment/alignment.h"
#include "octupole/mesh/tet_mesh.h"
#include "octupole/mesh/triangle_mesh.h"

namespace octupole {

/// An edge between two vertices of a graph and the weight of its smoothness term.
struct WeightedEdge {
  int a = 0;
  int b = 0;
  double weight = 1;
};

/// All that costs and solvers ever see of a mesh: vertices, weighted edges, and one alignment per vertex.
struct FieldGraph {
  std::vector<WeightedEdge> edges;
  /// One per vertex; its size is the number of vertices.
  std::vector<Alignment> alignments;

  std::size_t num_vertices() const { return alignments.size(); }
};

/// What an edge of a mesh weighs.
enum class EdgeWeights {
  /// 1, whatever its length.
  kUniform,
  /// Its stiffness in linear finite elements, the cotangent weights: sum over edges of weight |f_a - f_b|^2 is the
  /// integral of |grad f|^2 over the mesh, for any f that is linear on each cell, whatever the sizes of cells. In units
  /// of length on a tet mesh, none on a surface. Negative sums, at obtuse angles, count as 0; cells flatter than
  /// a hundredth or so count as if they were not (theory.md, section 9).
  kFiniteElement,
};

/// The graph of a tet mesh: its vertices and edges in the order of MeshEdges. Points of no tetrahedron have nothing to
/// be smooth with and become no unknowns: their frame is prescribed, one that their alignment allows. \throw
/// std::invalid_argument unless there is one alignment per point.
FieldGraph MakeFieldGraph(const TetMesh& mesh, std::vector<Alignment> alignments,
                          EdgeWeights weights = EdgeWeights::kUniform);

/// The graph of a surface, likewise.
FieldGraph MakeFieldGraph(const TriangleMesh& mesh, std::vector<Alignment> alignments,
                          EdgeWeights weights = EdgeWeights::kUniform);

/// \throw std::invalid_argument naming the first edge whose ends are out of range or equal, or whose weight is negative
/// or not finite.
void CheckFieldGraph(const FieldGraph& graph);

/// The sum of the edges' weights.
double SumOfWeights(const FieldGraph& graph);

/// The mean of the edges' weights; 1 where there are none but zero.
double MeanEdgeWeight(const FieldGraph& graph);

/// How large the problem is that a field poses on a graph.
struct ProblemSize {
  std::size_t unknowns = 0;
  /// Non-zeros of the matrix of second derivatives (or of its Gauss-Newton part), both triangles, by blocks: with k_v
  /// unknowns at vertex v the sum over vertices of k_v^2 and over edges of positive weight of 2 k_a k_b. It is what a
  /// solver stores that knows blocks but not what is in them, as Ceres does; in degree 4 the blocks of edges between
  /// free vertices are diagonal.
  std::size_t nonzeros = 0;
};

/// \param unknowns_of_kind the unknowns at a vertex by its AlignmentKind: free, with an axis, with a frame.
ProblemSize SizeOfProblem(const FieldGraph& graph, const std::array<std::size_t, 3>& unknowns_of_kind);

}  // namespace octupole
