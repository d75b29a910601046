#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>
#include <vector>

namespace octupole::internal {

/// The corners of the edges of a triangle, and of the edges and faces of a tetrahedron.
inline constexpr std::array<std::array<int, 2>, 3> kTriangleEdges = {{{0, 1}, {0, 2}, {1, 2}}};
inline constexpr std::array<std::array<int, 2>, 6> kTetEdges = {{{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}}};
inline constexpr std::array<std::array<int, 3>, 4> kTetFaces = {{{0, 1, 2}, {0, 1, 3}, {0, 2, 3}, {1, 2, 3}}};

/// The vertices of an edge, face or tetrahedron in ascending order, and the cell it was taken from.
template <std::size_t N>
struct Simplex {
  std::array<int, N> vertices;
  int cell;
};

/// Takes the corners `pattern` (each ascending) of all cells and sorts the resulting simplices
/// lexicographically, so that equal ones are neighbours. They go into a bucket for each smallest
/// vertex first: the buckets of a mesh are small, which makes this several times faster than one
/// large sort.
template <std::size_t N, std::size_t M, std::size_t K>
std::vector<Simplex<N>> SortedSimplices(std::vector<std::array<int, M>> cells,
                                        const std::array<std::array<int, N>, K>& pattern, std::size_t num_points) {
  std::vector<std::size_t> bucket_begin(num_points + 1, 0);
  for (std::array<int, M>& cell : cells) {
    for (std::size_t i = 0; i < M; ++i) {
      for (std::size_t j = i + 1; j < M; ++j) {
        if (cell[j] < cell[i]) {
          std::swap(cell[i], cell[j]);
        }
      }
    }
    for (const std::array<int, N>& corners : pattern) {
      ++bucket_begin[cell[corners[0]] + 1];
    }
  }
  for (std::size_t v = 0; v < num_points; ++v) {
    bucket_begin[v + 1] += bucket_begin[v];
  }
  std::vector<Simplex<N>> simplices(bucket_begin.back());
  std::vector<std::size_t> bucket_end(bucket_begin.begin(), bucket_begin.end() - 1);
  for (std::size_t c = 0; c < cells.size(); ++c) {
    for (const std::array<int, N>& corners : pattern) {
      Simplex<N>& simplex = simplices[bucket_end[cells[c][corners[0]]]++];
      for (std::size_t i = 0; i < N; ++i) {
        simplex.vertices[i] = cells[c][corners[i]];
      }
      simplex.cell = static_cast<int>(c);
    }
  }
  for (std::size_t v = 0; v < num_points; ++v) {
    std::sort(simplices.begin() + bucket_begin[v], simplices.begin() + bucket_end[v],
              [](const auto& a, const auto& b) { return a.vertices < b.vertices; });
  }
  return simplices;
}

/// Whether two simplices have the same vertices; a comparison of arrays would call memcmp.
template <std::size_t N>
bool AreSame(const Simplex<N>& a, const Simplex<N>& b) {
  for (std::size_t i = 0; i < N; ++i) {
    if (a.vertices[i] != b.vertices[i]) return false;
  }
  return true;
}

/// Calls visit(first simplex, number of equal ones) for each distinct simplex of a sorted list. The equal ones follow
/// the first in memory.
template <std::size_t N, typename Visit>
void ForEachDistinct(const std::vector<Simplex<N>>& sorted, const Visit& visit) {
  for (std::size_t begin = 0, end = 0; begin < sorted.size(); begin = end) {
    while (end < sorted.size() && AreSame(sorted[end], sorted[begin])) {
      ++end;
    }
    visit(sorted[begin], static_cast<int>(end - begin));
  }
}

template <std::size_t M>
std::array<int, M> SortedCell(std::array<int, M> cell) {
  for (std::size_t i = 0; i < M; ++i) {
    for (std::size_t j = i + 1; j < M; ++j) {
      const int smaller = std::min(cell[i], cell[j]);
      cell[j] = std::max(cell[i], cell[j]);
      cell[i] = smaller;
    }
  }
  return cell;
}

/// For each point the cells that have it among their so many smallest vertices, in ascending order.
struct CellsOfPoints {
  template <std::size_t M>
  CellsOfPoints(const std::vector<std::array<int, M>>& cells, std::size_t num_points, std::size_t num_smallest)
      : end(num_points + 1, 0) {
    for (const std::array<int, M>& cell : cells) {
      const std::array<int, M> vertices = SortedCell(cell);
      for (std::size_t i = 0; i < num_smallest; ++i) ++end[vertices[i] + 1];
    }
    for (std::size_t v = 0; v < num_points; ++v) end[v + 1] += end[v];
    list.resize(end.back());
    for (std::size_t c = 0; c < cells.size(); ++c) {
      const std::array<int, M> vertices = SortedCell(cells[c]);
      for (std::size_t i = 0; i < num_smallest; ++i) list[end[vertices[i]]++] = static_cast<int>(c);
    }
  }

