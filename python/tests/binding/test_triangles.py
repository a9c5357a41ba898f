# SPDX-License-Identifier: Apache-2.0
"""Triangles of every kind that build() takes, what it says to others, and the origin."""

from pathlib import Path

import numpy as np
import pytest

import sobb

VERTICES = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [1, 1, 0]], np.float32)
FACES = np.array([[0, 1, 2], [1, 3, 2]], np.uint32)

# A point of UTM zone 33: float32 has steps of 0.03 m there in x, 0.5 m in y.
UTM = (448_251.795, 5_411_932.5, 207.25)


class Mesh:
    """As trimesh and libigl have it."""

    def __init__(self, vertices=VERTICES, faces=FACES):
        self.vertices = np.asarray(vertices, np.float64)
        self.faces = np.asarray(faces, np.int64)


class Open3dMesh:
    def __init__(self):
        self.vertices, self.triangles = VERTICES.tolist(), FACES.tolist()


class Scene:
    """As trimesh has it: no arrays, but `triangles` of coordinates, and to_mesh()."""

    triangles = VERTICES[FACES]

    def to_mesh(self):
        return Mesh()


class OldScene:
    """As older versions of trimesh had it."""

    geometry = {"square": Mesh()}

    def dump(self, concatenate=False):
        return Mesh() if concatenate else [Mesh()]


@pytest.mark.parametrize("kind", [Mesh, Open3dMesh, Scene, OldScene])
def test_meshes_of_others(kind):
    assert sobb.build(kind()).bytes == sobb.build(VERTICES, FACES).bytes


class Points:
    vertices = VERTICES


class PolyData:
    """As PyVista has it: each face's count before its corners."""

    points, faces = VERTICES, np.array([3, 0, 1, 2, 3, 1, 3, 2])


@pytest.mark.parametrize(
    ("triangles", "message"),
    [
        (Points(), "Points has no `vertices` and `faces`: pass its points"),
        (PolyData(), "PolyData has no `vertices` and `faces`: pass its points"),
        (VERTICES, "vertices need faces"),
        ((VERTICES, FACES), "vertices need faces"),
        ("a.obj", "'a.obj' is a path or a name: load it with sobb.Scene.load"),
        (Path("a.obj"), "is a path or a name: load it with sobb.Scene.load"),
        (None, "NoneType has no `vertices`"),
    ],
)
def test_what_is_no_mesh_is_told_what_to_do(triangles, message):
    with pytest.raises(TypeError) as caught:
        sobb.build(triangles)
    assert message in str(caught.value)


def test_faces_beside_a_mesh_are_refused():
    for triangles in (Mesh(), sobb.Scene.load("builtin:city:1000")):
        with pytest.raises(TypeError, match="has its own faces"):
            sobb.build(triangles, FACES)


def test_an_origin_is_subtracted_before_rounding():
    far = VERTICES + np.array(UTM)
    right = sobb.build(VERTICES, FACES).bytes
    assert sobb.build(far, FACES, origin=UTM).bytes == right
    assert sobb.build(Mesh(far), origin=np.array(UTM)).bytes == right
    assert sobb.build(far.tolist(), FACES, origin=list(UTM)).bytes == right
    # Without it, float32 has no place for a step of 0.1 m to the north.
    moved = far + (0, 0.1, 0)
    assert sobb.build(moved, FACES).bytes == sobb.build(far, FACES).bytes
    assert sobb.build(moved, FACES, origin=UTM).bytes != right


def test_the_oracle_takes_the_origin_too(rays):
    far = VERTICES + np.array(UTM)
    hits = sobb.build(far, FACES, origin=UTM).intersect(rays)
    assert (hits["primitive"] < sobb.INVALID).any()
    np.testing.assert_array_equal(sobb.brute_force(far, rays, FACES, origin=UTM), hits)


@pytest.mark.parametrize("origin", [1, (1, 2), (1, 2, 3, 4), (1, 2, np.nan), (0, 0, np.inf), "abc"])
def test_an_origin_is_three_finite_numbers(origin):
    with pytest.raises(ValueError):
        sobb.build(VERTICES, FACES, origin=origin)


def test_a_loaded_scene_has_its_origin_already():
    with pytest.raises(TypeError, match=r"Scene\.load"):
        sobb.build(sobb.Scene.load("builtin:city:1000"), origin=(1, 2, 3))
