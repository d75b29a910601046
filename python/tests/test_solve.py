import gc
import inspect
import os
import signal
import subprocess
import sys
import threading

import numpy as np
import pytest

import octupole


@pytest.fixture(scope="module")
def field(bracket):
    return octupole.solve(octupole.read(bracket), seed=3)


def octahedron():
    points = [[1, 0, 0], [0, 1, 0], [-1, 0, 0], [0, -1, 0], [0, 0, 1], [0, 0, -1]]
    return points, [[0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4], [1, 0, 5], [2, 1, 5], [3, 2, 5], [0, 3, 5]]


@pytest.mark.parametrize("options", [{}, {"degree": 4}, {"degree": 4, "method": "ray-sokolov"}, {"feature_angle": 60},
                                     {"solver": "lbfgs", "max_iterations": 20}])
def test_the_command_writes_the_same_bytes(bracket, command, tmp_path, options):
    arguments = [word for name, value in options.items() for word in (f"--{name.replace('_', '-')}", str(value))]
    subprocess.run([command, "field", bracket, "--seed", "3", "--quiet", "-o", tmp_path / "command.vtu",
                    "--fra", tmp_path / "command.fra", "--quaternions", tmp_path / "command.txt",
                    "--singularities", tmp_path / "command_curves.vtu", *arguments], check=True)
    field = octupole.solve(octupole.read(bracket), seed=3, **options)
    field.write(tmp_path / "python.vtu")
    field.write_fra(tmp_path / "python.fra")
    field.write_quaternions(tmp_path / "python.txt")
    field.write_singularities(tmp_path / "python_curves.vtu")
    for name in (".vtu", ".fra", ".txt", "_curves.vtu"):
        assert (tmp_path / f"python{name}").read_bytes() == (tmp_path / f"command{name}").read_bytes(), name


def test_what_a_field_holds(field):
    n, m = len(field.mesh.points), len(field.mesh.tets)
    assert field.frames.shape == (n, 3, 3) and field.coefficients.shape == (n, 7) and field.alignment.shape == (n,)
    np.testing.assert_allclose(np.swapaxes(field.frames, 1, 2) @ field.frames, np.broadcast_to(np.eye(3), (n, 3, 3)),
                               atol=1e-9)
    np.testing.assert_allclose(np.linalg.det(field.frames), 1)
    assert field.tet_frames().shape == (m, 3, 3)
    assert field.degree == 3 and field.termination == "CONVERGENCE" and field.iterations > 0
    assert set(field.alignment) == {0, 1, 2} and set(field.seconds) == {"setup", "solve", "project"}
    assert octupole.solve(field.mesh, degree=4).coefficients.shape == (n, 9)


def test_frames_have_their_axes_as_columns():
    # A tilted cube: every frame is that of the cube, whose axes are columns up to order and sign.
    tilt = np.linalg.qr(np.random.default_rng(1).normal(size=(3, 3)))[0]
    tilt *= np.linalg.det(tilt)
    box = octupole.box_mesh((3, 3, 3))
    field = octupole.solve(box.points @ tilt.T, box.tets)
    np.testing.assert_allclose(octupole.frame_angle(field.frames, tilt), 0, atol=1e-3)
    # Of any row-wise reading of the array, half would be off by the tilt.
    np.testing.assert_allclose(np.abs(np.swapaxes(field.frames, 1, 2) @ tilt).max(axis=1), 1, atol=1e-6)


def test_quality_counts_as_numpy_does(field):
    tets, frames = field.mesh.tets, field.frames
    edges = np.unique(np.sort(np.concatenate([tets[:, [i, j]] for i in range(4) for j in range(i)])), axis=0)
    quality = field.quality()
    assert quality.edges == len(edges)
    a, b = frames[edges[:, 0]], frames[edges[:, 1]]
    cosines = np.swapaxes(a, 1, 2) @ b
    assert quality.energy4 == pytest.approx((5 / 3 * (3 - (cosines**4).sum(axis=(1, 2)))).sum())
    assert quality.energy3 == pytest.approx(octupole.frame_difference(a, b, 3).sum())
    assert quality.boundary_max_deg < 1e-4
    assert sum(quality.singular_triangles_by_type.values()) == quality.singular_triangles
    assert octupole.measure(field.mesh, frames.copy()).energy4 == quality.energy4
    constant = octupole.measure(field.mesh, np.broadcast_to(np.eye(3), frames.shape))
    assert constant.energy4 == pytest.approx(0, abs=1e-9) and constant.singular_triangles == 0


