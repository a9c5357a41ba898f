# SPDX-License-Identifier: Apache-2.0
"""Scenes by name: files, built-in scenes, refined and turned ones, and the default ones."""

import pytest

from sobb.tools.shared import scenes


def test_scenes_by_name(folder, tmp_path):
    loose = tmp_path / "model@7.ply"
    loose.touch()
    names = ["crown", "crown@30", "other@-12.5", f"{folder}/crown.glb@30", str(loose)]
    names += ["crown^16", "other^4@30", "builtin:city:5000^4@30"]
    found = scenes.resolve([*names, "builtin:city:5000@30"])
    assert [(s.argument, s.name) for s in found] == [
        (f"{folder}/crown.glb", "crown"),
        (f"{folder}/crown.glb@30", "crown@30"),
        (f"{folder}/other.obj@-12.5", "other@-12.5"),
        (f"{folder}/crown.glb@30", "crown@30"),
        (str(loose), "model@7"),
        (f"{folder}/crown.glb^16", "crown^16"),
        (f"{folder}/other.obj^4@30", "other^4@30"),
        ("builtin:city:5000^4@30", "city^4@30"),
        ("builtin:city:5000@30", "city@30"),
    ]
    assert [s.asked for s in found] == [*names, "builtin:city:5000@30"]


def test_scenes_with_commas(folder):
    assert scenes.resolve(["crown,other", "a b"]) == scenes.resolve(["crown", "other", "a b"])
    (folder / "b,c.ply").touch()
    assert [s.name for s in scenes.resolve([str(folder / "b,c.ply")])] == ["b,c"]
    with pytest.raises(OSError, match="no such"):
        scenes.resolve(["crown,no such"])
    with pytest.raises(OSError, match="no such"):
        scenes.resolve([""])


def test_default_scenes(folder, monkeypatch):
    turned = "city", "foliage", "crown", "sponza-dabrovic"
    names = [source.name for source in scenes.default(turned)]
    assert names == [
        *("hairball", "wool", "pipes", "city", "foliage"),
        *("a b", "crown"),
        *("city@30", "foliage@30", "crown@30", "pipes@30"),
    ]
    monkeypatch.delenv("SOBB_SCENES")
    found = scenes.default(turned)
    assert len(found) == 9 and all(source.argument.startswith("builtin:") for source in found)
    assert len(scenes.quick()) == 6
    assert scenes.split_turn("a@b@-3.5") == ("a@b", "@-3.5") and scenes.split_turn("a") == ("a", "")
