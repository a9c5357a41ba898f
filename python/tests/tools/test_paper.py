# SPDX-License-Identifier: Apache-2.0
"""The paper's table: figures from made-up reports, files, failures, and one real quick run."""

import csv
import io
import json
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest
from PIL import Image

from sobb.tools.paper import chart, csv_table, latex, markdown
from sobb.tools.paper.table import (
    COLUMNS,
    LAYOUTS,
    METHODS,
    Measured,
    figures,
    groups,
    largest_variation,
    number,
    row_name,
    short_count,
)
from sobb.tools.shared import bench

FILES = {"paper.md", "paper.csv", "paper.tex", "paper.png", "paper.svg", "raw"}
CONTEXT = {
    "date": "2025-06-07T08:09:10+00:00",
    "scene": "builtin:city:2800000",
    "triangles": "2799994",
    "view": "0",
    "size": "64",
    "threads": "2",
    "isa": "avx2",
    "sobb": "0.1.0",
    "processor": "A & B",
    "primary_rays": "4096",
    "secondary_rays": "12345",
    "brute_force_rays": "200",
}


def document(speed=lambda method: 1.0, without=()):
    """Returns what the program writes.

    A method's rays are `speed` times as fast as AABBs', and its areas as many times smaller. The
    build takes 100 ms; the overheads are 10 ms, 20 ms and so on, by method.
    """
    entries = []

    def add(name, median, **counters):
        shared = {"run_name": f"{name}/manual_time", "name": name, "time_unit": "ms"}
        for repetition in (0.9 * median, 1.2 * median, median):
            entry = {"run_type": "iteration", "real_time": repetition}
            entries.append(shared | entry | counters)
        for aggregate, value in (("mean", 7), ("median", median), ("stddev", 7), ("cv", 0.02)):
            entry = {"run_type": "aggregate", "aggregate_name": aggregate, "real_time": value}
            entries.append(shared | entry | (counters if aggregate != "cv" else {}))

    for layout in LAYOUTS:
        add(f"build/{layout}", 100.0, topology_ms=70.0, layout_ms=20.0, depth=31.0)
        for i, method in enumerate(m for m in METHODS if m not in without):
            s = speed(method)
            areas = {"area_inner": 30 / s, "area_leaf": 3 / s}
            add(row_name("overhead", method, layout), 10.0 * (i + 1), node_bytes=640.0, **areas)
            for kind, mrays in (("primary", 12.0), ("secondary", 4.0)):
                work = {"nodes/ray": 9.5, "volumes/ray": 18.0, "triangles/ray": 6.25}
                add(row_name(kind, method, layout), 5.0, **work, **{"Mrays/s": mrays * s})
    return {"context": CONTEXT, "benchmarks": entries}


def measured(name="city", **arguments):
    return Measured(name, bench.parse(document(**arguments)))


def cells(group, key):
    """Returns the cell of each method in a column."""
    column = [c.key for c in COLUMNS].index(key)
    return {method: row[column] for method, row in group.rows.items()}


def test_names_of_rows():
    assert row_name("overhead", "obb", "wide") == "overhead/obb/wide"
    assert row_name("primary", "sobb64i", "binary") == "primary/sobb64i/binary/k2"
    assert list(METHODS.values()) == (
        "AABB,14-DOP,OBB,SOBB 32d,SOBB 32i,SOBB 48d,SOBB 48i,SOBB 64d,SOBB 64i,SOBB 128,SOBB 256"
    ).split(",")


def test_medians_not_means():
    report = bench.parse(document())
    assert report.medians["build/binary"]["real_time"] == 100
    assert report.variations["build/binary"]["real_time"] == 0.02
    single = document()
    single["benchmarks"] = [e for e in single["benchmarks"] if e["run_type"] == "iteration"][2:3]
    report = bench.parse(single)  # one repetition is its own median
    assert report.medians["build/binary"]["real_time"] == 100 and report.variations == {}