def test_singular_curves(field):
    structure = field.singular_curves()
    assert len(structure.curves) > 0
    for curve in structure.curves:
        assert curve.length == pytest.approx(np.linalg.norm(np.diff(curve.points, axis=0), axis=1).sum())
        assert curve.valence in (0, 3, 5) and curve.type in ("quarter", "half", "diagonal_half", "third")
        assert curve.is_loop == (curve.ends == ("none", "none"))
    ends = sum(end == "node" for curve in structure.curves for end in curve.ends)
    assert ends == structure.node_ends.sum() and structure.nodes.shape == (len(structure.node_ends), 3)


def test_arrays_are_views_that_outlive_the_field():
    field = octupole.solve(octupole.box_mesh((3, 3, 3)))
    frames, coefficients = field.frames, field.coefficients
    points = field.singular_curves
    for array, again in ((frames, field.frames), (coefficients, field.coefficients)):
        assert np.shares_memory(array, again) and not array.flags.writeable and not array.flags.owndata
    copies = frames.copy(), coefficients.copy()
    del field, points
    gc.collect()
    np.testing.assert_array_equal(frames, copies[0])
    np.testing.assert_array_equal(coefficients, copies[1])


def test_marked_edges_of_a_mesh_can_be_replaced():
    # The middle of the box: a marked edge there fixes an axis where the field is free otherwise.
    box = octupole.box_mesh((4, 4, 4))
    middle = int(np.flatnonzero((box.points == 0.5).all(axis=1))[0])
    above = int(np.flatnonzero((box.points == [0.5, 0.5, 0.75]).all(axis=1))[0])
    marked = octupole.TetMesh(box.points, box.tets, feature_edges=[[middle, above]])
    assert octupole.solve(box).alignment[middle] == 0
    assert octupole.solve(marked).alignment[middle] == 1
    assert octupole.solve(box.points, box.tets, feature_edges=[[middle, above]]).alignment[middle] == 1
    assert octupole.solve(marked, feature_edges=np.empty((0, 2), int)).alignment[middle] == 0


def test_the_command_writes_the_same_bytes_for_a_surface(command, tmp_path):
    # A cube of quadrangles: faces that are cut into triangles.
    cube = tmp_path / "cube.off"
    cube.write_text("OFF\n8 6 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n0 0 1\n1 0 1\n1 1 1\n0 1 1\n"
                    "4 0 3 2 1\n4 4 5 6 7\n4 0 1 5 4\n4 1 2 6 5\n4 2 3 7 6\n4 3 0 4 7\n")
    subprocess.run([command, "surface", cube, "--quiet", "-o", tmp_path / "command.vtu"], check=True)
    mesh = octupole.read_surface(cube)
    np.testing.assert_array_equal(mesh.faces, np.repeat(np.arange(6), 2))
    octupole.solve_surface(mesh).write(tmp_path / "python.vtu")
    assert (tmp_path / "python.vtu").read_bytes() == (tmp_path / "command.vtu").read_bytes()
    with pytest.raises(OSError, match="nowhere.off"):
        octupole.read_surface(tmp_path / "nowhere.off")


def test_regions_align_the_field_inside():
    # The middle plane of a box between two materials.
    box = octupole.box_mesh((4, 4, 4))
    middle = np.flatnonzero((box.points == 0.5).all(axis=1))[0]
    regions = (box.points[box.tets].mean(axis=1)[:, 2] > 0.5).astype(int)
    kinds = {follow: octupole.solve(box, regions=regions, follow_regions=follow).alignment[middle]
             for follow in (None, True, False)}
    assert kinds == {None: 1, True: 1, False: 0}
    assert octupole.solve(box).alignment[middle] == 0


def test_surface_field():
    points, triangles = octahedron()
    field = octupole.solve_surface(points, triangles, feature_angle=120)
    normals = np.array(points, dtype=float)
    np.testing.assert_allclose(np.abs((field.crosses()[:, :, 2] * normals).sum(axis=1)), 1, atol=1e-6)
    assert field.quarter_indices().sum() == 4 * 2  # Euler characteristic of the sphere
    assert octupole.solve_surface(field.mesh, feature_angle=120).energy == field.energy


@pytest.mark.parametrize("options, message", [
    ({"degree": 5}, "degree: 3 or 4 expected, not 5"),
    ({"method": "magic"}, "method: 'magic' is none of huang, mbo, penalty, ray-sokolov"),
    ({"solver": "magic"}, "solver: 'magic' is none of cgnr, cholesky, fast, lbfgs"),
    ({"method": "mbo", "solver": "lbfgs"}, "only the penalty method"),
    ({"feature_angle": 0}, "feature angle must lie between 0 and 180 degrees, not 0"),
    ({"feature_angle": float("nan")}, "feature angle must lie .* not nan"),
    ({"threads": 0}, "number of threads must be at least 1, not 0"),
])
def test_wrong_options_are_value_errors(options, message):
    with pytest.raises(ValueError, match=message):
        octupole.solve(octupole.box_mesh((1, 1, 1)), **options)


