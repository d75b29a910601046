#pragma once

#include <mpi.h>
#include <petscsf.h>

#include <cstddef>
#include <vector>

#include "octupole/distributed/internal/contiguous_type.h"
#include "octupole/distributed/internal/petsc.h"
#include "octupole/distributed/mesh_part.h"

namespace octupole::internal {

/// Copies values of vertices from the ranks that own them to those for which they are ghosts.
class Halo {
 public:
  /// Collective. \param num_owned of this rank, whose vertices come before its ghosts.
  Halo(MPI_Comm comm, std::size_t num_owned, const std::vector<GhostSource>& ghosts);

  /// Starts to copy, and ends it; in between, nothing may be written. `unit` is one value, without gaps.
  void Begin(MPI_Datatype unit, const void* owned, void* ghosts) const;
  void End(MPI_Datatype unit, const void* owned, void* ghosts) const;

  /// Both at once on the values of all vertices of this rank.
  template <typename Value>
  void Update(std::vector<Value>* values) const {
    const ContiguousType unit(sizeof(Value), MPI_BYTE);
    Begin(unit, values->data(), values->data() + num_owned_);
    End(unit, values->data(), values->data() + num_owned_);
  }

  /// What this rank sends when all values are copied: messages, and values in them.
  std::size_t num_messages() const { return num_messages_; }
  std::size_t num_sent() const { return num_sent_; }

 private:
  PetscHandle<PetscSF, PetscSFDestroy> star_forest_;
  std::size_t num_owned_;
  std::size_t num_messages_ = 0;
  std::size_t num_sent_ = 0;
};

}  // namespace octupole::internal
