"""Needs a package built with OCTUPOLE_WITH_OPENVDB."""

import subprocess
import sys

import numpy as np
import pytest

import octupole

BOX = octupole.box_mesh((4, 4, 4))
CUBE = BOX.boundary_surface()


def cylinder(sides=48):
    """Of radius 1 around the z axis, from z = 0 to 2."""
    angles = 2 * np.pi * np.arange(sides) / sides
    ring = np.stack([np.cos(angles), np.sin(angles), 0 * angles], axis=1)
    points = np.concatenate([[[0, 0, 0], [0, 0, 2]], ring, ring + [0, 0, 2]])
    a = 2 + np.arange(sides)
    b = 2 + (np.arange(sides) + 1) % sides
    low, high = 0 * a, 0 * a + 1
    walls = [(a, b, b + sides), (a, b + sides, a + sides), (low, b, a), (high, a + sides, b + sides)]
    return points, np.concatenate([np.stack(wall, axis=1) for wall in walls])


@pytest.fixture(scope="module")
def field():
    return octupole.solve_grid(*cylinder(), size=0.1, levels=2)


@pytest.mark.parametrize("options", [{"resolution": 24}, {"size": 2.7, "levels": 2, "seed": 3, "threads": 2},
                                     {"resolution": 20, "degree": 4, "feature_angle": 60.0},
                                     {"resolution": 12, "degree": 4, "method": "mbo"}])
def test_the_command_writes_the_same_bytes(bracket, command, tmp_path, options):
    arguments = [word for name, value in options.items() for word in (f"--{name.replace('_', '-')}", str(value))]
    places = np.random.default_rng(1).uniform(-40, 76, size=(50, 3))
    np.savetxt(tmp_path / "points.csv", places, delimiter=",", fmt="%.17g")
    subprocess.run([command, "grid", bracket, "--quiet", "-o", tmp_path / "command.vtu",
                    "--singularities", tmp_path / "command_curves.vtu", "--sample", tmp_path / "points.csv",
                    "--sample-output", tmp_path / "samples.csv", *arguments], check=True)
    field = octupole.solve_grid(octupole.read(bracket).boundary_surface(), **options)
    field.write(tmp_path / "python.vtu")
    field.write_singularities(tmp_path / "python_curves.vtu")
    samples = np.genfromtxt(tmp_path / "samples.csv", delimiter=",", names=True)
    frames, inside = field.sample(places)
    np.testing.assert_array_equal(samples["is_inside"], inside)
    np.testing.assert_array_equal(np.stack([samples[f"frame_x_{k}"] for k in "xyz"], axis=1), frames[:, :, 0])
    for name in (".vtu", "_curves.vtu"):
        assert (tmp_path / f"python{name}").read_bytes() == (tmp_path / f"command{name}").read_bytes(), name


def test_a_surface_from_a_file(command, tmp_path):
    points, triangles = cylinder()
    points = points.astype(np.float32)  # which is what the reader keeps
    with open(tmp_path / "cylinder.obj", "w", encoding="ascii") as file:
        file.writelines(f"v {x!r} {y!r} {z!r}\n" for x, y, z in points.tolist())
        file.writelines(f"f {a + 1} {b + 1} {c + 1}\n" for a, b, c in triangles.tolist())
    subprocess.run([command, "grid", tmp_path / "cylinder.obj", "--resolution", "16", "--quiet",
                    "-o", tmp_path / "command.vtu", "--vdb", tmp_path / "command.vdb"], check=True)
    for field in (octupole.solve_grid(octupole.read_surface(tmp_path / "cylinder.obj"), resolution=16),
                  octupole.solve_grid(points, triangles, resolution=16)):
        field.write(tmp_path / "python.vtu")
        assert (tmp_path / "python.vtu").read_bytes() == (tmp_path / "command.vtu").read_bytes()
    field.write_vdb(tmp_path / "python.vdb")
    # Not byte by byte: the file has an identifier of its own.
    assert (tmp_path / "python.vdb").stat().st_size == (tmp_path / "command.vdb").stat().st_size


