# SPDX-License-Identifier: Apache-2.0
"""Building, tracing, saving, opening and pickling a hierarchy."""

import copy
import gc
import multiprocessing
import pickle
import threading

import numpy as np
import pytest

import sobb
from sobb import format
from sobb.surface import Surface


@pytest.mark.parametrize("width", [4, 8])
@pytest.mark.parametrize("quality", ["low", "medium", "high"])
def test_equals_brute_force(mesh, rays, width, quality):
    right = sobb.brute_force(mesh[0], rays, mesh[1])
    assert (right["primitive"] < sobb.INVALID).sum() > 100
    for volume in ("aabb", "sobb"):
        found = sobb.build(*mesh, volume=volume, width=width, quality=quality).intersect(rays)
        np.testing.assert_array_equal(found, right)


def test_a_fitted_table_brings_a_turned_scene_back():
    with sobb.Scene.load("builtin:city:3000@30") as turned:
        spread, fitted = sobb.build(turned, table="spread"), sobb.build(turned, table="fitted")
        assert bytes(sobb.build(turned).bytes) == bytes(fitted.bytes)  # the default
    assert (spread.info.table, fitted.info.table) == ("spread", "fitted")
    assert fitted.info.leaf_area < 0.7 * spread.info.leaf_area
    with pytest.raises(sobb.Error, match="fitted table is for SOBBs"):
        sobb.build([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]], volume="aabb", table="fitted")


@pytest.mark.parametrize("k", [32, 48, 64])
@pytest.mark.parametrize("strategy", ["k", "k2", "k3"])
def test_options_reach_the_build(mesh, rays, k, strategy):
    hierarchy = sobb.build(*mesh, k=k, strategy=strategy)
    assert (hierarchy.info.k, hierarchy.info.strategy) == (k, strategy)
    np.testing.assert_array_equal(
        hierarchy.intersect(rays), sobb.brute_force(mesh[0], rays, mesh[1])
    )


def test_every_mode_gives_the_same_bits(hierarchy, rays):
    right = hierarchy.intersect(rays, threads=1)
    hit = right["primitive"] < sobb.INVALID
    np.testing.assert_array_equal(hierarchy.intersect(rays, coherent=True), right)
    np.testing.assert_array_equal(hierarchy.intersect(rays, threads=3), right)
    np.testing.assert_array_equal(hierarchy.intersect(rays, isa="sse4"), right)
    counted, counts = hierarchy.intersect(rays, counts=True)
    np.testing.assert_array_equal(counted, right)
    assert (counts["triangles"][hit] > 0).all() and (counts["nodes"] > 0).any()
    np.testing.assert_array_equal(hierarchy.occluded(rays), hit)
    np.testing.assert_array_equal(hierarchy.occluded(rays, coherent=True), hit)


def test_shapes(hierarchy, rays):
    right = hierarchy.intersect(rays)
    np.testing.assert_array_equal(hierarchy.intersect(rays.reshape(40, 50)), right.reshape(40, 50))
    np.testing.assert_array_equal(hierarchy.intersect(rays[::3]), right[::3])
    assert hierarchy.intersect(rays[7]).shape == ()
    assert hierarchy.intersect(rays[7])["t"] == right[7]["t"]
    assert hierarchy.intersect(rays[:0]).shape == (0,)
    assert hierarchy.occluded(rays[:0]).shape == (0,)


def test_invalid_rays_are_marked_and_the_others_traced(hierarchy, rays):
    wrong = rays.copy()
    wrong["direction"][0] = 0
    wrong["origin"][1, 2] = np.nan
    wrong["tmin"][2] = -1
    hits = hierarchy.intersect(wrong)
    assert (hits["primitive"][:3] == sobb.INVALID).all() and np.isinf(hits["t"][:3]).all()
    np.testing.assert_array_equal(hits[3:], hierarchy.intersect(rays)[3:])
    assert (hierarchy.occluded(wrong)[:3] == sobb.OCCLUDED_INVALID).all()


def test_save_and_open(hierarchy, rays, tmp_path):
    path = tmp_path / "mesh ü.sobb"
    hierarchy.save(path)
    assert path.read_bytes() == hierarchy.bytes
    right = hierarchy.intersect(rays)
    for opened in (
        sobb.Hierarchy.open(path),
        sobb.Hierarchy.open(str(path), map=True),
        sobb.Hierarchy.from_bytes(path.read_bytes()),
        sobb.Hierarchy.from_bytes(hierarchy.bytes),
    ):
        assert opened.bytes == hierarchy.bytes
        np.testing.assert_array_equal(opened.intersect(rays), right)
    assert [entry.name for entry in tmp_path.iterdir()] == [path.name]


