"""Spherical harmonics from their textbook definition, as values at points: nothing of it knows the library."""

import math

import numpy as np
from numpy.polynomial import legendre


def random_rotations(count, seed):
    q, r = np.linalg.qr(np.random.default_rng(seed).normal(size=(count, 3, 3)))
    q = q * np.sign(np.diagonal(r, axis1=1, axis2=2))[:, None, :]
    return q * np.linalg.det(q)[:, None, None]


def random_directions(count, seed):
    x = np.random.default_rng(seed).normal(size=(count, 3))
    return x / np.linalg.norm(x, axis=1, keepdims=True)


def basis(directions, degree):
    """Y_{l,m}, m = -l .. l, real and orthonormal, without Condon-Shortley sign: (..., 2 l + 1)."""
    x, y, z = np.moveaxis(directions, -1, 0)
    phi, sine = np.arctan2(y, x), np.hypot(x, y)
    p = legendre.Legendre.basis(degree)
    values = []
    for m in range(-degree, degree + 1):
        k = abs(m)
        norm = math.sqrt((2 * degree + 1) / (4 * math.pi) * math.factorial(degree - k) / math.factorial(degree + k))
        associated = sine**k * (p.deriv(k)(z) if k else p(z))
        angular = 1 if m == 0 else math.sqrt(2) * (np.cos(k * phi) if m > 0 else np.sin(k * phi))
        values.append(norm * associated * angular)
    return np.stack(values, axis=-1)


def coefficients(values, directions, degree):
    """Of the harmonic with these values at many directions, and no part of another degree."""
    return np.linalg.lstsq(basis(directions, degree), values, rcond=None)[0]


def frame_function(frame, directions, degree):
    """Any function of degree 3 or 4 with a frame's symmetry and no part of another degree, at unit directions."""
    along = directions @ frame
    return along.prod(axis=-1) if degree == 3 else (along**4).sum(axis=-1) - 3 / 5


def harmonic_of_frame(frame, degree):
    directions = random_directions(200, seed=5)
    h = coefficients(frame_function(frame, directions, degree), directions, degree)
    return h / np.linalg.norm(h)