def test_what_a_field_on_a_grid_holds(field):
    n, m = len(field.nodes), len(field.cells)
    assert field.frames.shape == (n, 3, 3) and field.coefficients.shape == (n, 7) and field.alignment.shape == (n,)
    assert field.cells.shape == (m, 8) and field.level.shape == (m,) and field.distance.shape == (n,)
    np.testing.assert_allclose(np.swapaxes(field.frames, 1, 2) @ field.frames, np.broadcast_to(np.eye(3), (n, 3, 3)),
                               atol=1e-9)
    assert field.size == 0.1 and field.degree == 3 and field.termination == "CONVERGENCE" and field.energy > 0
    assert len(field.surface.triangles) == 4 * 48 and field.warnings == [] and field.conflicts == 0
    assert field.separating_size is None
    for array in (field.nodes, field.cells, field.distance, field.frames, field.coefficients):
        assert not array.flags.writeable and not array.flags.owndata
    assert octupole.solve_grid(CUBE, resolution=4, degree=4).coefficients.shape[1] == 9
    assert octupole.solve_grid(CUBE).size == 1 / 64
    assert "GridField" in repr(field) and "GridQuality" in repr(field.quality())


def test_cells_are_cubes_of_their_level(field):
    corners = field.nodes[field.cells]
    unit = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0, 0, 1], [1, 0, 1], [1, 1, 1], [0, 1, 1]])
    widths = field.size * 2.0**field.level
    assert set(field.level) == {0, 1}
    np.testing.assert_allclose(corners - corners[:, :1], unit * widths[:, None, None], atol=1e-12)
    # They cover the cylinder, and what is more is a layer of one cell.
    assert 2 * np.pi * 0.99 < (widths**3).sum() < 1.2**2 * np.pi * 2.2
    node, a, b = field.hanging_nodes.T
    assert len(node) > 0
    np.testing.assert_allclose(field.nodes[node], (field.nodes[a] + field.nodes[b]) / 2, atol=1e-12)


def test_distances_are_those_of_a_cylinder(field):
    radius, z = np.hypot(*field.nodes[:, :2].T), field.nodes[:, 2]
    inside = np.maximum(radius - 1, np.abs(z - 1) - 1)
    near = (inside < 0) & (inside > -0.2)
    # The polygon's sides are cos(180 / 48 degrees) from the axis.
    np.testing.assert_allclose(field.distance[near], inside[near], atol=3e-3)
    assert field.distance.dtype == np.float32 and (np.sign(field.distance)[np.abs(inside) > 0.01]
                                                   == np.sign(inside)[np.abs(inside) > 0.01]).all()


def test_a_cylinder_has_four_curves_along_its_axis(field):
    curves = field.singular_curves().curves
    assert [curve.valence for curve in curves] == [3] * 4
    for curve in curves:
        assert np.ptp(curve.points[:, 2]) > 1.8
    quality = field.quality()
    assert 0 < quality.boundary_rms_deg < 5 and quality.boundary_rms_deg <= quality.boundary_max_deg
    assert quality.boundary_samples > 1000 and 0 < quality.energy4 and 0 < quality.energy3


def test_a_tilted_cube_has_its_own_axes_everywhere():
    tilt = np.linalg.qr(np.array([[2.0, 1, 0], [-1, 2, 1], [0, 1, 3]]))[0]
    tilt *= np.linalg.det(tilt)
    field = octupole.solve_grid(CUBE.points @ tilt.T, CUBE.triangles, resolution=16)
    inside = field.distance < 0
    np.testing.assert_allclose(octupole.frame_angle(field.frames[inside], tilt), 0, atol=0.1)
    points = np.random.default_rng(1).uniform(0.01, 0.99, size=(200, 3))
    frames, contained = field.sample(points @ tilt.T)
    assert contained.dtype == bool and contained.all()
    np.testing.assert_allclose(octupole.frame_angle(frames, tilt), 0, atol=0.1)
    assert not field.sample((points + 3) @ tilt.T)[1].any()
    at_nodes = field.sample(field.nodes)[0]
    np.testing.assert_allclose(octupole.frame_angle(at_nodes, field.frames), 0, atol=1e-5)
    with pytest.raises(ValueError):
        field.sample([[0, np.nan, 0]])


def test_cells_as_tets_have_the_same_field(field):
    mesh, frames = field.tets()
    corners = mesh.points[mesh.tets]
    volumes = np.abs(np.linalg.det(corners[:, 1:] - corners[:, :1])) / 6
    assert volumes.sum() == pytest.approx(((field.size * 2.0**field.level)**3).sum()) and volumes.min() > 0
    assert frames.shape == (len(mesh.points), 3, 3)
    assert len(octupole.measure(mesh, frames).singular_triangles_by_type) > 0