def test_info(hierarchy, mesh):
    info = hierarchy.info
    assert info.triangles == 500 and info.volume in ("aabb", "sobb") and info.width == 8
    assert info.bytes == len(hierarchy.bytes)
    np.testing.assert_array_equal(info.bounds_min, mesh[0].min(axis=0))
    np.testing.assert_array_equal(info.bounds_max, mesh[0].max(axis=0))


def test_parts_of_the_file(hierarchy):
    info, file = hierarchy.info, format.parts(hierarchy.bytes)
    assert len(file.nodes) == info.nodes and len(file.blocks) == info.blocks
    assert file.record["source_hash"] == info.source_hash
    assert file.header["depth"] == info.depth
    children = file.nodes["meta"][:, 0] >> 8 & 15
    leaves = file.nodes["meta"] >> 15 == 1
    assert leaves.sum() == info.leaves
    assert children.sum() == info.leaves + info.nodes - 1
    np.testing.assert_allclose(np.linalg.norm(file.directions, axis=1), 1, rtol=1e-6)


def test_surface_has_the_triangles(hierarchy, mesh, rays):
    surface = Surface(hierarchy)
    np.testing.assert_array_equal(surface.corners(np.arange(500)), mesh[0][mesh[1]])
    hits = hierarchy.intersect(rays)
    hit = hits["primitive"] < sobb.INVALID
    points = surface.points(rays, hits)
    along = rays["origin"][hit] + hits["t"][hit, None] * rays["direction"][hit]
    np.testing.assert_allclose(points.position, along, atol=1e-5)
    assert (np.einsum("ij,ij->i", points.normal, rays["direction"][hit]) <= 0).all()


def test_the_same_input_gives_the_same_bytes(mesh):
    first = sobb.build(*mesh, threads=1)
    assert first.bytes == sobb.build(*mesh, threads=3).bytes
    assert first.bytes == sobb.build(*mesh, isa="sse4").bytes


def test_arrays_are_not_copied(hierarchy, rays):
    first, second = (np.frombuffer(hierarchy.bytes, np.uint8) for _ in range(2))
    assert np.shares_memory(first, second)
    assert not first.flags.writeable
    blocks = format.parts(hierarchy.bytes).blocks
    assert np.shares_memory(blocks, first)


def test_strided_vertices_and_other_integers(mesh, rays):
    vertices, faces = mesh
    right = sobb.build(vertices, faces)
    wide = np.zeros((len(vertices), 8), np.float32)
    wide[:, 2:5] = vertices
    assert sobb.build(wide[:, 2:5], faces).bytes == right.bytes
    assert sobb.build(np.asfortranarray(vertices), faces).bytes == right.bytes
    assert sobb.build(vertices.astype(np.float64), faces.astype(np.int64)).bytes == right.bytes
    assert sobb.build(vertices[::-1][::-1].tolist(), faces.tolist()).bytes == right.bytes
    backwards = sobb.build(vertices[::-1], len(vertices) - 1 - faces)
    np.testing.assert_array_equal(backwards.intersect(rays), right.intersect(rays))


def test_bytes_outlive_the_hierarchy(mesh, tmp_path):
    hierarchy = sobb.build(*mesh)
    content, copied = hierarchy.bytes, bytes(hierarchy.bytes)
    hierarchy.close()
    del hierarchy
    gc.collect()
    assert content == copied
    assert np.frombuffer(content, np.uint8)[-1] == copied[-1]


def test_closed(mesh, rays):
    with sobb.build(*mesh) as hierarchy:
        hierarchy.intersect(rays)
    for use in (
        lambda: hierarchy.intersect(rays),
        lambda: hierarchy.bytes,
        lambda: hierarchy.info,
        lambda: hierarchy.save("unused.sobb"),
    ):
        with pytest.raises(ValueError, match="closed"):
            use()
    hierarchy.close()
    assert "closed" in repr(hierarchy)