  /// Those of point v end before list[end[v]], where those of v + 1 begin.
  std::vector<std::size_t> end;
  std::vector<int> list;
};

/// Sorts a few simplices that have the smallest vertex in common; equal ones stay in order.
template <std::size_t N>
void SortBucket(std::vector<Simplex<N>>* simplices) {
  const auto is_less = [](const Simplex<N>& a, const Simplex<N>& b) {
    for (std::size_t i = 1; i < N; ++i) {
      if (a.vertices[i] != b.vertices[i]) return a.vertices[i] < b.vertices[i];
    }
    return false;
  };
  constexpr std::size_t kFew = 48;
  if (simplices->size() > kFew) {
    std::stable_sort(simplices->begin(), simplices->end(), is_less);
    return;
  }
  for (std::size_t i = 1; i < simplices->size(); ++i) {
    const Simplex<N> simplex = (*simplices)[i];
    std::size_t place = i;
    for (; place > 0 && is_less(simplex, (*simplices)[place - 1]); --place)
      (*simplices)[place] = (*simplices)[place - 1];
    (*simplices)[place] = simplex;
  }
}

/// The same for the simplices `pattern` (each ascending) of all cells, in the order in which SortedSimplices lists
/// them, but without the list: those of one smallest vertex at a time, equal ones by their cells.
template <std::size_t N, std::size_t M, std::size_t K, typename Visit>
void ForEachDistinct(const std::vector<std::array<int, M>>& cells, const std::array<std::array<int, N>, K>& pattern,
                     std::size_t num_points, const Visit& visit) {
  // A simplex begins with one of so many smallest vertices of its cell.
  std::size_t num_smallest = 0;
  for (const std::array<int, N>& corners : pattern) {
    num_smallest = std::max(num_smallest, static_cast<std::size_t>(corners[0]) + 1);
  }
  const CellsOfPoints cells_of(cells, num_points, num_smallest);
  std::vector<Simplex<N>> simplices;
  for (std::size_t v = 0, next = 0; v < num_points; ++v) {
    simplices.clear();
    for (; next < cells_of.end[v]; ++next) {
      const std::array<int, M> vertices = SortedCell(cells[cells_of.list[next]]);
      for (const std::array<int, N>& corners : pattern) {
        if (vertices[corners[0]] != static_cast<int>(v)) continue;
        Simplex<N>& simplex = simplices.emplace_back();
        for (std::size_t i = 0; i < N; ++i) simplex.vertices[i] = vertices[corners[i]];
        simplex.cell = cells_of.list[next];
      }
    }
    SortBucket(&simplices);
    ForEachDistinct(simplices, visit);
  }
}

/// The edges of all cells whose vertices are all joined, each once with the smaller vertex first, in lexicographic
/// order.
template <std::size_t M>
std::vector<std::array<int, 2>> DistinctEdges(const std::vector<std::array<int, M>>& cells, std::size_t num_points) {
  const CellsOfPoints cells_of(cells, num_points, M - 1);
  std::vector<std::array<int, 2>> edges;
  // The last smaller vertex to which each was found to be joined.
  std::vector<int> last(num_points, -1);
  std::vector<int> joined;
  for (std::size_t v = 0, next = 0; v < num_points; ++v) {
    const int a = static_cast<int>(v);
    joined.clear();
    for (; next < cells_of.end[v]; ++next) {
      for (const int b : cells[cells_of.list[next]]) {
        if (b <= a || last[b] == a) continue;
        last[b] = a;
        joined.push_back(b);
      }
    }
    std::sort(joined.begin(), joined.end());
    for (const int b : joined) edges.push_back({a, b});
  }
  return edges;
}

/// The vertices of each distinct simplex of the cells.
template <std::size_t N, std::size_t M, std::size_t K>
std::vector<std::array<int, N>> DistinctVertices(const std::vector<std::array<int, M>>& cells,
                                                 const std::array<std::array<int, N>, K>& pattern,
                                                 std::size_t num_points) {
  std::vector<std::array<int, N>> distinct;
  ForEachDistinct(cells, pattern, num_points,
                  [&](const Simplex<N>& simplex, int) { distinct.push_back(simplex.vertices); });
  return distinct;
}

}  // namespace octupole::internal
