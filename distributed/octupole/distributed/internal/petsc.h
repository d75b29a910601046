#pragma once

#include <petscsys.h>

#include <utility>

namespace octupole::internal {

/// Throws std::runtime_error with PETSc's own words for an error code that is not 0; std::bad_alloc where memory ran
/// out.
void Check(PetscErrorCode code);

/// An object of PETSc, destroyed with this one. Objects must go before PetscFinalize.
template <typename Object, PetscErrorCode (*kDestroy)(Object*)>
class PetscHandle {
 public:
  PetscHandle() = default;
  ~PetscHandle() { kDestroy(&object_); }
  PetscHandle(const PetscHandle&) = delete;
  PetscHandle& operator=(const PetscHandle&) = delete;
  PetscHandle(PetscHandle&& other) noexcept : object_(std::exchange(other.object_, nullptr)) {}
  PetscHandle& operator=(PetscHandle&& other) noexcept {
    std::swap(object_, other.object_);
    return *this;
  }

  operator Object() const { return object_; }
  /// For functions of PETSc that create an object.
  Object* operator&() { return &object_; }

 private:
  Object object_ = nullptr;
};

}  // namespace octupole::internal
