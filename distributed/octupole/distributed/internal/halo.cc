#include "octupole/distributed/internal/halo.h"

namespace octupole::internal {

Halo::Halo(MPI_Comm comm, std::size_t num_owned, const std::vector<GhostSource>& ghosts) : num_owned_(num_owned) {
  std::vector<PetscSFNode> roots;
  roots.reserve(ghosts.size());
  for (const GhostSource& ghost : ghosts) roots.push_back({ghost.rank, ghost.index});
  Check(PetscSFCreate(comm, &star_forest_));
  Check(PetscSFSetGraph(star_forest_, static_cast<PetscInt>(num_owned), static_cast<PetscInt>(roots.size()), nullptr,
                        PETSC_COPY_VALUES, roots.data(), PETSC_COPY_VALUES));
  Check(PetscSFSetFromOptions(star_forest_));
  Check(PetscSFSetUp(star_forest_));
  int rank = 0;
  PetscInt num_ranks = 0;
  const PetscMPIInt* ranks = nullptr;
  const PetscInt* offsets = nullptr;
  const PetscInt* roots_sent = nullptr;
  MPI_Comm_rank(comm, &rank);
  Check(PetscSFGetLeafRanks(star_forest_, &num_ranks, &ranks, &offsets, &roots_sent));
  for (PetscInt i = 0; i < num_ranks; ++i) {
    if (ranks[i] == rank) continue;
    ++num_messages_;
    num_sent_ += offsets[i + 1] - offsets[i];
  }
}

void Halo::Begin(MPI_Datatype unit, const void* owned, void* ghosts) const {
  Check(PetscSFBcastBegin(star_forest_, unit, owned, ghosts, MPI_REPLACE));
}

void Halo::End(MPI_Datatype unit, const void* owned, void* ghosts) const {
  Check(PetscSFBcastEnd(star_forest_, unit, owned, ghosts, MPI_REPLACE));
}

}  // namespace octupole::internal
