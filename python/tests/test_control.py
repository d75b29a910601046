import numpy as np
import pytest

import octupole

BOX = octupole.box_mesh((4, 4, 4))
MIDDLE = int(np.flatnonzero((BOX.points == 0.5).all(axis=1))[0])
TILT = np.linalg.qr(np.array([[2.0, 1, 0], [-1, 2, 1], [0, 1, 3]]))[0]
TILT = TILT * np.linalg.det(TILT)


def test_constraints_hold_in_every_method():
    for method in ("penalty", "ray-sokolov", "huang", "mbo"):
        field = octupole.solve(BOX, method=method, constraints=[([MIDDLE], [TILT])])
        assert octupole.frame_angle(field.frames[MIDDLE], TILT) < 1e-5
    axis = np.array([1.0, 2, 3])
    field = octupole.solve(BOX, constraints=[([MIDDLE], [axis])])
    assert np.abs(field.frames[MIDDLE].T @ axis).max() == pytest.approx(np.linalg.norm(axis), abs=1e-12)
    assert field.alignment[MIDDLE] == 1


@pytest.mark.parametrize("constraints", [
    [([10**6], [[1, 0, 0]])], [([0], [[0, 0, 0]])], [([0], [[np.nan, 0, 0]])], [([0, 1], [[1, 0, 0]])],
    [([0], [np.ones((3, 3))])], [([0], [[1, 0]])], [([0],)],
    [([MIDDLE, MIDDLE], [[1, 0, 0], [1, 1, 1]])],
])
def test_wrong_constraints_are_value_errors(constraints):
    with pytest.raises(ValueError):
        octupole.solve(BOX, constraints=constraints)


def test_start_of_this_mesh_and_of_another(bracket):
    mesh = octupole.read(bracket)
    cold = octupole.solve(mesh)
    for start in (cold, cold.frames, octupole.harmonic_of_frame(cold.frames)):
        warm = octupole.solve(mesh, start=start)
        assert warm.iterations < cold.iterations / 2
        assert warm.quality().energy4 < 1.01 * cold.quality().energy4
    finer = octupole.solve(octupole.box_mesh((6, 6, 6)), start=octupole.solve(BOX))
    np.testing.assert_allclose(octupole.frame_angle(finer.frames, np.eye(3)), 0, atol=1e-3)
    with pytest.raises(ValueError):
        octupole.solve(mesh, start=cold.frames[1:])
    with pytest.raises(ValueError, match="start: the shape is"):
        octupole.solve(mesh, start=np.ones((5, 8)))


def test_finite_element_weights_scale_with_the_mesh(bracket):
    mesh = octupole.read(bracket)
    frames = [octupole.solve(k * mesh.points, mesh.tets, weights="fem").frames for k in (1, 2)]
    np.testing.assert_allclose(octupole.frame_angle(*frames), 0, atol=1e-6)
    with pytest.raises(ValueError, match="weights: 'magic' is none of fem, uniform"):
        octupole.solve(mesh, weights="magic")


def test_sampling():
    field = octupole.solve(BOX.points @ TILT.T, BOX.tets)
    points = np.random.default_rng(1).uniform(-0.5, 1.5, size=(200, 3))
    frames, inside = field.sample(points @ TILT.T)
    assert inside.dtype == bool
    np.testing.assert_array_equal(inside, ((points > 0) & (points < 1)).all(axis=1))
    np.testing.assert_allclose(octupole.frame_angle(frames, TILT), 0, atol=1e-3)
    np.testing.assert_array_equal(field.sample(points @ TILT.T)[0], frames)
    with pytest.raises(ValueError):
        field.sample([[0, np.nan, 0]])
    with pytest.raises(ValueError, match="points: the shape is"):
        field.sample(points[:, :2])


def test_graph_of_a_mesh_gives_the_field_of_the_mesh():
    # A chain between two frames a turn of 40 degrees apart: it turns evenly.
    n, t = 9, np.radians(40)
    turned = np.array([[np.cos(t), -np.sin(t), 0], [np.sin(t), np.cos(t), 0], [0, 0, 1]])
    edges = np.stack([np.arange(n - 1), np.arange(1, n)], axis=1)
    field = octupole.solve_graph(edges, 1, [np.eye(3)] + [None] * (n - 2) + [turned])
    steps = octupole.frame_angle(field.frames[:-1], field.frames[1:])
    np.testing.assert_allclose(steps, 40 / (n - 1), atol=1e-2)
    # Twice the weight on the first half makes its steps smaller.
    uneven = octupole.solve_graph(edges, [4.0] * 4 + [1.0] * 4, [np.eye(3)] + [None] * (n - 2) + [turned])
    steps = octupole.frame_angle(uneven.frames[:-1], uneven.frames[1:])
    np.testing.assert_allclose(steps, [2] * 4 + [8] * 4, atol=0.2)
    assert type(field) is octupole.GraphField and field.coefficients.shape == (n, 7)


@pytest.mark.parametrize("edges, weights, alignments", [
    ([[0, 5]], 1, [None, None]), ([[0, 1]], -1, [None, None]), ([[0, 1]], [1, 2], [None, None]),
    ([[0, 1, 2]], 1, [None] * 3), ([[0, 1]], 1, [[0, 0, 0], None]), ([[0, 1]], np.nan, [None, None]),
])
def test_wrong_graphs_are_value_errors(edges, weights, alignments):
    with pytest.raises(ValueError):
        octupole.solve_graph(edges, weights, alignments)
