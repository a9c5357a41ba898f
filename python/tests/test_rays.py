# SPDX-License-Identifier: Apache-2.0
"""Rays and pictures."""

import numpy as np
import pytest
from PIL import Image

import sobb
from sobb import heat, image, render
from sobb import rays as make
from sobb.surface import Surface
from sobb.view import View, default_view

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


def test_pictures(hierarchy):
    view = default_view((-1, -1, -1), (1, 1, 1))
    heard = []
    picture = render.shaded(hierarchy, view, 41, 27, heard.append)
    assert picture.shape == (27, 41, 3) and picture.dtype == np.uint8
    assert picture.std() > 10, "something is to be seen"
    assert heard[-1] == 1
    np.testing.assert_array_equal(picture, render.shaded(hierarchy, view, 41, 27))
    work = render.work(hierarchy, view, 41, 27)
    assert work.shape == (27, 41) and work.max() > 0
    scale = heat.shared_scale(work)
    assert heat.picture(work, scale, "SOBB").size > (41, 27)


def test_colour_map_rises_in_lightness():
    luma = heat.colour_map() @ (0.2126, 0.7152, 0.0722)
    assert (np.diff(luma) > -0.75).all() and luma[-1] > 200 > 30 > luma[0]


def test_png_is_written_whole_or_not_at_all(tmp_path):
    path = tmp_path / "a.png"
    image.write_png(path, Image.new("RGB", (4, 3)))
    assert Image.open(path).size == (4, 3)

    class Broken:
        def save(self, file, _):
            file.write(b"half")
            raise OSError("disk full")

    before = path.read_bytes()
    with pytest.raises(OSError, match="disk full"):
        image.write_png(path, Broken())
    assert path.read_bytes() == before
    assert [entry.name for entry in tmp_path.iterdir()] == ["a.png"]
