#pragma once

#include <cstddef>
#include <filesystem>
#include <vector>

#include "octupole/alignment/constraints.h"

namespace octupole {

/// Reads what a caller prescribes at the vertices of a mesh, which count from 0:
///
/// - `.vtu`: the mesh's points with the point array `constraint_axis`, and for frames `constraint_axis_2`, of three
///   numbers each; zero where nothing is prescribed.
/// - any other extension: text, a vertex in each line, with commas or spaces: `vertex,x,y,z` for an axis; with three
///   numbers more a second axis at a right angle to it, that is a frame; with another three all axes of one. '#'
///   begins a comment, and the first line may name the columns.
///
/// Directions have any length. A frame's axes are to be within a degree of right angles (see Alignment::TwoAxes).
///
/// \throw std::runtime_error "path:line: what is wrong", of a .vtu "path: what is wrong", with the value: no number, a
/// vertex that is none of the mesh's `num_vertices`, a direction that is zero or not finite, axes not at right angles,
/// or a vertex that another direction was prescribed for already.
std::vector<Constraint> ReadConstraints(const std::filesystem::path& path, std::size_t num_vertices);

}  // namespace octupole