def test_a_failed_row_is_told():
    failed = document()
    failed["benchmarks"][0] |= {"error_occurred": True, "error_message": "out of memory"}
    with pytest.raises(OSError, match="build/binary: out of memory"):
        bench.parse(failed)


def test_build_is_that_of_aabbs_and_the_overhead():
    report = bench.parse(document())
    aabb, dop = (figures(report, method, "wide") for method in ("aabb", "14-dop"))
    assert aabb["build_ms"].value == 100 and "overhead_ms" not in aabb
    assert dop["overhead_ms"].value == 20 and dop["build_ms"].value == 120
    expected = ((100 * 0.02) ** 2 + (20 * 0.02) ** 2) ** 0.5 / 120
    assert dop["build_ms"].variation == pytest.approx(expected)


def test_ratios():
    (group,) = groups([measured(speed=lambda m: 1.25 if m == "sobb48i" else 1.0)], "binary")
    assert group.title == "city [2.8M]"
    assert str(cells(group, "build_ms")["obb"]) == "130 (1.30)"
    assert str(cells(group, "overhead_ms")["aabb"]) == "–"
    assert str(cells(group, "overhead_ms")["14-dop"]) == "20.0 (0.67)"  # to the OBB's
    assert str(cells(group, "area_inner")["sobb48i"]) == "24.0 (0.80)"
    assert str(cells(group, "secondary_mrays")["sobb48i"]) == "5.00 (1.25)"


def test_the_best_of_a_column():
    speeds = {"obb": 2.0, "sobb64d": 1.9999, "sobb64i": 1.7}
    (group,) = groups([measured(speed=lambda m: speeds.get(m, 1.0))], "wide")

    def best(key):
        return {method for method, cell in cells(group, key).items() if cell.best}

    assert best("build_ms") == {"aabb"} and best("overhead_ms") == {"14-dop"}
    assert best("area_leaf") == best("primary_mrays") == {"obb", "sobb64d"}  # they print alike


def test_missing_methods():
    (group,) = groups([measured(without=("obb", "sobb256"))], "binary")
    assert set(METHODS) - set(group.rows) == {"obb", "sobb256"}
    assert str(cells(group, "overhead_ms")["14-dop"]) == "20.0"  # nothing to compare with
    both = [measured(), measured(without=("sobb256",))]
    means = groups(both, "binary")[-1]
    assert str(cells(means, "area_leaf")["sobb128"]) == "(1.00)"
    assert str(cells(means, "area_leaf")["sobb256"]) == "–"  # not of all scenes
    without_base = measured(without=("aabb",))
    (group,) = groups([without_base], "binary")
    assert cells(group, "secondary_mrays")["obb"].ratio is None


def test_geometric_means():
    speeds = (4.0, 1.0)
    both = [measured(speed=lambda m, s=s: s if m == "obb" else 1.0) for s in speeds]
    *_, means = groups(both, "wide")
    assert means.title == "geometric mean of 2"
    assert str(cells(means, "secondary_mrays")["obb"]) == "(2.00)"
    assert str(cells(means, "area_inner")["obb"]) == "(0.50)"
    assert cells(means, "secondary_mrays")["obb"].best


def test_numbers():
    values = (12345.6, 99.96, 99.94, 9.996, 9.994, 0.004)
    assert [number(v) for v in values] == ["12,346", "100", "99.9", "10.0", "9.99", "0.00"]
    assert [short_count(n) for n in (12_800_000, 999_999, 67_405)] == ["12.8M", "1.0M", "67k"]


def test_largest_variation():
    report = bench.parse(document())
    report.variations["primary/obb/wide"]["real_time"] = 0.07
    assert largest_variation([measured(), Measured("hair", report)]) == (
        0.07,
        "hair, primary/obb/wide",
    )
    report.variations.clear()
    assert largest_variation([Measured("hair", report)]) is None


