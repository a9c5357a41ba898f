# SPDX-License-Identifier: Apache-2.0
"""The command line: exit codes 0, 1 and 2, output, messages, and files."""

import json
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest
from PIL import Image

from sobb.tools import cli as front

SCENE = "builtin:city:3000"


@pytest.fixture
def built(cli, tmp_path):
    path = tmp_path / "city.sobb"
    done = cli("build", SCENE, "-o", path)
    assert done.returncode == 0, done.stderr
    return path


def test_build_and_validate(cli, built, tmp_path):
    done = cli("validate", built)
    assert done.returncode == 0 and "valid" in done.stdout and done.stderr == ""
    other = tmp_path / "other.sobb"
    assert cli("build", f"{SCENE}@30", "-o", other, "--table", "fitted").returncode == 0
    assert json.loads(cli("info", other, "--json").stdout)["table"] == "fitted"
    options = "--volume aabb --quality high --width 4 --threads 1".split()
    assert cli("build", SCENE, "-o", other, *options).returncode == 0
    facts = json.loads(cli("info", other, "--json").stdout)
    assert (facts["volume"], facts["quality"], facts["width"]) == ("aabb", "high", 4)


def test_info(cli, built):
    scene = json.loads(cli("info", SCENE, "--json").stdout)
    assert scene["kind"] == "scene" and 0 < scene["triangles"] <= 3000
    assert {"vertices", "degenerate", "bounds_min", "bounds_max", "meshes", "views"} <= set(scene)
    file = json.loads(cli("info", built, "--json").stdout)
    assert file["kind"] == "hierarchy" and file["triangles"] == scene["triangles"]
    assert {"nodes", "leaves", "depth", "inner_area", "leaf_area", "bytes"} <= set(file)
    text = cli("info", built)
    assert text.returncode == 0 and str(file["nodes"]) in text.stdout


def test_info_tells_what_was_passed_over(cli, tmp_path):
    scene = tmp_path / "a.obj"
    scene.write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2\nf 1 2 3\n")
    (note,) = json.loads(cli("info", scene, "--json").stdout)["notes"]
    short = "faces of fewer than three corners"
    assert note == {"cause": short, "count": 1, "message": "line 4: a face of 2 corners"}
    text = cli("info", scene).stdout
    assert f"passed over     1 ({short}): line 4: a face of 2 corners\n" in text
    assert "passed over" not in cli("info", SCENE).stdout


def test_render(cli, built, tmp_path):
    picture = tmp_path / "a.png"
    assert cli("render", built, "-o", picture, "--size", "48x27").returncode == 0
    assert Image.open(picture).size == (48, 27)
    assert cli("render", SCENE, "-o", picture, "--size", "40x40", "--heat").returncode == 0
    assert Image.open(picture).size > (40, 40)


def test_render_with_cameras(cli, built, tmp_path):
    view = {"eye": [0, 9, 9], "target": [0, 0, 0], "up": [0, 1, 0], "vfov_degrees": 50}
    cameras = tmp_path / "views.json"
    cameras.write_text(json.dumps({"city": [view]}))
    picture = tmp_path / "a.png"
    arguments = "render", built, "-o", picture, "--size", "16x16", "--cameras", cameras
    assert cli(*arguments).returncode == 0
    done = cli(*arguments, "--view", "1")
    assert done.returncode == 1 and "no view 1" in done.stderr


def test_failures(cli, tmp_path):
    missing, text = tmp_path / "missing.sobb", tmp_path / "text.sobb"
    text.write_text("no hierarchy " * 100)
    for arguments in (
        ("validate", missing),
        ("validate", text),
        ("info", missing),
        ("info", tmp_path / "missing.obj"),
        ("build", "builtin:teapot", "-o", tmp_path / "a.sobb"),
        ("build", SCENE, "-o", tmp_path / "no folder" / "a.sobb"),
        ("render", SCENE, "-o", tmp_path / "no folder" / "a.png", "--size", "8x8"),
        ("render", SCENE, "-o", tmp_path / "a.png", "--cameras", tmp_path / "missing.json"),
    ):
        done = cli(*arguments)
        assert done.returncode == 1, arguments
        assert done.stderr.startswith("sobb: ") and "Traceback" not in done.stderr
        assert done.stdout == ""
    assert [entry.name for entry in tmp_path.iterdir()] == ["text.sobb"]


@pytest.mark.parametrize(
    "arguments",
    [
        "",
        "fly",
        "build",
        "build scene.obj",
        f"build {SCENE} -o a.sobb --k 33",
        f"build {SCENE} -o a.sobb --threads -1",
        f"render {SCENE} -o a.png --size 0x10",
        f"render {SCENE} -o a.png --size big",
        "info",
        "info a.sobb b.sobb",
        "validate",
        "demo --speed",
    ],
)
def test_wrong_usage(cli, arguments):
    done = cli(*arguments.split())
    assert done.returncode == 2 and "usage" in done.stderr


def test_help(cli):
    assert cli("--help").returncode == 0
    assert "SCENE" in cli("build", "--help").stdout


def test_a_command_says_which_extra_it_needs(capsys, monkeypatch):
    monkeypatch.setitem(sys.modules, "PIL", None)
    monkeypatch.delitem(sys.modules, "sobb.tools.render.image", raising=False)
    assert front.main(["render", "builtin:city:100", "-o", "unused.png"]) == 1
    assert "sobb[commands]" in capsys.readouterr().err


def test_a_start_imports_no_package_of_an_extra():
    extras = "PIL rich matplotlib duckdb distributed altair jinja2 vl_convert".split()
    code = "import sys; from sobb.tools import cli; print(*sys.modules)"
    done = subprocess.run([sys.executable, "-c", code], check=True, capture_output=True, text=True)
    assert not set(extras) & set(done.stdout.split())


def test_interrupt_leaves_no_half_file(tmp_path):
    output = tmp_path / "hair.sobb"
    command = [sys.executable, "-m", "sobb", "build", "builtin:hairball:2000000", "-o", str(output)]
    process = subprocess.Popen(command, stderr=subprocess.PIPE, text=True)
    maps = Path(f"/proc/{process.pid}/maps")
    while process.poll() is None and b"libsobb_scene" not in maps.read_bytes():
        time.sleep(0.01)  # until it is at work
    process.send_signal(signal.SIGINT)
    _, errors = process.communicate(timeout=60)
    assert process.returncode == 1 and errors.strip().endswith("interrupted")
    assert list(tmp_path.iterdir()) == []