@pytest.mark.parametrize("protocol", range(pickle.HIGHEST_PROTOCOL + 1))
def test_pickled_as_its_bytes(hierarchy, rays, protocol):
    other = pickle.loads(pickle.dumps(hierarchy, protocol))
    assert other.bytes == hierarchy.bytes
    np.testing.assert_array_equal(other.intersect(rays), hierarchy.intersect(rays))


def test_pickled_out_of_band(hierarchy):
    buffers = []
    rest = pickle.dumps(hierarchy, 5, buffer_callback=buffers.append)
    assert len(rest) < 200
    (buffer,) = buffers
    assert np.shares_memory(np.asarray(buffer), np.asarray(hierarchy.bytes))
    assert pickle.loads(rest, buffers=buffers).bytes == hierarchy.bytes


def test_a_damaged_pickle_is_refused(mesh):
    pickled = bytearray(pickle.dumps(sobb.build(*mesh)))
    pickled[len(pickled) // 2] ^= 1
    with pytest.raises(sobb.Error):
        pickle.loads(pickled)


def test_goes_to_other_processes_and_back(hierarchy, rays):
    with multiprocessing.get_context("spawn").Pool(1) as pool:
        back, found = pool.apply(there_and_back, (hierarchy, rays))
    assert back.bytes == hierarchy.bytes
    np.testing.assert_array_equal(found, hierarchy.intersect(rays))


def there_and_back(hierarchy, rays):
    return hierarchy, hierarchy.intersect(rays)


def test_copies_share_memory_and_close_alone(mesh, rays):
    hierarchy = sobb.build(*mesh)
    for other in (copy.copy(hierarchy), copy.deepcopy([hierarchy])[0]):
        assert np.shares_memory(np.asarray(other.bytes), np.asarray(hierarchy.bytes))
        other.close()
        hierarchy.intersect(rays)


def test_results_go_where_they_are_wanted(hierarchy, rays):
    hits, occluded = np.empty(len(rays), sobb.hit_dtype), np.empty(len(rays), np.uint8)
    assert hierarchy.intersect(rays, out=hits) is hits
    assert hierarchy.intersect(rays, counts=True, out=hits)[0] is hits
    np.testing.assert_array_equal(hits, hierarchy.intersect(rays))
    assert hierarchy.occluded(rays, out=occluded) is occluded
    np.testing.assert_array_equal(occluded, hierarchy.occluded(rays))


def test_wrong_places_for_results(hierarchy, rays):
    locked = np.empty(len(rays), sobb.hit_dtype)
    locked.flags.writeable = False
    memory = np.zeros(len(rays) * 32, np.uint8)
    over = memory.view(sobb.ray_dtype)
    for given, out in (
        (rays, np.empty(len(rays) + 1, sobb.hit_dtype)),
        (rays, np.empty(len(rays), sobb.ray_dtype)),
        (rays, np.empty(2 * len(rays), sobb.hit_dtype)[::2]),
        (rays, locked),
        (over, memory[: len(rays) * 24].view(sobb.hit_dtype)),
    ):
        with pytest.raises(ValueError, match="^out "):
            hierarchy.intersect(given, out=out)


def test_progress_rises_to_the_end(mesh):
    heard = []
    sobb.build(*mesh, progress=heard.append)
    assert heard == sorted(heard)
    assert all(0 <= fraction <= 1 for fraction in heard)


def test_what_progress_raises_comes_out(mesh):
    def refuse(_):
        raise LookupError("no more")

    with pytest.raises(LookupError, match="no more"):
        sobb.build(*mesh, progress=refuse)


def test_opening_and_loading_may_be_given_up(hierarchy, tmp_path):
    hierarchy.save(tmp_path / "scene.sobb")

    def refuse(_):
        raise LookupError("took too long")

    for call in (
        lambda progress: sobb.Hierarchy.open(tmp_path / "scene.sobb", progress=progress),
        lambda progress: sobb.Scene.load("builtin:city:100000", progress=progress),
    ):
        heard = []
        call(heard.append).close()
        assert heard == sorted(heard)
        assert heard[-1] <= 1
        with pytest.raises(LookupError, match="too long"):
            call(refuse)


def test_many_threads_trace_one(hierarchy, rays):
    right, results = hierarchy.intersect(rays), [None] * 4

    def trace(i):
        results[i] = hierarchy.intersect(rays, threads=1)

    threads = [threading.Thread(target=trace, args=(i,)) for i in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    for result in results:
        np.testing.assert_array_equal(result, right)