def test_markdown():
    text = markdown.text([measured("a|b_*c"), measured()])
    assert "A & B, 2 threads, avx2; sobb 0.1.0; 2025-06-07" in text
    assert "2.0 %" in text and "200 rays" in text
    assert r"| **a\|b\_\*c \[2.8M\]** | AABB | **100 (1.00)** | – |" in text
    lines = [line for line in text.splitlines() if line.startswith("| ")]
    assert len(lines) == len(LAYOUTS) * (1 + 3 * len(METHODS))
    assert all(line.replace(r"\|", "").count("|") == 3 + len(COLUMNS) for line in lines)


def test_latex():
    assert latex.escape(r"a_b & 5% #1 {$x^2$} ~\z") == (
        r"a\_b \& 5\% \#1 \{\$x\textasciicircum{}2\$\} \textasciitilde{}\textbackslash{}z"
    )
    text = latex.text([measured("stk-black_forest"), measured()])
    assert r"\textbf{stk-black\_forest [2.8M]} & AABB & \textbf{100} & \textbf{(1.00)}" in text
    assert text.count(r"\begin{longtable}") == text.count(r"\end{longtable}") == len(LAYOUTS)
    rows = [line for line in text.splitlines() if line.endswith(r"\\") and " & " in line]
    assert all(
        row.replace(r"\&", "").count("&") == 1 + 2 * len(COLUMNS)
        for row in rows[1:]
        if "multicolumn" not in row
    )


def test_csv():
    rows = list(csv.DictReader(io.StringIO(csv_table.text([measured("a,b")]))))
    assert len(rows) == len(LAYOUTS) * len(METHODS)
    row = next(r for r in rows if r["method"] == "SOBB 32i" and r["layout"] == "wide")
    assert (row["scene"], row["triangles"], row["strategy"]) == ("a,b", "2799994", "k2")
    assert (row["build_ms"], row["overhead_ms"], row["overhead_ms_cv"]) == ("150", "50", "0.02")
    assert (row["secondary_mrays"], row["secondary_triangles_per_ray"]) == ("4", "6.25")
    assert (row["source"], row["processor"]) == ("builtin:city:2800000", "A & B")
    assert rows[0]["overhead_ms"] == "" and rows[0]["strategy"] == ""


@pytest.mark.parametrize("count", [1, 3])
def test_chart(count):
    shown = [measured(speed=lambda m: 2.0 if m == "obb" else 0.9)] * count
    png = chart.picture(shown, "png")
    picture = Image.open(io.BytesIO(png))
    assert picture.width == 1800 and picture.convert("RGBA").getpixel((2, 2)) == (255,) * 4
    svg = chart.picture(shown, "svg")
    assert svg.startswith(b"<?xml") and svg == chart.picture(shown, "svg")


PROGRAM = """#!{python}
import json, sys, time
options = dict(argument.lstrip("-").split("=", 1) for argument in sys.argv[1:])
if "foliage" in options["scene"]:
    sys.exit("sobb_bench_volumes: obb differs from aabb on primary ray 7")
if "wool" in options["scene"]:
    time.sleep(60)
document = json.loads({document!r})
document["context"].update({{key: options[key] for key in ("scene", "size", "threads")}})
json.dump(document, open(options["benchmark_out"], "w"))
"""


@pytest.fixture
def program(tmp_path, monkeypatch):
    """A program that has its figures ready, fails for foliage and is slow for wool."""
    path = tmp_path / "bin" / "sobb_bench_volumes"
    path.parent.mkdir()
    path.write_text(PROGRAM.format(python=sys.executable, document=json.dumps(document())))
    path.chmod(0o755)
    monkeypatch.setenv("SOBB_LIBRARY_PATH", str(tmp_path / "lib"))
    return path


def listed(folder):
    return {entry.name for entry in folder.iterdir()}


