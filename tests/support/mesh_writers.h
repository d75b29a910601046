#pragma once

#include <string>

#include "octupole/mesh/tet_mesh.h"

namespace octupole {

// Files of the formats that octupole reads, for tests, fuzzing and benchmarks. They hold all of a mesh that the format
// can: regions, features as lines and points, and tagged triangles.

std::string MeditText(const TetMesh& mesh);
std::string TetText(const TetMesh& mesh);
std::string OpenVolumeMeshText(const TetMesh& mesh);

struct TetGenTexts {
  std::string nodes;
  std::string elements;
  std::string edges;
};

TetGenTexts MakeTetGenTexts(const TetMesh& mesh);

enum class Encoding { kText, kLittleEndian, kBigEndian };

/// Format 2.2 or 4.1.
std::string GmshFile(const TetMesh& mesh, bool is_version_4, Encoding encoding);

/// Format 3.0 or 5.1; text or big-endian.
std::string VtkFile(const TetMesh& mesh, bool is_version_5, Encoding encoding);

/// With arrays as text, or as bytes behind the XML. WriteVtu() writes compressed ones in base64.
std::string VtuFile(const TetMesh& mesh, Encoding encoding);

}  // namespace octupole
