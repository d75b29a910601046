#include "octupole/distributed/internal/petsc.h"

#include <new>
#include <stdexcept>
#include <string>

namespace octupole::internal {

void Check(PetscErrorCode code) {
  if (code == 0) return;
  if (code == PETSC_ERR_MEM) throw std::bad_alloc();
  const char* text = nullptr;
  char* specific = nullptr;
  PetscErrorMessage(code, &text, &specific);
  std::string message = "PETSc: " + std::string(text == nullptr ? "error " + std::to_string(code) : text);
  if (specific != nullptr && *specific != '\0') message += ": " + std::string(specific);
  throw std::runtime_error(message);
}

}  // namespace octupole::internal
