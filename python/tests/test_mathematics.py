import numpy as np
import pytest
import sampled_harmonics as sampled

import octupole

DEGREES = [3, 4]
FRAMES = sampled.random_rotations(20, seed=1)


@pytest.mark.parametrize("degree", DEGREES)
def test_basis_is_that_of_the_textbook(degree):
    directions = sampled.random_directions(50, seed=2)
    values = octupole.harmonic_basis(directions.reshape(5, 10, 3), degree)
    assert values.shape == (5, 10, 2 * degree + 1)
    np.testing.assert_allclose(values.reshape(50, -1), sampled.basis(directions, degree), atol=1e-14)
    np.testing.assert_allclose(octupole.harmonic_basis(2 * directions, degree),
                               2**degree * sampled.basis(directions, degree), atol=1e-12)


@pytest.mark.parametrize("degree", DEGREES)
def test_harmonic_of_frame_has_the_symmetry_of_the_frame(degree):
    harmonics = octupole.harmonic_of_frame(FRAMES, degree)
    for frame, h in zip(FRAMES, harmonics):
        expected = sampled.harmonic_of_frame(frame, degree)
        if degree == 3:
            expected = expected * np.sign(expected @ h)
        np.testing.assert_allclose(h, expected, atol=1e-12)


@pytest.mark.parametrize("degree", DEGREES)
def test_rotation_matrix_rotates_functions(degree):
    directions = sampled.random_directions(60, seed=3)
    h = np.random.default_rng(4).normal(size=2 * degree + 1)
    for rotation, matrix in zip(FRAMES, octupole.rotation_matrix(FRAMES, degree)):
        # f(R^-1 x), x being rows here
        rotated = sampled.basis(directions @ rotation, degree) @ h
        np.testing.assert_allclose(sampled.basis(directions, degree) @ (matrix @ h), rotated, atol=1e-12)


@pytest.mark.parametrize("degree", DEGREES)
def test_nearest_frame_finds_the_frame_and_is_beaten_by_none(degree):
    exact = octupole.nearest_frame(octupole.harmonic_of_frame(FRAMES, degree) * 0.3)
    np.testing.assert_allclose(octupole.frame_difference(exact, FRAMES, degree), 0, atol=1e-12)
    h = np.random.default_rng(6).normal(size=(5, 2 * degree + 1))
    nearest = octupole.nearest_frame(h)
    np.testing.assert_allclose(np.swapaxes(nearest, 1, 2) @ nearest, np.broadcast_to(np.eye(3), (5, 3, 3)), atol=1e-12)
    np.testing.assert_allclose(np.linalg.det(nearest), 1)
    for one, frame in zip(h, nearest):
        best = abs(one @ sampled.harmonic_of_frame(frame, degree))
        others = [one @ sampled.harmonic_of_frame(r, degree) for r in sampled.random_rotations(300, seed=7)]
        assert best >= max(np.abs(others) if degree == 3 else others)


@pytest.mark.parametrize("degree", DEGREES)
def test_frame_difference_is_the_distance_of_sampled_harmonics(degree):
    frames, others = FRAMES[:10], FRAMES[10:]
    difference = octupole.frame_difference(frames, others, degree)
    for r, q, value in zip(frames, others, difference):
        a, b = sampled.harmonic_of_frame(r, degree), sampled.harmonic_of_frame(q, degree)
        minus, plus = (a - b) @ (a - b), (a + b) @ (a + b)
        assert value == pytest.approx(minus * plus if degree == 3 else minus, abs=1e-12)


def test_frame_difference_broadcasts():
    table = octupole.frame_difference(FRAMES[:, None], FRAMES[None, :])
    assert table.shape == (20, 20)
    np.testing.assert_allclose(np.diagonal(table), 0, atol=1e-12)
    np.testing.assert_allclose(table, table.T, atol=1e-12)
    assert octupole.frame_difference(FRAMES[0], FRAMES[1]).shape == ()


def test_frame_angle_of_a_small_turn():
    t = np.radians([1.0, 5.0, 40.0, 50.0, 90.0])
    turns = np.zeros((5, 3, 3))
    turns[:, 0, 0] = turns[:, 1, 1] = np.cos(t)
    turns[:, 1, 0], turns[:, 0, 1], turns[:, 2, 2] = np.sin(t), -np.sin(t), 1
    np.testing.assert_allclose(octupole.frame_angle(FRAMES[0] @ turns, FRAMES[0]), [1, 5, 40, 40, 0], atol=1e-6)


def test_deviation_is_zero_on_frames_alone():
    for degree in DEGREES:
        np.testing.assert_allclose(octupole.deviation(octupole.harmonic_of_frame(FRAMES, degree)), 0, atol=1e-24)
    zonal = np.eye(7)[3]  # Y_{3,0}, whose only quadric is l (l + 1) / 3 = 4
    assert octupole.deviation(zonal) == pytest.approx(16)
    rotated = octupole.rotation_matrix(FRAMES) @ (2 * zonal)
    np.testing.assert_allclose(octupole.deviation(rotated), 16 * 2**4)


def test_map_to_degree_four():
    a = octupole.harmonic_of_frame(FRAMES)
    np.testing.assert_allclose(octupole.hexadecapole_of_octupole(a), octupole.harmonic_of_frame(FRAMES, 4), atol=1e-12)


def test_leading_dimensions_and_kinds_of_arrays():
    h = octupole.harmonic_of_frame(FRAMES).reshape(4, 5, 7)
    frames = octupole.nearest_frame(h)
    assert frames.shape == (4, 5, 3, 3) and frames.flags.writeable
    np.testing.assert_array_equal(octupole.nearest_frame(np.asfortranarray(h)), frames)
    np.testing.assert_array_equal(octupole.nearest_frame(h[::-1, ::2]), frames[::-1, ::2])
    np.testing.assert_array_equal(octupole.nearest_frame(h.tolist()), frames)
    assert octupole.nearest_frame(h[0, 0]).shape == (3, 3)
    assert octupole.nearest_frame(np.empty((0, 9))).shape == (0, 3, 3)


@pytest.mark.parametrize("call, message", [
    (lambda: octupole.nearest_frame(np.zeros((3, 7))), "nearest_frame: element 0: "),
    (lambda: octupole.nearest_frame([[1.0] * 7, [np.nan] * 7]), "nearest_frame: element 1: "),
    (lambda: octupole.nearest_frame(np.ones((3, 8))), r"h: the shape is \(3, 8\), not \(..., 7\) or \(..., 9\)"),
    (lambda: octupole.harmonic_of_frame(np.ones((2, 3, 3))), "harmonic_of_frame: element 0: "),
    (lambda: octupole.harmonic_of_frame(np.eye(4)), r"R: the shape is \(4, 4\), not \(..., 3, 3\)"),
    (lambda: octupole.rotation_matrix(np.eye(3), 5), "degree: 3 or 4 expected, not 5"),
    (lambda: octupole.harmonic_basis(np.ones(4)), "directions: the shape is"),
    (lambda: octupole.frame_difference(FRAMES[:2], FRAMES[:3]), "broadcast"),
])
def test_wrong_values_are_value_errors(call, message):
    with pytest.raises(ValueError, match=message):
        call()


@pytest.mark.parametrize("wrong", [np.ones(7, dtype=complex), ["a"] * 7, [None] * 7])
def test_what_are_no_numbers_is_a_type_error(wrong):
    with pytest.raises(TypeError, match="h: real numbers expected"):
        octupole.nearest_frame(wrong)
