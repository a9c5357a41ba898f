# SPDX-License-Identifier: Apache-2.0
"""`sobb peers`: figures from made-up rows, failures, and one real quick run."""

import json
import re
import sys

import pytest

from sobb.tools.peers.figures import CALLS, METHODS, QUALITIES, RAYS, figures, row_filter
from sobb.tools.peers.summary import lines
from sobb.tools.shared import bench
from sobb.tools.shared.scenes import Source

CITY = Source("builtin:city:1000", "city", "builtin:city:1000")
KEYS = {
    "scene": str,
    "rays": str,
    "call": str,
    "threads": int,
    "isa": str,
    "quality": str,
    "ours_mrays_s": float,
    "embree_mrays_s": float,
    "ratio": float,
}
MADE_UP = {"sobb": 6.0, "aabb": 5.0, "sobb_high": 8.0, "aabb_high": 10.0, "embree_medium": 3.0}
MADE_UP |= {"embree_high": 4.0, "embree_high_robust": 2.0}


def document(speeds=MADE_UP, without=()):
    """Returns what sobb_bench writes; packets are 10 % faster than single rays, arrays 20 %."""
    entries = [
        {
            "name": f"{rays}/{method}/{call}",
            "run_name": f"{rays}/{method}/{call}/manual_time",
            "run_type": "iteration",
            "Mrays/s": speeds[method] * (1 + i / 10),
            "bytes/triangle": 60.0 + len(method),
        }
        for rays in RAYS
        for method in METHODS
        for i, call in enumerate(CALLS)
        if f"{method}/{call}" not in without
    ]
    return {"context": {"triangles": "996"}, "benchmarks": entries}


def made_up(source=CITY, **arguments):
    return figures(source, bench.parse(document(**arguments)))


def test_the_fastest_of_embree():
    found = {(f.rays, f.call, f.quality): f for f in made_up()}
    assert len(found) == len(RAYS) * len(CALLS) * len(QUALITIES)
    high = found["diffuse7", "single", "high"]
    assert (high.sobb, high.aabb, high.embree_row) == (8, 10, "embree_high/array")
    assert high.embree == pytest.approx(4.8) and high.robust == pytest.approx(2.4)
    assert high.ratio == pytest.approx(8 / 4.8)
    medium = found["primary", "packet", "medium"]
    assert medium.embree_row == "embree_medium/array"
    assert medium.ratio == pytest.approx(6.6 / 3.6)
    assert (high.bytes, high.embree_bytes) == (60 + len("sobb_high"), 60 + len("embree_high"))
    assert (medium.bytes, medium.embree_bytes) == (60 + len("sobb"), 60 + len("embree_medium"))


def test_medium_builds_may_be_the_fastest_peers():
    found = made_up(speeds=MADE_UP | {"embree_medium": 5.0})
    assert {f.embree_row for f in found} == {"embree_medium/array"}


def test_without_embrees_array_call():
    arrays = [f"{method}/array" for method in METHODS if "embree" in method]
    found = made_up(without=arrays)
    assert {f.embree_row for f in found if f.quality == "high"} == {"embree_high/packet"}


def test_without_embree():
    with pytest.raises(OSError, match="not installed"):
        made_up(
            without=[
                f"{method}/{call}" for method in METHODS if "embree" in method for call in CALLS
            ]
        )


def test_entries():
    for figure in made_up():
        entry = figure.entry(2, "avx2")
        assert {key: type(entry[key]) for key in KEYS} == KEYS
        assert entry["ratio"] == entry["ours_mrays_s"] / entry["embree_mrays_s"]
        assert entry["scene"] == "builtin:city:1000" and entry["threads"] == 2


def test_filter():
    assert re.search(row_filter(), "diffuse1/sobb_high/array/manual_time")
    for other in ("build/sobb", "diffuse1/sobb/replay", "random/embree_medium_robust/array"):
        assert not re.search(row_filter(), other + "/manual_time")


def test_summary():
    hair = Source("/scenes/hair.glb", "hair", "hair")
    turned = Source("builtin:city:1000@30", "city@30", "builtin:city:1000@30")
    found = [
        *made_up(),
        *made_up(hair, speeds=MADE_UP | {"sobb_high": 32.0}),
        *made_up(turned, speeds=MADE_UP | {"sobb": 5.4}),
    ]
    by_group = {(line.rays, line.call): line for line in lines(found)}
    assert len(by_group) == len(RAYS) * len(CALLS)
    line = by_group["shadow", "array"]
    high, medium = line.ratios["high"], line.ratios["medium"]
    assert high.least.value == pytest.approx(2) and high.least.scene == "city"
    assert high.mean == pytest.approx((2 * 8 * 2) ** (1 / 3))
    assert high.fibres.scene == "hair" and high.fibres.value == pytest.approx(8)
    assert medium.least.scene == "city@30" and medium.least.value == pytest.approx(1.8)
    assert line.over_aabb.value == pytest.approx(0.8) and line.over_aabb.scene == "city"
    assert line.turned.value == pytest.approx(0.9) and line.turned.scene == "city@30"
    assert by_group["random", "array"].turned is None
    assert lines(made_up())[0].turned is None and lines(made_up())[0].ratios["high"].fibres is None


