#include "octupole/distributed/distributed_error.h"

#include <algorithm>
#include <exception>
#include <new>
#include <string>

namespace octupole {

void DoTogether(MPI_Comm comm, const std::function<void()>& work) {
  int rank = 0, num_ranks = 0;
  MPI_Comm_rank(comm, &rank);
  MPI_Comm_size(comm, &num_ranks);
  std::string message;
  bool has_failed = true;
  try {
    work();
    has_failed = false;
  } catch (const std::bad_alloc&) {
    message = "out of memory";
  } catch (const std::exception& error) {
    message = error.what();
  }
  if (rank > 0) message.insert(0, "rank " + std::to_string(rank) + ": ");
  int first_failed = has_failed ? rank : num_ranks;
  MPI_Allreduce(MPI_IN_PLACE, &first_failed, 1, MPI_INT, MPI_MIN, comm);
  if (first_failed == num_ranks) return;
  int length = static_cast<int>(message.size());
  MPI_Bcast(&length, 1, MPI_INT, first_failed, comm);
  message.resize(length);
  MPI_Bcast(message.data(), length, MPI_CHAR, first_failed, comm);
  throw DistributedError(message);
}

}  // namespace octupole
