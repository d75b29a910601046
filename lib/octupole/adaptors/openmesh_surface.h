#pragma once

#include <Eigen/Core>
#include <OpenMesh/Core/Mesh/Handles.hh>
#include <OpenMesh/Core/Utils/Property.hh>
#include <algorithm>
#include <array>
#include <cstddef>
#include <set>
#include <sstream>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "octupole/field/field_graph.h"
#include "octupole/mesh/triangle_mesh.h"
#include "octupole/singularities/surface_singularities.h"

namespace octupole {

// Between OpenMesh and our arrays. `Mesh` is any mesh of OpenMesh, TriMesh_ArrayKernelT or PolyMesh_ArrayKernelT, with
// whatever traits: points of float, double or Eigen's, with status and normals or without. Vertices and faces are known
// by the index of their handle; deleted ones keep theirs, but have no faces or triangles.

/// A mesh of OpenMesh as triangles: polygons are cut into fans (see FanOfPolygon). Edges and vertices with the feature
/// bit, where the mesh has status, become its features; OpenMesh's own find_feature_edges(angle) sets the bits by
/// dihedral angle.
/// \param faces if given, receives for each triangle the index of its face.
template <typename Mesh>
TriangleMesh TriangleMeshFromOpenMesh(const Mesh& mesh, std::vector<int>* faces = nullptr) {
  TriangleMesh result;
  result.points.reserve(mesh.n_vertices());
  for (std::size_t v = 0; v < mesh.n_vertices(); ++v) {
    const auto& p = mesh.point(mesh.vertex_handle(static_cast<unsigned>(v)));
    result.points.emplace_back(p[0], p[1], p[2]);
  }
  if (faces != nullptr) faces->clear();
  std::vector<int> polygon;
  for (const auto& face : mesh.faces()) {
    polygon.clear();
    for (auto corner = mesh.cfv_iter(face); corner.is_valid(); ++corner) polygon.push_back((*corner).idx());
    for (const std::array<int, 3>& triangle : FanOfPolygon(result.points, polygon)) {
      result.triangles.push_back(triangle);
      if (faces != nullptr) faces->push_back(face.idx());
    }
  }
  if (mesh.has_edge_status()) {
    for (const auto& edge : mesh.edges()) {
      if (!mesh.status(edge).feature()) continue;
      const auto halfedge = mesh.halfedge_handle(edge, 0);
      result.feature_edges.push_back({mesh.from_vertex_handle(halfedge).idx(), mesh.to_vertex_handle(halfedge).idx()});
    }
  }
  if (mesh.has_vertex_status()) {
    for (const auto& vertex : mesh.vertices()) {
      if (mesh.status(vertex).feature()) result.feature_points.push_back(vertex.idx());
    }
  }
  return result;
}

/// The graph of the mesh: its vertices and edges, each edge of weight 1. The diagonals of polygons are no edges.
/// \throw std::invalid_argument unless there is one alignment per vertex.
template <typename Mesh>
FieldGraph FieldGraphFromOpenMesh(const Mesh& mesh, std::vector<Alignment> alignments) {
  if (alignments.size() != mesh.n_vertices()) {
    std::ostringstream message;
    message << "FieldGraphFromOpenMesh: " << alignments.size() << " alignments for " << mesh.n_vertices()
            << " vertices";
    throw std::invalid_argument(message.str());
  }
  FieldGraph graph;
  graph.alignments = std::move(alignments);
  for (const auto& edge : mesh.edges()) {
    const auto halfedge = mesh.halfedge_handle(edge, 0);
    graph.edges.push_back({mesh.from_vertex_handle(halfedge).idx(), mesh.to_vertex_handle(halfedge).idx(), 1});
  }
  return graph;
}

/// Four times the index of the cross field in each face (see QuarterIndices), summed over its triangles.
template <typename Mesh>
std::vector<int> FaceQuarterIndices(const Mesh& mesh, const std::vector<Eigen::Matrix3d>& frames) {
  std::vector<int> faces;
  const TriangleMesh triangles = TriangleMeshFromOpenMesh(mesh, &faces);
  const std::vector<int> of_triangles = QuarterIndices(triangles.points, triangles.triangles, frames);
  std::vector<int> of_faces(mesh.n_faces(), 0);
  for (std::size_t t = 0; t < faces.size(); ++t) of_faces[faces[t]] += of_triangles[t];
  return of_faces;
}

namespace internal {

template <typename Mesh>
typename Mesh::Point ToProperty(const Eigen::Vector3d& value) {
  typename Mesh::Point point;
  using Scalar = std::decay_t<decltype(point[0])>;
  for (int k = 0; k < 3; ++k) point[k] = static_cast<Scalar>(value[k]);
  return point;
}

template <typename Mesh, typename T>
T ToProperty(const T& value) {
  return value;
}

template <template <typename> class PropertyHandle, typename Handle, typename Mesh, typename T>
void SetProperty(const char* caller, const std::string& name, const std::vector<T>& values, std::size_t num_items,
                 Mesh* mesh) {
  if (values.size() != num_items) {
    std::ostringstream message;
    message << caller << ": " << values.size() << " values of \"" << name << "\" for " << num_items << " items";
    throw std::invalid_argument(message.str());
  }
  PropertyHandle<decltype(ToProperty<Mesh>(values[0]))> property;
  if (!mesh->get_property_handle(property, name)) mesh->add_property(property, name);
  for (std::size_t i = 0; i < num_items; ++i) {
    mesh->property(property, Handle(static_cast<int>(i))) = ToProperty<Mesh>(values[i]);
  }
}

}  // namespace internal

/// Writes one value per vertex to the vertex property of this name, which is added if there is none yet. Vectors are
/// stored as Mesh::Point, all else as it is: read them with OpenMesh::VProp<Mesh::Point>(mesh, name).
/// \throw std::invalid_argument unless there is one value per vertex.
template <typename Mesh, typename T>
void SetVertexProperty(const std::string& name, const std::vector<T>& values, Mesh* mesh) {
  internal::SetProperty<OpenMesh::VPropHandleT, OpenMesh::VertexHandle>("SetVertexProperty", name, values,
                                                                        mesh->n_vertices(), mesh);
}

/// The same for faces.
template <typename Mesh, typename T>
void SetFaceProperty(const std::string& name, const std::vector<T>& values, Mesh* mesh) {
  internal::SetProperty<OpenMesh::FPropHandleT, OpenMesh::FaceHandle>("SetFaceProperty", name, values, mesh->n_faces(),
                                                                      mesh);
}

/// Writes frames to three vertex properties, one for each axis.
template <typename Mesh>
void SetVertexFrames(const std::array<std::string, 3>& names, const std::vector<Eigen::Matrix3d>& frames, Mesh* mesh) {
  for (int k = 0; k < 3; ++k) {
    std::vector<Eigen::Vector3d> axes;
    axes.reserve(frames.size());
    for (const Eigen::Matrix3d& frame : frames) axes.push_back(frame.col(k));
    SetVertexProperty(names[k], axes, mesh);
  }
}

/// A mesh of OpenMesh made of our arrays.
template <typename Mesh>
struct OpenMeshSurface {
  Mesh mesh;
  /// Of each vertex of `mesh` the point that it came from, in ascending order.
  std::vector<int> points;
  /// OpenMesh has manifolds only. Where the surface is none, it was cut (see CutToManifold): so many vertices are
  /// second and further copies of a point.
  std::size_t num_copies = 0;
};

/// A surface as a mesh of OpenMesh, its features marked with the feature bits of edges and vertices. No triangle is
/// lost, and faces are in the order of triangles. MakeOpenMesh<Mesh>(BoundarySurface(tet_mesh)) is the boundary of a
/// tet mesh, and its `points` are vertices of that.
/// \throw std::invalid_argument as CheckTriangleMesh() does.
template <typename Mesh>
OpenMeshSurface<Mesh> MakeOpenMesh(const TriangleMesh& surface) {
  CheckTriangleMesh(surface);
  OpenMeshSurface<Mesh> result;
  Mesh& mesh = result.mesh;
  mesh.request_edge_status();
  mesh.request_vertex_status();
  ManifoldSurface manifold = CutToManifold(surface);
  for (std::size_t v = 0; v < manifold.points.size(); ++v) {
    mesh.add_vertex(internal::ToProperty<Mesh>(surface.points[manifold.points[v]]));
    result.num_copies += v > 0 && manifold.points[v] == manifold.points[v - 1];
  }
  for (const std::array<int, 3>& t : manifold.triangles) {
    mesh.add_face(OpenMesh::VertexHandle(t[0]), OpenMesh::VertexHandle(t[1]), OpenMesh::VertexHandle(t[2]));
  }
  result.points = std::move(manifold.points);

  std::set<std::pair<int, int>> features;
  for (const std::array<int, 2>& edge : surface.feature_edges) features.insert(std::minmax(edge[0], edge[1]));
  for (const auto& edge : mesh.edges()) {
    const auto halfedge = mesh.halfedge_handle(edge, 0);
    const int a = result.points[mesh.from_vertex_handle(halfedge).idx()];
    const int b = result.points[mesh.to_vertex_handle(halfedge).idx()];
    mesh.status(edge).set_feature(features.count(std::minmax(a, b)) > 0);
  }
  const std::set<int> feature_points(surface.feature_points.begin(), surface.feature_points.end());
  for (const auto& vertex : mesh.vertices()) {
    mesh.status(vertex).set_feature(feature_points.count(result.points[vertex.idx()]) > 0);
  }
  return result;
}

/// Hands the features marked on the boundary of a tet mesh back to it: its features on the boundary become those that
/// have the feature bit now; those inside stay.
/// \param boundary what MakeOpenMesh made of the BoundarySurface of the mesh.
template <typename Mesh>
void HandBackFeatures(const OpenMeshSurface<Mesh>& boundary, TetMesh* mesh) {
  const TriangleMesh marked = TriangleMeshFromOpenMesh(boundary.mesh);
  // Sets, as copies of an edge or point count once.
  std::set<std::pair<int, int>> edges;
  for (const std::array<int, 2>& edge : mesh->feature_edges) edges.insert(std::minmax(edge[0], edge[1]));
  for (const auto& edge : boundary.mesh.edges()) {
    const auto halfedge = boundary.mesh.halfedge_handle(edge, 0);
    edges.erase(std::minmax(boundary.points[boundary.mesh.from_vertex_handle(halfedge).idx()],
                            boundary.points[boundary.mesh.to_vertex_handle(halfedge).idx()]));
  }
  for (const std::array<int, 2>& edge : marked.feature_edges) {
    edges.insert(std::minmax(boundary.points[edge[0]], boundary.points[edge[1]]));
  }
  std::set<int> points(mesh->feature_points.begin(), mesh->feature_points.end());
  for (const int v : boundary.points) points.erase(v);
  for (const int v : marked.feature_points) points.insert(boundary.points[v]);
  mesh->feature_edges.clear();
  for (const auto& [a, b] : edges) mesh->feature_edges.push_back({a, b});
  mesh->feature_points.assign(points.begin(), points.end());
}

}  // namespace octupole
