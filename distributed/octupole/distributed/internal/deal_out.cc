#include "octupole/distributed/internal/deal_out.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <utility>

namespace octupole::internal {
namespace {

constexpr int kNobody = -1;

// The owner of most tetrahedra around each vertex: counted are runs of equal owners, sorted.
std::vector<int> OwnersOfVertices(const TetMesh& mesh, const std::vector<int>& owner_of_tet) {
  std::vector<std::size_t> first(mesh.points.size() + 1, 0);
  for (const std::array<int, 4>& tet : mesh.tets) {
    for (const int v : tet) ++first[v + 1];
  }
  for (std::size_t v = 0; v < mesh.points.size(); ++v) first[v + 1] += first[v];
  std::vector<int> around(4 * mesh.tets.size());
  std::vector<std::size_t> next(first.begin(), first.end() - 1);
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    for (const int v : mesh.tets[t]) around[next[v]++] = owner_of_tet[t];
  }
  std::vector<int> owners(mesh.points.size(), kNobody);
  for (std::size_t v = 0; v < mesh.points.size(); ++v) {
    const auto end = around.begin() + static_cast<std::ptrdiff_t>(first[v + 1]);
    auto run = around.begin() + static_cast<std::ptrdiff_t>(first[v]);
    std::sort(run, end);
    for (std::ptrdiff_t longest = 0; run != end;) {
      const auto next_run = std::upper_bound(run, end, *run);
      if (next_run - run > longest) {
        longest = next_run - run;
        owners[v] = *run;
      }
      run = next_run;
    }
  }
  return owners;
}

class Dealer {
 public:
  Dealer(const TetMesh& mesh, const std::vector<int>& owner_of_tet, int num_ranks)
      : mesh_(mesh),
        owner_of_vertex_(OwnersOfVertices(mesh, owner_of_tet)),
        index_(mesh.points.size(), kNobody),
        place_(mesh.points.size(), kNobody),
        owned_points_(num_ranks),
        owned_tets_(num_ranks),
        other_tets_(num_ranks) {
    for (std::size_t v = 0; v < mesh.points.size(); ++v) {
      if (owner_of_vertex_[v] == kNobody) continue;
      std::vector<int>& owned = owned_points_[owner_of_vertex_[v]];
      index_[v] = static_cast<int>(owned.size());
      owned.push_back(static_cast<int>(v));
    }
    for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
      const int owner = owner_of_tet[t];
      owned_tets_[owner].push_back(static_cast<int>(t));
      for (int k = 0; k < 4; ++k) {
        const int other = owner_of_vertex_[mesh.tets[t][k]];
        const auto is_other = [&](int v) { return owner_of_vertex_[v] == other; };
        const bool is_new = std::none_of(mesh.tets[t].begin(), mesh.tets[t].begin() + k, is_other);
        if (other != owner && is_new) other_tets_[other].push_back(static_cast<int>(t));
      }
    }
  }

  MeshPart PartOf(int rank) {
    MeshPart part;
    std::vector<int> points = std::move(owned_points_[rank]);
    part.num_owned_points = points.size();
    part.num_owned_tets = owned_tets_[rank].size();
    for (std::size_t i = 0; i < points.size(); ++i) place_[points[i]] = static_cast<int>(i);
    std::vector<int> tets = std::move(owned_tets_[rank]);
    tets.insert(tets.end(), other_tets_[rank].begin(), other_tets_[rank].end());
    for (const int t : tets) {
      for (const int v : mesh_.tets[t]) {
        if (place_[v] != kNobody) continue;
        place_[v] = static_cast<int>(points.size());
        points.push_back(v);
        part.ghosts.push_back({owner_of_vertex_[v], index_[v]});
      }
    }
    for (const int v : points) {
      part.mesh.points.push_back(mesh_.points[v]);
      part.numbers.push_back(v);
    }
    for (const int t : tets) {
      std::array<int, 4>& tet = part.mesh.tets.emplace_back();
      std::transform(mesh_.tets[t].begin(), mesh_.tets[t].end(), tet.begin(), [&](int v) { return place_[v]; });
      if (!mesh_.regions.empty()) part.mesh.regions.push_back(mesh_.regions[t]);
    }
    for (const int v : points) place_[v] = kNobody;
    return part;
  }

 private:
  const TetMesh& mesh_;
  const std::vector<int> owner_of_vertex_;
  // Of each vertex among those of its owner, and its place in the part at work.
  std::vector<int> index_;
  std::vector<int> place_;
  // By rank. Tets of others are those that touch a vertex of the rank.
  std::vector<std::vector<int>> owned_points_;
  std::vector<std::vector<int>> owned_tets_;
  std::vector<std::vector<int>> other_tets_;
};

// What travels, with what it is made of.
template <typename Part, typename Visit>
void ForEachArray(Part* part, const Visit& visit) {
  visit(&part->mesh.points, MPI_DOUBLE);
  visit(&part->mesh.tets, MPI_INT);
  visit(&part->mesh.regions, MPI_INT);
  visit(&part->ghosts, MPI_INT);
  visit(&part->numbers, MPI_INT64_T);
}

template <typename Element>
int NumbersIn(MPI_Datatype type) {
  int size = 0;
  MPI_Type_size(type, &size);
  return static_cast<int>(sizeof(Element)) / size;
}

constexpr int kTag = 0;

void Send(MPI_Comm comm, int rank, const MeshPart& part) {
  ForEachArray(&part, [&](const auto* values, MPI_Datatype type) {
    using Element = typename std::decay_t<decltype(*values)>::value_type;
    MPI_Send(values->data(), static_cast<int>(values->size()) * NumbersIn<Element>(type), type, rank, kTag, comm);
  });
  const std::uint64_t num_owned_tets = part.num_owned_tets;
  MPI_Send(&num_owned_tets, 1, MPI_UINT64_T, rank, kTag, comm);
}

MeshPart Receive(MPI_Comm comm) {
  MeshPart part;
  ForEachArray(&part, [&](auto* values, MPI_Datatype type) {
    using Element = typename std::decay_t<decltype(*values)>::value_type;
    MPI_Status status;
    MPI_Probe(0, kTag, comm, &status);
    int count = 0;
    MPI_Get_count(&status, type, &count);
    values->resize(count / NumbersIn<Element>(type));
    MPI_Recv(values->data(), count, type, 0, kTag, comm, MPI_STATUS_IGNORE);
  });
  part.num_owned_points = part.numbers.size() - part.ghosts.size();
  std::uint64_t num_owned_tets = 0;
  MPI_Recv(&num_owned_tets, 1, MPI_UINT64_T, 0, kTag, comm, MPI_STATUS_IGNORE);
  part.num_owned_tets = num_owned_tets;
  return part;
}

}  // namespace

MeshPart DealOut(MPI_Comm comm, const TetMesh& mesh, const std::vector<int>& owner_of_tet) {
  int rank = 0, num_ranks = 0;
  MPI_Comm_rank(comm, &rank);
  MPI_Comm_size(comm, &num_ranks);
  if (rank > 0) return Receive(comm);
  Dealer dealer(mesh, owner_of_tet, num_ranks);
  for (int other = 1; other < num_ranks; ++other) Send(comm, other, dealer.PartOf(other));
  return dealer.PartOf(0);
}

}  // namespace octupole::internal