def test_run(cli, program, tmp_path):
    out = tmp_path / "deep" / "out"
    scenes = "builtin:city:1000", "builtin:city:1000@30"
    done = cli("paper", "--scenes", *scenes, "--out", out, "--quick", "--threads", "1")
    assert done.returncode == 0 and done.stderr == "", done.stderr
    assert listed(out) == FILES
    assert listed(out / "raw") == {"city-1000.json", "city-1000@30.json"}
    rows = list(csv.DictReader((out / "paper.csv").open()))
    assert {row["threads"] for row in rows} == {"1"}
    assert [row["source"] for row in rows[:: len(rows) // 2]] == list(scenes)
    assert done.stdout.count("SOBB 64i") == 6 and "geometric mean of 2" in done.stdout
    assert "\x1b" not in done.stdout


def test_a_scene_that_fails(cli, program, tmp_path):
    scenes = "builtin:city:1000", "builtin:foliage:1000", "builtin:pipes:1000"
    done = cli("paper", "--scenes", *scenes, "--out", tmp_path / "out")
    assert done.returncode == 1
    first, last = done.stderr.splitlines()
    assert "builtin:foliage:1000" in first and "obb differs from aabb on primary ray 7" in first
    assert last == "sobb: 1 of 3 scenes failed: builtin:foliage:1000"
    assert listed(tmp_path / "out" / "raw") == {"city-1000.json", "pipes-1000.json"}
    assert "pipes" in (tmp_path / "out" / "paper.md").read_text()


def test_what_is_missing_is_told_before_measuring(cli, program, folder, tmp_path, monkeypatch):
    arguments = "paper", "--out", tmp_path / "out", "--scenes", "builtin:city:1000"
    done = cli(*arguments, "crown", "no such", "/nowhere/a.glb@30")
    assert done.returncode == 1 and done.stdout == ""
    assert "no such, /nowhere/a.glb@30" in done.stderr and str(folder) in done.stderr
    monkeypatch.delenv("SOBB_SCENES")
    done = cli(*arguments, "crown")
    assert done.returncode == 1 and "SOBB_SCENES names no folder" in done.stderr
    monkeypatch.setenv("SOBB_SCENES", str(tmp_path / "gone"))
    done = cli("paper", "--out", tmp_path / "out")
    assert done.returncode == 1 and "gone" in done.stderr
    program.unlink()
    monkeypatch.setenv("PATH", "/nowhere")
    done = cli(*arguments)
    assert done.returncode == 1 and "no sobb_bench_volumes" in done.stderr
    assert not (tmp_path / "out").exists()


def test_an_interrupt_keeps_what_is_done(program, tmp_path):
    out = tmp_path / "out"
    command = [sys.executable, "-m", "sobb", "paper", "--out", str(out), "--scenes"]
    command += ["builtin:city:1000", "builtin:wool:1000"]
    process = subprocess.Popen(command, stderr=subprocess.PIPE, stdout=subprocess.DEVNULL)
    deadline = time.monotonic() + 60
    while not (out / "paper.svg").exists() and time.monotonic() < deadline:
        time.sleep(0.01)
    process.send_signal(signal.SIGINT)
    _, errors = process.communicate(timeout=30)
    assert process.returncode == 1 and errors.decode().strip() == "sobb: interrupted"
    assert listed(out) == FILES and listed(out / "raw") == {"city-1000.json"}


def test_a_real_quick_run(cli, tmp_path):
    """This is the one slow test: all methods on six small scenes."""
    start = time.monotonic()
    done = cli("paper", "--quick", "--out", tmp_path)
    assert done.returncode == 0, done.stderr
    assert time.monotonic() - start < 120
    rows = list(csv.DictReader(Path(tmp_path, "paper.csv").open()))
    assert len(rows) == 6 * len(LAYOUTS) * len(METHODS)
    for row in rows:
        assert float(row["secondary_mrays"]) > 0 and row["brute_force_rays"] == "200"
        assert float(row["area_inner"]) > 0 and float(row["area_leaf"]) > 0
