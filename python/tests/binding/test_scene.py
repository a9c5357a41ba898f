# SPDX-License-Identifier: Apache-2.0
"""Scenes: arrays, meshes, views, lifetime."""

import gc
import json
import os
from pathlib import Path

import numpy as np
import pytest

import sobb
from sobb.view import default_view, read_views

QUAD = "v 0 0 0\nv 2 0 0\nv 2 1 0\nv 0 1 0\nf 1 2 3 4\n"


@pytest.fixture
def quad(tmp_path):
    path = tmp_path / "quad.obj"
    path.write_text(QUAD)
    return path


def test_file(quad):
    scene = sobb.Scene.load(quad)
    np.testing.assert_array_equal(scene.vertices[scene.faces[0]], [[0, 0, 0], [2, 0, 0], [2, 1, 0]])
    assert scene.faces.shape == (2, 3) and scene.faces.dtype == np.uint32
    assert scene.vertices.shape == (4, 3) and scene.vertices.dtype == np.float32
    info = scene.info
    assert (info.triangle_count, info.vertex_count, info.degenerate_count) == (2, 4, 0)
    assert (info.bounds_min, info.bounds_max) == ((0, 0, 0), (2, 1, 0))
    assert sum(mesh.triangle_count for mesh in scene.meshes) == 2


def test_an_origin_is_subtracted_before_rounding(tmp_path):
    far = tmp_path / "far.obj"
    far.write_text(
        "v 448251.795 5411932.678 1\nv 448252.795 5411932.678 1\n"
        "v 448251.795 5411933.678 1.25\nf 1 2 3\n"
    )
    scene = sobb.Scene.load(far, origin=(448_251.795, 5_411_932.678, 1))
    np.testing.assert_array_equal(scene.vertices, [[0, 0, 0], [1, 0, 0], [0, 1, 0.25]])
    assert (sobb.Scene.load(far).vertices[:, 1] == [5411932.5, 5411932.5, 5411933.5]).all()
    assert (sobb.Scene.load(far, origin=(0, 0, 0)).vertices == sobb.Scene.load(far).vertices).all()
    for wrong in ((1, 2), (0, 0, np.nan), "abc"):
        with pytest.raises(ValueError):
            sobb.Scene.load(far, origin=wrong)


def test_default_view(quad):
    scene = sobb.Scene.load(quad)
    assert scene.info.default_view == 1
    (view,) = scene.views
    made = default_view(scene.info.bounds_min, scene.info.bounds_max)
    np.testing.assert_allclose(view.eye, made.eye, rtol=1e-6)
    assert (view.target, view.up, view.vfov_degrees) == (made.target, made.up, made.vfov_degrees)


def test_views_of_a_file(quad, tmp_path):
    view = {"eye": [1, 2, 3], "target": [0, 0, 0], "up": [0, 0, 1], "vfov_degrees": 35}
    cameras = tmp_path / "views.json"
    cameras.write_text(json.dumps({"quad": [view, {**view, "vfov_degrees": 70}]}))
    scene = sobb.Scene.load(quad, views=cameras)
    assert [v.vfov_degrees for v in scene.views] == [35, 70]
    assert scene.views == read_views(cameras, "quad")


@pytest.mark.parametrize(
    "text",
    ["", "[]", "{}", '{"quad": 1}', '{"quad": [{"eye": [1, 2]}]}', '{"quad": [{"eye": "abc"}]}'],
)
def test_wrong_views(text, tmp_path):
    cameras = tmp_path / "views.json"
    cameras.write_text(text)
    with pytest.raises(ValueError, match="views.json"):
        read_views(cameras, "quad")


def test_notes(quad, tmp_path):
    assert sobb.Scene.load(quad).notes == []
    quad.write_text(QUAD.replace("f", "v nan 0 0\nf 1 2\nf 3\nf"))
    (tmp_path / "cameras.json").write_text('[{"id": 0, "img_name": "a"}]')
    scene = sobb.Scene.load(quad)
    assert scene.info.note_count == 3 and scene.info.default_view == 1
    short, unused, views = scene.notes
    assert short == sobb.Note("faces of fewer than three corners", 2, "line 6: a face of 2 corners")
    assert (unused.count, unused.message) == (1, "line 5: vertex (nan, 0, 0) is not finite")
    assert views.message == f"{tmp_path}/cameras.json: the document is not an object"
    assert np.isfinite(scene.vertices).all()
    sobb.build(scene)
    with pytest.raises(sobb.Error, match="the document is not an object"):
        sobb.Scene.load(quad, views=tmp_path / "cameras.json")


def test_arrays_are_not_copied_and_not_writable():
    scene = sobb.Scene.load("builtin:city:2000")
    assert np.shares_memory(scene.vertices, scene.vertices)
    assert np.shares_memory(scene.faces, scene.faces)
    with pytest.raises(ValueError):
        scene.vertices[0] = 0


def test_arrays_outlive_the_scene():
    with sobb.Scene.load("builtin:hairball:20000") as scene:
        vertices, faces = scene.vertices, scene.faces
        copies = vertices.copy(), faces.copy()
    row = vertices[5]
    del scene
    gc.collect()
    other = sobb.Scene.load("builtin:city:20000")  # would take the memory, had it been freed
    np.testing.assert_array_equal(vertices, copies[0])
    np.testing.assert_array_equal(faces, copies[1])
    del vertices, other
    gc.collect()
    np.testing.assert_array_equal(row, copies[0][5])


def test_a_name_is_no_scene():
    for made in (sobb.Scene, sobb.Hierarchy):
        with pytest.raises(TypeError, match="is made by"):
            made("builtin:city")


def test_closed():
    scene = sobb.Scene.load("builtin:city:2000")
    scene.close()
    for use in (lambda: scene.vertices, lambda: scene.meshes, lambda: sobb.build(scene)):
        with pytest.raises(ValueError, match="closed"):
            use()
    assert "closed" in repr(scene)


def test_scene_and_arrays_build_the_same():
    scene = sobb.Scene.load("builtin:pipes:5000")
    assert sobb.build(scene).bytes == sobb.build(scene.vertices, scene.faces).bytes
    with pytest.raises(TypeError):
        sobb.build(scene, scene.faces)


@pytest.mark.parametrize("name", ["hairball", "wool", "pipes", "foliage", "city", "terrain"])
def test_built_in_scenes(name):
    scene = sobb.Scene.load(f"builtin:{name}:3000")
    assert 0 < scene.info.triangle_count <= 3000
    assert len(scene.faces) == scene.info.triangle_count
    assert scene.faces.max() < len(scene.vertices)
    assert np.isfinite(scene.vertices).all()


def test_real_scene():
    folder = os.environ.get("SOBB_SCENES")
    path = Path(folder or "", "tree-fbx.glb")
    if not folder or not path.exists():
        pytest.skip("SOBB_SCENES names no folder with tree-fbx.glb")
    assert sobb.Scene.load(path).info.triangle_count == 38253