def test_open_surfaces_are_closed_on_demand():
    points, triangles = cylinder()
    holey = triangles[:-48]
    with pytest.raises(ValueError, match="the surface is open"):
        octupole.solve_grid(points, holey, resolution=10)
    with pytest.warns(UserWarning, match="closed with caps"):
        field = octupole.solve_grid(points, holey, resolution=10, repair="close")
    assert len(field.warnings) == 1 and "closed with caps" in field.warnings[0]


@pytest.mark.parametrize("options, message", [
    ({"resolution": 8, "size": 0.1}, "either resolution or size"), ({"resolution": 0}, "resolution must be at least 1"),
    ({"size": -1.0}, "size"), ({"size": float("nan")}, "size"), ({"levels": 9}, "levels"),
    ({"degree": 5}, "degree: 3 or 4"),
    ({"repair": "glue"}, "repair: 'glue' is none of close, none"), ({"method": "magic"}, "method: 'magic'"),
    ({"feature_angle": 0}, "angle"), ({"threads": 0}, "threads must be at least 1"), ({"size": 1e-7}, "GB of memory"),
])
def test_wrong_options_are_value_errors(options, message):
    with pytest.raises(ValueError, match=message):
        octupole.solve_grid(CUBE, **options)


def test_wrong_surfaces():
    points, triangles = cylinder()
    with pytest.raises(ValueError, match=r"points: the shape is \(98, 2\), not \(n, 3\)"):
        octupole.solve_grid(points[:, :2], triangles)
    with pytest.raises(ValueError):
        octupole.solve_grid(points, triangles + 50)
    with pytest.raises(TypeError, match="solve_grid: a TriangleMesh comes without triangles"):
        octupole.solve_grid(CUBE, CUBE.triangles)
    with pytest.raises(OSError, match="cannot be written"):
        octupole.solve_grid(CUBE, resolution=3).write("/nowhere/f.vtu")


def test_marked_edges_are_followed():
    # Across a face of the cube, where nothing but the mark asks for more than the normal.
    line = np.flatnonzero((CUBE.points[:, 1:] == [0.5, 0]).all(axis=1))
    line = line[np.argsort(CUBE.points[line, 0])]
    edges = np.stack([line[:-1], line[1:]], axis=1)
    unmarked = octupole.solve_grid(CUBE, resolution=8)
    marked = octupole.solve_grid(CUBE.points, CUBE.triangles, resolution=8, feature_edges=edges)
    middle = np.linalg.norm(marked.nodes - [0.5, 0.5, 0], axis=1) < 0.9 / 8
    assert middle.any()
    assert (unmarked.alignment[middle] == 1).all() and (marked.alignment[middle] == 2).all()


def test_callback_sees_grids_from_coarse_to_fine_and_may_stop():
    seen = []
    octupole.solve_grid(*cylinder(), size=0.1, levels=2, callback=lambda i, energy, seconds: seen.append(i))
    assert seen.count(0) >= 2 or min(np.diff(seen)) < 0
    calls = []
    stopped = octupole.solve_grid(*cylinder(), size=0.1, levels=2, callback=lambda *all: calls.append(all) or True)
    assert len(calls) == 1 and stopped.termination == "USER_SUCCESS" and len(stopped.frames) == len(stopped.nodes)

    def fail(*_):
        calls.append(None)
        raise LookupError("mine")

    with pytest.raises(LookupError, match="mine"):
        octupole.solve_grid(*cylinder(), size=0.1, levels=2, callback=fail)
    assert len(calls) == 2


def test_ctrl_c_raises_keyboard_interrupt():
    # In a process of its own, so that a failure does not end the tests.
    program = """
import os, signal, octupole
surface = octupole.box_mesh((4, 4, 4)).boundary_surface()
count = [0]
def interrupt(*_):
    os.kill(os.getpid(), signal.SIGINT)
try:
    octupole.solve_grid(surface, resolution=12, callback=interrupt)
except KeyboardInterrupt:
    print("interrupted")
"""
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, timeout=300)
    assert done.stdout.split() == ["interrupted"], done.stderr