PROGRAM = """#!{python}
import json, sys
options = dict(argument.lstrip("-").split("=", 1) for argument in sys.argv[1:])
if "foliage" in options["scene"]:
    sys.exit("sobb_bench: primary/sobb/array and primary/aabb/single differ at ray 7")
json.dump(options, open({seen!r}, "w"))
json.dump(json.loads({document!r}), open(options["benchmark_out"], "w"))
"""


@pytest.fixture
def program(tmp_path, monkeypatch):
    """Makes a sobb_bench that has its figures ready and fails for foliage.

    Returns the file into which it writes its options.
    """
    path = tmp_path / "bin" / "sobb_bench"
    path.parent.mkdir()
    seen = tmp_path / "seen.json"
    made = {"python": sys.executable, "seen": str(seen), "document": json.dumps(document())}
    path.write_text(PROGRAM.format(**made))
    path.chmod(0o755)
    monkeypatch.setenv("SOBB_LIBRARY_PATH", str(tmp_path / "lib"))
    return seen


def test_options(cli, program, tmp_path):
    assert cli("peers", "--scenes", "builtin:city:1000").returncode == 0
    options = json.loads(program.read_text())
    assert (options["isa"], options["embree-isa"], options["threads"]) == ("avx2", "avx2", "1")
    assert (options["size"], options["benchmark_repetitions"]) == ("1024", "7")
    assert "cameras" not in options
    changed = "--isa sse4 --threads 2 --size 32 --repetitions 3 --cameras c.json".split()
    assert cli("peers", "--scenes", "builtin:city:1000", *changed).returncode == 0
    options = json.loads(program.read_text())
    assert (options["isa"], options["embree-isa"], options["threads"]) == ("sse4", "sse4.2", "2")
    assert (options["size"], options["benchmark_repetitions"]) == ("32", "3")
    assert options["cameras"] == "c.json"


def test_a_scene_that_fails(cli, program, tmp_path):
    out = tmp_path / "peers.json"
    names = "builtin:city:1000,builtin:foliage:1000,builtin:wool:1000"
    done = cli("peers", "--scenes", names, "--json", out)
    assert done.returncode == 1
    first, last = done.stderr.splitlines()
    assert "builtin:foliage:1000" in first and "differ at ray 7" in first
    assert last == "sobb: 1 of 3 scenes failed: builtin:foliage:1000"
    scenes = {entry["scene"] for entry in json.loads(out.read_text())}
    assert scenes == {"builtin:city:1000", "builtin:wool:1000"}
    assert "2 scenes" in done.stdout and "\x1b" not in done.stdout


def test_what_is_missing_is_told_before_measuring(cli, program, tmp_path):
    done = cli("peers", "--scenes", "builtin:city:1000,no such")
    assert done.returncode == 1 and "no such" in done.stderr and done.stdout == ""
    out = tmp_path / "no folder" / "peers.json"
    done = cli("peers", "--scenes", "builtin:city:1000", "--json", out)
    assert done.returncode == 1 and "no folder" in done.stderr
    for wrong in ("--isa avx512", "--isa sse4.2", "--size 0", "--repetitions 0", "--threads -1"):
        done = cli("peers", "--scenes", "builtin:city:1000", *wrong.split())
        assert done.returncode == 2 and done.stdout == "", wrong
    assert not program.exists()


@pytest.mark.parametrize("isa", ["sse4", "avx2"])
def test_a_real_quick_run(cli, tmp_path, isa):
    out = tmp_path / "peers.json"
    scenes = "builtin:city:2000", "builtin:city:2000@30"
    effort = "--size", "32", "--repetitions", "1"
    done = cli("peers", "--scenes", *scenes, "--isa", isa, "--json", out, *effort)
    assert done.returncode == 0 and done.stderr == "", done.stderr
    entries = json.loads(out.read_text())
    assert {
        (e["scene"], e["rays"], e["call"], e["quality"], e["isa"], e["threads"]) for e in entries
    } == {
        (scene, rays, call, quality, isa, 1)
        for scene in scenes
        for rays in RAYS
        for call in CALLS
        for quality in QUALITIES
    }
    assert all(e["ours_mrays_s"] > 0 and e["embree_mrays_s"] > 0 for e in entries)
    assert all(20 < e["bytes_per_triangle"] < 200 for e in entries)
    assert done.stdout.count("diffuse7") == 3 * len(CALLS)


def test_an_unknown_scene_fails(cli):
    done = cli("peers", "--scenes", "builtin:teapot")
    assert done.returncode == 1 and "teapot" in done.stderr and "Traceback" not in done.stderr
