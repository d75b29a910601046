#pragma once

#include <mpi.h>

namespace octupole::internal {

/// Several numbers or bytes as one value of MPI.
class ContiguousType {
 public:
  ContiguousType(int count, MPI_Datatype of) {
    MPI_Type_contiguous(count, of, &type_);
    MPI_Type_commit(&type_);
  }
  ~ContiguousType() { MPI_Type_free(&type_); }
  ContiguousType(const ContiguousType&) = delete;
  ContiguousType& operator=(const ContiguousType&) = delete;
  operator MPI_Datatype() const { return type_; }

 private:
  MPI_Datatype type_ = MPI_DATATYPE_NULL;
};

}  // namespace octupole::internal