def test_writing_to_nowhere_is_an_os_error(field, tmp_path):
    for write in (field.write, field.write_fra, field.write_quaternions, field.write_singularities):
        with pytest.raises(OSError, match="cannot be written"):
            write(tmp_path / "nowhere" / "f")


def test_callback_sees_every_iteration_and_may_stop(bracket):
    mesh, seen = octupole.read(bracket), []
    whole = octupole.solve(mesh, callback=lambda iteration, energy, seconds: seen.append((iteration, energy, seconds)))
    assert seen[-1][0] == whole.iterations
    assert all(a[0] <= b[0] and a[2] <= b[2] for a, b in zip(seen, seen[1:]))
    stopped = octupole.solve(mesh, callback=lambda iteration, energy, seconds: iteration >= 5)
    assert stopped.termination == "USER_SUCCESS" and stopped.iterations == 5
    assert stopped.frames.shape == whole.frames.shape


def test_what_a_callback_raises_is_raised(bracket):
    def fail(iteration, energy, seconds):
        raise LookupError("mine")

    for options in ({}, {"solver": "lbfgs"}, {"method": "huang"}):
        with pytest.raises(LookupError, match="mine"):
            octupole.solve(octupole.read(bracket), callback=fail, **options)


@pytest.mark.parametrize("callback", ["None", "lambda *_: None"])
def test_ctrl_c_raises_keyboard_interrupt(callback):
    # In a process of its own, so that a failure does not end the tests.
    program = f"""
import os, signal, threading, octupole
mesh = octupole.box_mesh((40, 40, 40))
points = mesh.points + 0.3 * __import__("numpy").sin(9 * mesh.points[:, ::-1])
def interrupt():
    os.kill(os.getpid(), signal.SIGINT)
try:
    threading.Timer(0.1, interrupt).start()
    octupole.solve(points, mesh.tets, callback={callback})
except KeyboardInterrupt:
    print("interrupted")
    print(octupole.solve(octupole.box_mesh((2, 2, 2))).termination)
"""
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, timeout=300)
    assert done.stdout.split() == ["interrupted", "CONVERGENCE"], done.stderr


def test_other_threads_run_while_solving(bracket):
    mesh, events = octupole.read(bracket), []
    solving = threading.Event()

    def count():
        while not solving.is_set():
            events.append(1)
            solving.wait(0.001)

    # Were the lock held, the thread could not run before solve returns.
    thread = threading.Thread(target=count)
    interval = sys.getswitchinterval()
    sys.setswitchinterval(1000)
    try:
        thread.start()
        before = len(events)
        octupole.solve(mesh)
        assert len(events) > before + 10
    finally:
        sys.setswitchinterval(interval)
        solving.set()
        thread.join()


def test_solves_in_threads_do_not_disturb_each_other(bracket):
    mesh = octupole.read(bracket)
    fields = [None] * 3

    def run(k):
        fields[k] = octupole.solve(mesh, seed=k)

    threads = [threading.Thread(target=run, args=(k,)) for k in range(3)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    for k in range(3):
        np.testing.assert_array_equal(fields[k].coefficients, octupole.solve(mesh, seed=k).coefficients)


def test_memory_of_a_solve_is_freed():
    def resident():
        with open("/proc/self/statm", encoding="ascii") as file:
            return int(file.read().split()[1]) * os.sysconf("SC_PAGE_SIZE")

    def once():
        octupole.solve(mesh, max_iterations=1).frames.sum()

    mesh = octupole.box_mesh((20, 20, 20))
    for _ in range(3):
        once()
    before = resident()
    for _ in range(20):
        once()
    one_field = mesh.points.shape[0] * (9 + 7) * 8
    assert resident() - before < 5 * one_field


def test_every_function_says_what_it_takes():
    for name in octupole.__all__:
        thing = getattr(octupole, name)
        assert inspect.getdoc(thing), name
        if not inspect.isclass(thing):
            assert inspect.signature(thing).parameters, name
    assert "feature_angle" in inspect.signature(octupole.solve).parameters
    assert octupole.__version__.count(".") == 2
    assert signal.getsignal(signal.SIGINT) is signal.default_int_handler
