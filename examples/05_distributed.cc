// A frame field on a DMPlex of one's own, on all the ranks that mpirun starts: mpirun -n 3 05_distributed -tao_monitor

#include <octupole/distributed/distributed_solver.h>
#include <octupole/frames/frame.h>
#include <octupole/mesh/box_mesh.h>
#include <petscdmplex.h>

#include <algorithm>
#include <vector>

int main(int argc, char** argv) {
  PetscCall(PetscInitialize(&argc, &argv, nullptr, nullptr));
  // Stands for a mesh of yours: the first rank has a box of tets, which PETSc deals out.
  int rank = 0;
  MPI_Comm_rank(PETSC_COMM_WORLD, &rank);
  octupole::TetMesh box;
  if (rank == 0) box = octupole::MakeBoxMesh({12, 8, 8}, {3, 2, 2});
  DM dm = nullptr, dealt = nullptr;
  PetscCall(DMPlexCreateFromCellListPetsc(PETSC_COMM_WORLD, 3, static_cast<PetscInt>(box.tets.size()),
                                          static_cast<PetscInt>(box.points.size()), 4, PETSC_TRUE,
                                          reinterpret_cast<const PetscInt*>(box.tets.data()), 3,
                                          reinterpret_cast<const PetscReal*>(box.points.data()), &dm));
  PetscCall(DMPlexDistribute(dm, 0, nullptr, &dealt));
  DM mesh = dealt == nullptr ? dm : dealt;

  octupole::DistributedOptions<3> options;
  options.max_gathered_vertices = 200;  // only because this mesh is small
  const octupole::DistributedField<3> field = octupole::SolveDistributed<3>(mesh, options);

  // One frame per vertex of this rank, in the order of the DMPlex. That of a box is its axes.
  double largest = 0;
  for (const Eigen::Matrix3d& frame : field.frames) {
    largest = std::max(largest, octupole::FrameDifference<4>(frame, Eigen::Matrix3d::Identity()));
  }
  MPI_Allreduce(MPI_IN_PLACE, &largest, 1, MPI_DOUBLE, MPI_MAX, PETSC_COMM_WORLD);
  PetscCall(PetscPrintf(PETSC_COMM_WORLD, "%d iterations; at most %.1e from the axes of the box\n",
                        static_cast<int>(field.iterations.size()), largest));
  PetscCall(DMDestroy(&dealt));
  PetscCall(DMDestroy(&dm));
  PetscCall(PetscFinalize());
  return largest < 1e-4 ? 0 : 1;
}
