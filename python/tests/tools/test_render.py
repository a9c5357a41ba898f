# SPDX-License-Identifier: Apache-2.0
"""Pictures: shaded ones, heat maps and their colours, and how they are written."""

import numpy as np
import pytest
from PIL import Image

from sobb.tools.render import heat, image, shading
from sobb.view import default_view


def test_pictures(hierarchy):
    view = default_view((-1, -1, -1), (1, 1, 1))
    heard = []
    picture = shading.shaded(hierarchy, view, 41, 27, heard.append)
    assert picture.shape == (27, 41, 3) and picture.dtype == np.uint8
    assert picture.std() > 10, "something is to be seen"
    assert heard[-1] == 1
    np.testing.assert_array_equal(picture, shading.shaded(hierarchy, view, 41, 27))
    work = heat.work(hierarchy, view, 41, 27)
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
