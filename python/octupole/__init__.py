"""Frame fields on tetrahedral meshes and inside closed surfaces, and cross fields on surfaces.

    import octupole
    field = octupole.solve(points, tets)      # or octupole.solve(octupole.read("part.mesh"))
    field.frames                              # (n, 3, 3): the columns are the axes at each vertex
    field.write("part.vtu")

Coordinates are in any one unit of length, angles in degrees unless said otherwise. Arrays that belong to a mesh or to a
field are views of its memory and read-only; .copy() them to change them.

solve_grid() is there where the library was built with OpenVDB, OCTUPOLE_WITH_OPENVDB; elsewhere it raises
NotImplementedError.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Callable, Iterable, Optional, Tuple

from ._core import (
    Field,
    FieldQuality,
    GraphField,
    GridField,
    GridQuality,
    SeamlessMap,
    SingularCurve,
    SingularCurves,
    SurfaceField,
    TetMesh,
    TriangleMesh,
    __version__,
    _solve,
    _solve_graph,
    _solve_grid,
    _solve_surface,
    box_mesh,
    deviation,
    frame_angle,
    frame_difference,
    harmonic_basis,
    harmonic_of_frame,
    hexadecapole_of_octupole,
    info,
    measure,
    nearest_frame,
    read,
    read_surface,
    rotation_matrix,
    seamless_map,
)

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

__all__ = [
    "Field",
    "FieldQuality",
    "GraphField",
    "GridField",
    "GridQuality",
    "SeamlessMap",
    "SingularCurve",
    "SingularCurves",
    "SurfaceField",
    "TetMesh",
    "TriangleMesh",
    "box_mesh",
    "deviation",
    "frame_angle",
    "frame_difference",
    "harmonic_basis",
    "harmonic_of_frame",
    "hexadecapole_of_octupole",
    "info",
    "measure",
    "nearest_frame",
    "read",
    "read_surface",
    "rotation_matrix",
    "seamless_map",
    "solve",
    "solve_graph",
    "solve_grid",
    "solve_surface",
]

# callback(iteration, energy, seconds)
Callback = Callable[[int, float, float], Any]


def solve(
    points: TetMesh | ArrayLike,
    tets: Optional[ArrayLike] = None,
    *,
    degree: int = 3,
    method: str = "penalty",
    feature_angle: float = 40.0,
    seed: int = 0,
    starts: int = 15,
    threads: int = 1,
    solver: str = "fast",
    max_iterations: Optional[int] = None,
    regions: Optional[ArrayLike] = None,
    follow_regions: Optional[bool] = None,
    feature_edges: Optional[ArrayLike] = None,
    constraints: Optional[Iterable[Tuple[ArrayLike, ArrayLike]]] = None,
    start: Optional[GraphField | ArrayLike] = None,
    weights: str = "uniform",
    callback: Optional[Callback] = None,
) -> Field:
    """A frame field on a tet mesh, smooth inside and aligned with the boundary.

    points: (n, 3) coordinates; or a TetMesh, as read() gives it, without `tets`.
    tets: (m, 4) indices of points, from 0.
    degree: 3 for octupoles, 4 for hexadecapoles.
    method: "penalty", or of the classics of degree 4 "ray-sokolov", "huang" or "mbo". These minimise over frames;
        `degree` says only which of their harmonics are the coefficients.
    feature_angle: degrees between normals, above which an edge of the boundary is a feature; the field follows it.
    seed: of the random starts. The same seed gives the same field.
    starts: that the solver "fast" tries at most, until two agree on the lowest energy; five from 14,000 vertices on.
    threads: for the solver; the field does not depend on it.
    solver: "fast", or of Ceres "lbfgs", "cgnr" or "cholesky".
    max_iterations: stop there, converged or not.
    regions: (m,) integers, the material of each tet.
    follow_regions: whether faces between regions, and tagged triangles inside, align the field as the boundary does; if
        None, where they make surfaces.
    feature_edges: (k, 2) pairs of points, edges that the field is to follow; no others are searched for then.
    constraints: pairs (vertices, directions), what the field keeps to on top of the boundary: vertices (k,) and, with
        them, either axes (k, 3) of any length or frames (k, 3, 3) with the axes as columns.
    start: an earlier field, from which the solver starts: a Field, of this mesh or another one; or frames (n, 3, 3), or
        coefficients (n, 7) or (n, 9).
    weights: of the edges: "uniform", or "fem", which makes fields on meshes graded and even comparable.
    callback: called as callback(iteration, energy, seconds) after every iteration of the minimisation at work, often
        one on a coarser mesh. When it returns something true, the solver stops and the field reached so far is the
        result. What it raises stops the solver, too, and is raised by solve().

    Python's lock is released while solving. Ctrl-C raises KeyboardInterrupt at the next iteration.
    Raises ValueError naming the first value that is wrong, TypeError for arrays of another kind.
    """
    if isinstance(points, TetMesh):
        if tets is not None:
            raise TypeError("solve: a TetMesh comes without tets, it has its own")
        mesh = points
        if regions is not None or feature_edges is not None:
            mesh = mesh._replaced(regions, feature_edges)
    else:
        mesh = TetMesh(points, tets, regions=regions, feature_edges=feature_edges)
    return _solve(
        mesh,
        degree=degree,
        method=method,
        feature_angle=feature_angle,
        follow_regions=follow_regions,
        seed=seed,
        starts=starts,
        threads=threads,
        solver=solver,
        max_iterations=max_iterations,
        constraints=constraints,
        start=start,
        weights=weights,
        callback=callback,
    )


def _surface(
    caller: str, points: TriangleMesh | ArrayLike, triangles: Optional[ArrayLike], feature_edges: Optional[ArrayLike]
) -> TriangleMesh:
    if not isinstance(points, TriangleMesh):
        return TriangleMesh(points, triangles, feature_edges=feature_edges)
    if triangles is not None:
        raise TypeError(f"{caller}: a TriangleMesh comes without triangles, it has its own")
    if feature_edges is None:
        return points
    return TriangleMesh(
        points.points, points.triangles, feature_edges=feature_edges, feature_points=points.feature_points
    )


def solve_surface(
    points: TriangleMesh | ArrayLike,
    triangles: Optional[ArrayLike] = None,
    *,
    degree: int = 3,
    method: str = "penalty",
    feature_angle: float = 40.0,
    boundary: str = "aligned",
    seed: int = 0,
    starts: int = 15,
    threads: int = 1,
    solver: str = "fast",
    max_iterations: Optional[int] = None,
    feature_edges: Optional[ArrayLike] = None,
    constraints: Optional[Iterable[Tuple[ArrayLike, ArrayLike]]] = None,
    start: Optional[GraphField | ArrayLike] = None,
    weights: str = "uniform",
    callback: Optional[Callback] = None,
) -> SurfaceField:
    """A cross field on a surface: frames with the surface's normal as one axis.

    points: (n, 3) coordinates; or a TriangleMesh, as read_surface() gives it, without `triangles`.
    triangles: (m, 3) indices of points, from 0; neighbours are expected to be oriented alike.
    boundary: where the surface is open, its border: "aligned" or "free".

    All else, and what it raises, is as in solve().
    """
    return _solve_surface(
        _surface("solve_surface", points, triangles, feature_edges),
        degree=degree,
        method=method,
        feature_angle=feature_angle,
        boundary=boundary,
        seed=seed,
        starts=starts,
        threads=threads,
        solver=solver,
        max_iterations=max_iterations,
        constraints=constraints,
        start=start,
        weights=weights,
        callback=callback,
    )


def solve_graph(
    edges: ArrayLike,
    weights: ArrayLike,
    alignments: Iterable[Optional[ArrayLike]],
    *,
    degree: int = 3,
    method: str = "penalty",
    seed: int = 0,
    starts: int = 15,
    threads: int = 1,
    solver: str = "fast",
    max_iterations: Optional[int] = None,
    start: Optional[GraphField | ArrayLike] = None,
    callback: Optional[Callback] = None,
) -> GraphField:
    """A frame field on any graph: a mesh type of your own, of any cells.

    edges: (m, 2) pairs of vertices that are to have similar frames.
    weights: (m,) of the edges, not negative, or one number for all.
    alignments: for each vertex what its frame must keep to: None, an axis (3,) of any length, or a frame (3, 3) with the
        axes as columns.

    All else, and what it raises, is as in solve().
    """
    return _solve_graph(
        edges,
        weights,
        alignments,
        degree=degree,
        method=method,
        seed=seed,
        starts=starts,
        threads=threads,
        solver=solver,
        max_iterations=max_iterations,
        start=start,
        callback=callback,
    )


def solve_grid(
    points: TriangleMesh | ArrayLike,
    triangles: Optional[ArrayLike] = None,
    *,
    resolution: Optional[int] = None,
    size: Optional[float] = None,
    levels: int = 1,
    degree: int = 3,
    method: str = "penalty",
    feature_angle: float = 40.0,
    seed: int = 0,
    starts: int = 15,
    threads: int = 1,
    solver: str = "fast",
    max_iterations: Optional[int] = None,
    feature_edges: Optional[ArrayLike] = None,
    repair: str = "none",
    callback: Optional[Callback] = None,
) -> GridField:
    """A frame field inside a closed surface, on a grid of cubes and without a tet mesh.

    points: (n, 3) coordinates; or a TriangleMesh without `triangles`, as read_surface() or TetMesh.boundary_surface()
        give it.
    triangles: (m, 3) indices of points, from 0, of any shape and orientation; they may cross each other.
    resolution: the number of finest cells along the longest side of the bounding box; 64, if there is no `size` either.
    size: the edge length of the finest cells, in the unit of the points.
    levels: how many sizes of cells there are, each twice the one before, from the surface inwards; 1 to 8.
    threads: for the grid, too.
    feature_edges: (k, 2) pairs of points, edges of the surface that the field is to follow. No others are searched for
        then.
    repair: where the surface is open: "none", a ValueError, or "close", which closes holes with caps.
    callback: as of solve(), on one grid after the other, from coarse to fine, each with iterations of its own. When it
        returns something true, the finer grids are still made and have the frames reached on the one before.

    All else is as in solve(). What is odd about the surface is a UserWarning. Python's lock is released; Ctrl-C raises
    KeyboardInterrupt at the next iteration, not while a grid is made.
    Raises ValueError naming the first value that is wrong, or the memory that a grid would need where there is not so
    much, and NotImplementedError where the library was built without OCTUPOLE_WITH_OPENVDB.
    """
    return _solve_grid(
        _surface("solve_grid", points, triangles, feature_edges),
        resolution=resolution,
        size=size,
        levels=levels,
        degree=degree,
        method=method,
        feature_angle=feature_angle,
        seed=seed,
        starts=starts,
        threads=threads,
        solver=solver,
        max_iterations=max_iterations,
        repair=repair,
        callback=callback,
    )
