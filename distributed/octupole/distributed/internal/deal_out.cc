#include "octupole/distributed/internal/deal_out.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "octupole/distributed/internal/contiguous_type.h"
#include "octupole/distributed/internal/stars.h"

namespace octupole::internal {
namespace {

constexpr int kNobody = -1;

// The owner of most tetrahedra around each vertex.
std::vector<int> OwnersOfVertices(const TetMesh& mesh, const std::vector<int>& owner_of_tet) {
  const Stars stars(mesh);
  std::vector<int> owners(mesh.points.size(), kNobody), around;
  for (std::size_t v = 0; v < mesh.points.size(); ++v) {
    around.clear();
    for (std::size_t i = stars.first[v]; i < stars.first[v + 1]; ++i) around.push_back(owner_of_tet[stars.tets[i]]);
    std::sort(around.begin(), around.end());
    std::ptrdiff_t longest = 0;
    for (auto run = around.begin(); run != around.end();) {
      const auto next_run = std::upper_bound(run, around.end(), *run);
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

// What travels.
template <typename Part, typename Visit>
void ForEachArray(Part* part, const Visit& visit) {
  visit(&part->mesh.points);
  visit(&part->mesh.tets);
  visit(&part->mesh.regions);
  visit(&part->ghosts);
  visit(&part->numbers);
}

constexpr int kTag = 0;

void Send(MPI_Comm comm, int rank, const MeshPart& part) {
  ForEachArray(&part, [&](const auto* values) {
    const ContiguousType unit(sizeof(*values->data()), MPI_BYTE);
    MPI_Send(values->data(), static_cast<int>(values->size()), unit, rank, kTag, comm);
  });
  const std::uint64_t num_owned_tets = part.num_owned_tets;
  MPI_Send(&num_owned_tets, 1, MPI_UINT64_T, rank, kTag, comm);
}

MeshPart Receive(MPI_Comm comm) {
  MeshPart part;
  ForEachArray(&part, [&](auto* values) {
    const ContiguousType unit(sizeof(*values->data()), MPI_BYTE);
    MPI_Status status;
    MPI_Probe(0, kTag, comm, &status);
    int count = 0;
    MPI_Get_count(&status, unit, &count);
    values->resize(count);
    MPI_Recv(values->data(), count, unit, 0, kTag, comm, MPI_STATUS_IGNORE);
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
