# SPDX-License-Identifier: Apache-2.0
"""Wrong input of every kind raises an exception that names the cause; nothing crashes."""

import pickle

import numpy as np
import pytest

import sobb
from sobb import Status

VERTICES = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0]], np.float32)
FACES = np.array([[0, 1, 2]], np.uint32)


def failed(status, call, *arguments, **options):
    """Asserts that a call raises sobb.Error with a status, and returns the message."""
    with pytest.raises(sobb.Error) as caught:
        call(*arguments, **options)
    assert caught.value.status == status
    assert str(caught.value)
    return str(caught.value)


def test_triangles():
    failed(Status.EMPTY, sobb.build, VERTICES, FACES[:0])
    assert "1" in failed(Status.INDEX, sobb.build, VERTICES, [[0, 1, 2], [0, 1, 3]])
    failed(Status.NOT_FINITE, sobb.build, [[0, 0, np.nan], [1, 0, 0], [0, 1, 0]], FACES)
    failed(Status.NOT_FINITE, sobb.build, VERTICES.astype(float) * 1e300, FACES)
    failed(Status.TOO_LARGE, sobb.build, VERTICES * np.float32(2.0**61), FACES)
    rays = np.zeros(1, sobb.ray_dtype)
    rays["direction"] = 1
    failed(Status.INDEX, sobb.brute_force, VERTICES, rays, [[0, 1, 3]])


@pytest.mark.parametrize(
    ("vertices", "faces"),
    [
        (VERTICES[:, :2], FACES),
        (VERTICES.ravel(), FACES),
        (VERTICES, FACES.ravel()),
        (VERTICES, [[0, 1]]),
        (VERTICES, [[0, 1, -1]]),
        (VERTICES, [[0, 1, 1 << 32]]),
        (VERTICES, [[0, 1, 2.5]]),
        (VERTICES, None),
        ("builtin:hairball", None),
    ],
)
def test_arrays_of_a_wrong_shape_or_type(vertices, faces):
    with pytest.raises((ValueError, TypeError)):
        sobb.build(vertices, faces)


@pytest.mark.parametrize(
    "options",
    [
        {"volume": "obb"},
        {"quality": "best"},
        {"strategy": "k4"},
        {"table": "round"},
        {"isa": "avx512"},
        {"threads": -1},
        {"threads": 1 << 32},
        {"k": -64},
        {"memory_limit": -1},
        {"width": "8"},
    ],
)
def test_options_that_python_refuses(options):
    with pytest.raises((ValueError, TypeError)):
        sobb.build(VERTICES, FACES, **options)


@pytest.mark.parametrize("options", [{"k": 33}, {"width": 5}, {"k": 256}, {"width": 16}])
def test_options_that_the_library_refuses(options):
    failed(Status.INVALID_ARGUMENT, sobb.build, VERTICES, FACES, **options)


def test_memory_limit(mesh):
    failed(Status.MEMORY_LIMIT, sobb.build, *mesh, memory_limit=1000)
    content = sobb.build(*mesh).bytes
    failed(Status.MEMORY_LIMIT, sobb.Hierarchy.from_bytes, content, memory_limit=1000)


def test_rays_of_another_type(hierarchy):
    for rays in (np.zeros((4, 8), np.float32), np.zeros(4, sobb.hit_dtype), [1, 2]):
        with pytest.raises(TypeError, match="ray_dtype"):
            hierarchy.intersect(rays)
    with pytest.raises(ValueError):
        hierarchy.intersect(np.zeros(4, sobb.ray_dtype), isa="mmx")


def test_files(tmp_path, hierarchy):
    missing = tmp_path / "missing.sobb"
    assert "missing.sobb" in failed(Status.FILE_OPEN, sobb.Hierarchy.open, missing)
    failed(Status.FILE_OPEN, sobb.Hierarchy.open, tmp_path)
    text = tmp_path / "text.sobb"
    text.write_text("not a hierarchy " * 100)
    assert "text.sobb" in failed(Status.FORMAT_MAGIC, sobb.Hierarchy.open, text)
    failed(Status.FILE_WRITE, hierarchy.save, tmp_path / "no folder" / "a.sobb")
    with pytest.raises(ValueError, match="null byte"):
        sobb.Hierarchy.open("a\0b")


def test_damaged_bytes(hierarchy):
    content = bytearray(hierarchy.bytes)
    failed(Status.FORMAT_SIZE, sobb.Hierarchy.from_bytes, content[:-1])
    with pytest.raises(sobb.Error):
        sobb.Hierarchy.from_bytes(b"")
    content[len(content) // 2] ^= 1
    failed(Status.FORMAT_CHECKSUM, sobb.Hierarchy.from_bytes, content)


def test_a_failed_save_leaves_the_old_file(hierarchy, tmp_path):
    folder = tmp_path / "taken.sobb"
    folder.mkdir()
    failed(Status.FILE_WRITE, hierarchy.save, folder)
    assert [entry.name for entry in tmp_path.iterdir()] == ["taken.sobb"]


def test_scenes(tmp_path):
    failed(Status.FILE_OPEN, sobb.Scene.load, tmp_path / "missing.obj")
    failed(Status.SCENE_FORMAT, sobb.Scene.load, "builtin:teapot")
    unknown = tmp_path / "scene.xyz"
    unknown.write_text("1 2 3")
    failed(Status.SCENE_FORMAT, sobb.Scene.load, unknown)
    broken = tmp_path / "broken.obj"
    broken.write_text("v 0 0 0\nf 1 2 3\n")
    failed(Status.INDEX, sobb.Scene.load, broken)
    with pytest.raises(ValueError, match="memory_limit"):
        sobb.Scene.load("builtin:city:1000", memory_limit=-1)


def test_an_error_passes_between_processes():
    error = pickle.loads(pickle.dumps(sobb.Error(4, "vertex 3")))
    assert (error.status, str(error)) == (Status.NOT_FINITE, "vertex 3")
    assert sobb.Error(12345, "of a later library").status == 12345


def test_unknown_library_folder(tmp_path, monkeypatch):
    from sobb import library

    monkeypatch.setenv("SOBB_LIBRARY_PATH", str(tmp_path))
    library.core.cache_clear()
    try:
        with pytest.raises(OSError, match="SOBB_LIBRARY_PATH"):
            sobb.version()
    finally:
        library.core.cache_clear()
