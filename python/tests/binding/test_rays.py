# SPDX-License-Identifier: Apache-2.0
"""Rays to trace: their order, directions and origins."""

import numpy as np
import pytest

import sobb
from sobb import rays as make
from sobb.surface import Surface
from sobb.view import View

VIEW = View((0, 0, 5), (0, 0, 0), (0, 1, 0), 60.0)


def test_tile_order_is_packets_of_squares():
    pixels = make.tile_order(24, 16)
    np.testing.assert_array_equal(np.sort(pixels), np.arange(24 * 16))
    y, x = np.divmod(pixels.reshape(-1, 16), 24)
    assert ((x // 4).max(axis=1) == (x // 4).min(axis=1)).all()
    assert ((y // 4).max(axis=1) == (y // 4).min(axis=1)).all()
    np.testing.assert_array_equal(pixels[:5], [0, 1, 2, 3, 24])


@pytest.mark.parametrize(("width", "height"), [(1, 1), (3, 9), (13, 7), (8, 8)])
def test_tile_order_of_any_size(width, height):
    pixels = make.tile_order(width, height)
    np.testing.assert_array_equal(np.sort(pixels), np.arange(width * height))


def test_primary():
    rays, pixels = make.primary(VIEW, 30, 20)
    assert rays.dtype == sobb.ray_dtype and rays.shape == (600,)
    np.testing.assert_allclose(np.linalg.norm(rays["direction"], axis=1), 1, rtol=1e-6)
    assert (rays["origin"] == (0, 0, 5)).all() and np.isinf(rays["tmax"]).all()
    across = rays["direction"][np.argsort(pixels)].reshape(20, 30, 3)
    assert (np.diff(across[..., 0], axis=1) > 0).all(), "x grows to the right"
    assert (np.diff(across[..., 1], axis=0) < 0).all(), "y falls downwards"
    top = across[0, 14:16].mean(axis=0)
    angle = np.degrees(np.arctan2(top[1], -top[2]))
    assert 27 < angle < 30, "half of vfov, but half a pixel"


def test_diffuse(mesh, hierarchy, rays):
    points = Surface(hierarchy).points(rays, hierarchy.intersect(rays))
    bounces = make.diffuse(points, seed=1)
    np.testing.assert_array_equal(bounces, make.diffuse(points, seed=1))
    assert (bounces != make.diffuse(points, seed=2)).any()
    cosine = np.einsum("ij,ij->i", bounces["direction"], points.normal)
    assert (cosine > 0).all()
    assert abs(cosine.mean() - 2 / 3) < 0.03, "the mean of a cosine distribution"
    lift = np.einsum("ij,ij->i", bounces["origin"] - points.position, points.normal)
    np.testing.assert_allclose(lift, points.epsilon, rtol=0.2)


def test_random_in_box():
    rays = make.random_in_box((0, 0, 0), (1, 2, 3), 100, seed=3)
    assert (rays["origin"] >= 0).all() and (rays["origin"] <= (1, 2, 3)).all()
    flat = make.random_in_box((1, 1, 1), (1, 1, 1), 10, seed=3)
    assert flat["direction"].any(axis=1).all()
