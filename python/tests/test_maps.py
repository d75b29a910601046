import subprocess

import numpy as np
import pytest

import octupole

BOX = octupole.box_mesh((3, 2, 2), (3.0, 2.0, 2.0))
CONSTANT = np.broadcast_to(np.eye(3), (len(BOX.points), 3, 3))


def test_a_constant_field_maps_a_box_to_itself():
    mesh = octupole.seamless_map(BOX, CONSTANT, size=0.5)
    assert mesh.is_valid and len(mesh.flipped) == 0 and mesh.size == 0.5
    corners = mesh.mesh.points[mesh.mesh.tets]
    # Up to the order and signs of the axes: edges are as long as in the box, in units of size.
    for i, j in [(0, 1), (0, 2), (0, 3), (1, 2), (1, 3), (2, 3)]:
        expected = np.linalg.norm(corners[:, i] - corners[:, j], axis=1) / 0.5
        np.testing.assert_allclose(np.linalg.norm(mesh.parameters[:, i] - mesh.parameters[:, j], axis=1), expected)
    assert mesh.quality()["parameter_volume"] == pytest.approx(12 / 0.5**3)
    assert mesh.obstacles() == []
    assert not mesh.is_integer_grid


def test_an_integer_grid_from_an_earlier_map():
    first = octupole.seamless_map(BOX, CONSTANT, size=0.5)
    iterations = []
    second = octupole.seamless_map(
        BOX, CONSTANT, size=1, integer=True, start=first, callback=lambda iteration, *_: iterations.append(iteration)
    )
    assert second.is_integer_grid and iterations[0] == 1
    assert second.quality()["parameter_volume"] == pytest.approx(3 * 2 * 2)
    with pytest.raises(ValueError, match="the start is a map of another mesh"):
        octupole.seamless_map(octupole.box_mesh((2, 2, 2), (1.0, 1.0, 1.0)), np.broadcast_to(np.eye(3), (27, 3, 3)), start=first)


def test_it_is_that_of_the_command(command, tmp_path):
    points = BOX.points * [1, 1, 1.5]
    field = octupole.solve(points, BOX.tets)
    field.write(tmp_path / "box.vtu")
    subprocess.run(
        [command, "map", tmp_path / "box.vtu", "--field", tmp_path / "box.vtu", "-o", tmp_path / "command.hexex", "--quiet"],
        check=True,
    )
    octupole.seamless_map(field.mesh, field.frames).write(tmp_path / "python.hexex")
    assert (tmp_path / "python.hexex").read_bytes() == (tmp_path / "command.hexex").read_bytes()


def test_wrong_values_are_named(tmp_path):
    with pytest.raises(ValueError, match="size: -1.0* is not positive"):
        octupole.seamless_map(BOX, CONSTANT, size=-1)
    with pytest.raises(ValueError, match="frames"):
        octupole.seamless_map(BOX, CONSTANT[1:])
    mesh = octupole.seamless_map(BOX, CONSTANT)
    with pytest.raises(ValueError, match="ends in .hexex or .vtu"):
        mesh.write(tmp_path / "map.txt")
    with pytest.raises(OSError, match="map.vtu"):
        mesh.write(tmp_path / "missing" / "map.vtu")


def test_an_error_in_the_callback_is_raised(bracket):
    def fail(iteration, energy, seconds):
        raise RuntimeError("enough")

    mesh = octupole.read(bracket)
    with pytest.raises(RuntimeError, match="enough"):
        octupole.seamless_map(mesh, octupole.solve(mesh, max_iterations=30).frames, callback=fail)
