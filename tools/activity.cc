#include "activity.h"

#include <cstdio>

namespace octupole {
namespace {

// Of the whole command with the fast solver, per vertex of a tet mesh: docs/fast_solver.md, 1 to 6 million vertices.
constexpr double kBytesPerVertex = 900;

struct Activity {
  std::string what = "starting";
  std::size_t num_vertices = 0;
};
Activity activity;

}  // namespace

void SetActivity(const std::string& what, std::size_t num_vertices) { activity = {what, num_vertices}; }

std::string OutOfMemoryMessage() {
  std::string message = "out of memory while " + activity.what;
  char numbers[160];
  if (activity.num_vertices > 0) {
    std::snprintf(numbers, sizeof(numbers),
                  " for %zu vertices; the fast solver needs about %.2g GB for such a mesh, Ceres' more",
                  activity.num_vertices, kBytesPerVertex * static_cast<double>(activity.num_vertices) / 1e9);
  } else {
    std::snprintf(numbers, sizeof(numbers), "; a field needs about %.2g GB for a million vertices",
                  kBytesPerVertex * 1e6 / 1e9);
  }
  return message + numbers;
}

}  // namespace octupole
