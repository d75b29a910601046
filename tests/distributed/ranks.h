#pragma once

#include <mpi.h>

#include <filesystem>
#include <list>
#include <string>
#include <vector>

#include "test_files.h"

namespace octupole {

inline int Rank() {
  int rank = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  return rank;
}

inline int NumRanks() {
  int num_ranks = 0;
  MPI_Comm_size(MPI_COMM_WORLD, &num_ranks);
  return num_ranks;
}

/// A folder that all ranks share.
class SharedFolder {
 public:
  SharedFolder() {
    std::string name;
    if (Rank() == 0) {
      own_.emplace_back();
      name = own_.back().path().string();
    }
    int length = static_cast<int>(name.size());
    MPI_Bcast(&length, 1, MPI_INT, 0, MPI_COMM_WORLD);
    name.resize(length);
    MPI_Bcast(name.data(), length, MPI_CHAR, 0, MPI_COMM_WORLD);
    path_ = name;
  }
  ~SharedFolder() { MPI_Barrier(MPI_COMM_WORLD); }
  SharedFolder(const SharedFolder&) = delete;
  SharedFolder& operator=(const SharedFolder&) = delete;

  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }

 private:
  std::list<TemporaryFolder> own_;
  std::filesystem::path path_;
};

/// The values of all ranks, one rank's after the other's, on all ranks.
template <typename Value>
std::vector<Value> OfAllRanks(const std::vector<Value>& mine) {
  const int num_bytes = static_cast<int>(mine.size() * sizeof(Value));
  std::vector<int> sizes(NumRanks()), offsets(NumRanks() + 1, 0);
  MPI_Allgather(&num_bytes, 1, MPI_INT, sizes.data(), 1, MPI_INT, MPI_COMM_WORLD);
  for (int i = 0; i < NumRanks(); ++i) offsets[i + 1] = offsets[i] + sizes[i];
  std::vector<Value> all(offsets.back() / sizeof(Value));
  MPI_Allgatherv(mine.data(), num_bytes, MPI_BYTE, all.data(), sizes.data(), offsets.data(), MPI_BYTE, MPI_COMM_WORLD);
  return all;
}

}  // namespace octupole
