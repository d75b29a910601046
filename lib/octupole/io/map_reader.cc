#include "octupole/io/map_reader.h"

#include <cstdint>

#include "octupole/readers/internal/mesh_readers.h"

namespace octupole {

MeshMap ReadHexEx(const std::filesystem::path& path) {
  const internal::FileContent content(path);
  internal::TextTokenizer tokens(path.string(), content.text());
  MeshMap map;
  TetMesh& mesh = map.mesh;
  mesh.points.resize(tokens.NextCount("points", 3));
  for (Eigen::Vector3d& point : mesh.points) point = internal::NextPoint(tokens);
  mesh.tets.resize(tokens.NextCount("tetrahedra", 16));
  map.parameters.resize(mesh.tets.size());
  const auto index_of = [&](std::int64_t number) {
    return internal::IndexInOrder(tokens, number, 0, mesh.points.size());
  };
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    mesh.tets[t] = internal::NextTet(tokens, index_of);
    for (Eigen::Vector3d& corner : map.parameters[t]) {
      for (double& x : corner) x = tokens.NextReal("a parameter");
    }
  }
  if (mesh.tets.empty()) tokens.Fail("no tetrahedra");
  if (!tokens.AtEnd()) {
    tokens.NextWord();
    tokens.Fail("more tetrahedra than announced");
  }
  return map;
}

}  // namespace octupole
