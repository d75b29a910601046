#pragma once

#include <mpi.h>

#include <functional>
#include <stdexcept>

namespace octupole {

/// An error that all ranks of a communicator throw alike, so that none waits for another: the program can go on. Its
/// message begins with "rank N: " where it is not the first rank's.
class DistributedError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Does what a rank does by itself, and waits for the others to have done theirs. Collective.
/// \throw DistributedError on all ranks when `work` throws a std::exception on any: the message is that of the lowest
/// of these.
void DoTogether(MPI_Comm comm, const std::function<void()>& work);

}  // namespace octupole
