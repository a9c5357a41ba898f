# SPDX-License-Identifier: Apache-2.0
"""The levels of a hierarchy, and the boxes drawn around their subtrees."""

import itertools

import numpy as np
import pytest

import sobb
from sobb import format
from sobb.tools.report.pictures import boxes, levels


@pytest.fixture(scope="module")
def file(mesh):
    return format.parts(sobb.build(*mesh, table="spread", width=4).bytes)


@pytest.fixture(scope="module", params=[0, 3, 6, 40])
def cut(request, file):
    return levels.cut(file, request.param)


def subtrees(cut):
    return np.split(cut.corners, cut.first[1:])


def all_boxes(cut, file):
    return [boxes.axis_aligned(cut), boxes.oriented(cut), boxes.skewed(cut, file.directions)]


def test_every_triangle_is_in_one_subtree(cut, mesh):
    vertices, faces = mesh
    ours = np.sort(cut.corners.reshape(len(faces), -1), axis=0)
    assert np.array_equal(ours, np.sort(vertices[faces].reshape(len(faces), -1), axis=0))
    assert all(len(triangles) for triangles in subtrees(cut))


def test_deeper_levels_have_more_subtrees(file):
    counts = [len(levels.cut(file, level).first) for level in (1, 3, 5, 7, 40)]
    assert counts == sorted(counts) and counts[0] <= 4
    deepest = levels.cut(file, 40)
    assert deepest.leaves == len(deepest.first)
    assert 2**5 / 2 <= counts[2] <= 2**5 * 2


def test_boxes_hold_their_triangles(cut, file):
    for kind in all_boxes(cut, file):
        for i, triangles in enumerate(subtrees(cut)):
            along = triangles.reshape(-1, 3) @ kind.normal[i].T
            assert (along >= kind.low[i] - 1e-5).all()
            assert (along <= kind.high[i] + 1e-5).all()


def test_oriented_boxes_are_orthonormal_and_no_larger_than_aligned_ones(cut):
    aligned, oriented = boxes.axis_aligned(cut), boxes.oriented(cut)
    products = oriented.normal @ oriented.normal.transpose(0, 2, 1)
    assert np.allclose(products, np.eye(3), atol=1e-5)
    assert (oriented.areas() <= aligned.areas()).all()


def test_skewed_boxes_are_those_of_the_strategy(cut, file):
    """Against the definition, written plainly: the narrowest slab, then the best of all pairs."""
    found = boxes.skewed(cut, file.directions).areas()
    directions = file.directions.astype(np.float64)
    for i, triangles in enumerate(subtrees(cut)[:20]):
        along = triangles.reshape(-1, 3) @ directions.T
        width = along.max(axis=0) - along.min(axis=0)
        first = int(width.argmin())
        least = np.inf
        for pair in itertools.combinations(range(len(directions)), 2):
            chosen = [first, *pair]
            volume = abs(np.linalg.det(directions[chosen]))
            if volume > 1e-3:
                a, b, c = width[chosen]
                least = min(least, 2 * (a * b + b * c + c * a) / volume)
        assert found[i] == pytest.approx(least, rel=1e-3)


def test_mesh_of_a_box_is_its_surface(cut, file):
    for kind in all_boxes(cut, file):
        vertices, faces = kind.mesh()
        assert len(faces) == boxes.TRIANGLES * len(cut.first)
        corners = vertices[faces].astype(np.float64)
        normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
        areas = np.linalg.norm(normals, axis=1).reshape(-1, boxes.TRIANGLES).sum(axis=1) / 2
        assert areas == pytest.approx(kind.areas(), rel=1e-3, abs=1e-4)


def test_triangles_without_area_have_boxes():
    vertices = np.zeros((9, 3), np.float32)
    vertices[3:, 0] = np.arange(6)
    file = format.parts(sobb.build(vertices, np.arange(9).reshape(3, 3), width=4).bytes)
    cut = levels.cut(file, 2)
    for kind in all_boxes(cut, file):
        assert np.isfinite(kind.areas()).all()
        assert np.isfinite(kind.mesh()[0]).all()
