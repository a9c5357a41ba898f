# SPDX-License-Identifier: Apache-2.0
"""Sweeps: the keys of their files, the cases they make, and that interruptions lose nothing."""

import os
import resource
import signal
import subprocess
import sys

import pytest

duckdb = pytest.importorskip("duckdb")

import interrupts  # noqa: E402

from sobb.tools.shared import host_lock  # noqa: E402
from sobb.tools.sweep import plan, process, spec  # noqa: E402
from sobb.tools.sweep.records import CRASHED, DONE, FAILED, MEMORY, TIMEOUT  # noqa: E402


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("scene = ['a']", "unknown key 'scene', the nearest is 'scenes'"),
        ("", "the key 'scenes' is missing"),
        ("scenes = []", "scenes: the list is empty"),
        ("scenes = [3]", "scenes: 3 is not a text"),
        ("scenes = 'a'\nviews = [true]", "views: True is not a whole number"),
        ("scenes = 'a'\nmethods = 'sob'", "methods: unknown 'sob', the nearest is sobb"),
        ("scenes = 'a'\nsize = 0", "size: 0 is not from 1 to 8192"),
        ("scenes = 'a'\nmin_time = nan", "min_time: nan is not from"),
        ("scenes = [", "sweep.toml: "),
    ],
)
def test_wrong_files(toml, text, message):
    toml.write_text(text)
    with pytest.raises(ValueError) as raised:
        spec.read(toml, {})
    assert "sweep.toml" in str(raised.value) and message in str(raised.value)


def test_only_scenes_are_needed(toml):
    toml.write_text("scenes = 'builtin:city:500'")
    jobs = plan.jobs(spec.read(toml, {}))
    assert [job.case.method for job in jobs] == ["aabb", "sobb", "embree"]


def test_options_without_meaning_make_no_cases():
    values = {"scenes": "builtin:city:500", "k": [32, 64], "strategy": ["k", "k2"], "width": [4, 8]}
    methods = [job.case.method for job in plan.jobs(spec.make(values, "test"))]
    assert {name: methods.count(name) for name in methods} == {"aabb": 2, "sobb": 8, "embree": 1}


def test_subdivisions():
    values = {"scenes": ["builtin:city:500@30", "builtin:pipes:500^16"], "subdivisions": [1, 4]}
    jobs = plan.jobs(spec.make(values | {"methods": "sobb"}, "test"))
    assert [(job.case.scene, job.case.name, job.case.subdivision) for job in jobs] == [
        ("builtin:city:500@30", "city@30", 1),
        ("builtin:city:500@30", "city@30", 4),
        ("builtin:pipes:500", "pipes", 16),
    ]
    assert [job.arguments[0] for job in jobs] == [
        "--scene=builtin:city:500@30",
        "--scene=builtin:city:500^4@30",
        "--scene=builtin:pipes:500^16",
    ]


def test_a_refined_scene_has_more_triangles(cli, tmp_path, toml):
    toml.write_text(toml.read_text().replace("]", "]\nsubdivisions = [1, 16]", 1))
    out, fewer = tmp_path / "r.duckdb", ("--scenes", "builtin:city:500", "--methods", "sobb")
    assert cli("sweep", toml, *fewer, "--out", out).returncode == 0
    with duckdb.connect(str(out), read_only=True) as connection:
        rows = connection.execute(
            "SELECT subdivision, triangles FROM cases ORDER BY ALL"
        ).fetchall()
    assert [times for times, _ in rows] == [1, 16] and rows[1][1] == 16 * rows[0][1]


def test_missing_scenes_come_first(cli, tmp_path, toml):
    out = tmp_path / "r.duckdb"
    done = cli("sweep", toml, "--scenes", "builtin:city:500", "gone.glb", "--out", out)
    assert done.returncode == 1 and "gone.glb" in done.stderr
    assert not out.exists()


def test_a_scene_that_fails_stops_no_other(cli, tmp_path, toml):
    (tmp_path / "bad.obj").write_text("f 1 2 3\n")
    out, scenes = tmp_path / "r.duckdb", ("--scenes", tmp_path / "bad.obj", "builtin:city:500")
    done = cli("sweep", toml, *scenes, "--methods", "sobb", "--out", out)
    assert done.returncode == 1 and "bad.obj" in done.stderr and "1 of 2 cases" in done.stderr
    assert sorted(status for _, status in interrupts.rows(out)[0]) == ["done", "failed"]


@pytest.mark.parametrize(
    ("code", "status"),
    [
        ("pass", DONE),
        ("raise SystemExit('cause')", FAILED),
        ("import os; os.abort()", CRASHED),
        ("import time; time.sleep(60)", TIMEOUT),
        ("import time; x = b'x' * (200 << 20); time.sleep(60)", MEMORY),
    ],
)
def test_limits(tmp_path, code, status):
    limit = 1 if status == TIMEOUT else 50
    with open(os.devnull) as keep:
        command = [sys.executable, "-c", code]
        ended, error = process.run(command, tmp_path, limit, 150, keep.fileno())
    assert ended == status and (error is None) == (status == DONE)


def test_turns(tmp_path):
    """A second process waits until the first releases the lock."""
    code = "from sobb.tools.shared import host_lock\nwith host_lock.turn(): print('mine')"
    with host_lock.turn():
        other = subprocess.Popen([sys.executable, "-c", code], stdout=subprocess.PIPE)
        with pytest.raises(subprocess.TimeoutExpired):
            other.wait(1.5)
    assert other.communicate(timeout=60)[0] == b"mine\n"


def test_interrupted_sweeps_end_with_the_same_rows(cli, tmp_path, toml):
    whole, parts = tmp_path / "whole.duckdb", tmp_path / "parts.duckdb"
    assert cli("sweep", toml, "--out", whole).returncode == 0
    for number in (signal.SIGINT, signal.SIGKILL, signal.SIGINT):
        code, said = interrupts.interrupt(["sweep", toml, "--out", parts], parts, number)
        assert code == (1 if number == signal.SIGINT else -number), said
        if number == signal.SIGINT:
            assert "interrupted" in said
    done = cli("sweep", toml, "--out", parts)
    assert done.returncode == 0, done.stderr
    assert interrupts.rows(parts) == interrupts.rows(whole)
    again = cli("sweep", toml, "--out", parts)
    assert "0 of them measured now" in again.stdout


def _files_up_to(size):
    """Lets no file of this process grow beyond `size` bytes, as a full disk does."""
    signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
    resource.setrlimit(resource.RLIMIT_FSIZE, (size, size))


def test_a_full_disk_loses_nothing(cli, tmp_path, toml):
    whole, parts = tmp_path / "whole.duckdb", tmp_path / "parts.duckdb"
    command = [sys.executable, "-m", "sobb", "sweep", toml, "--out", parts]
    env = {**os.environ, "LLVM_PROFILE_FILE": os.devnull}  # which would be a file, too
    for size, kept in ((0, False), (8 << 10, False), (20 << 10, True)):
        full = subprocess.run(
            command,
            preexec_fn=lambda size=size: _files_up_to(size),
            env=env,
            capture_output=True,
            text=True,
        )
        assert full.returncode == 1 and f"sobb: {parts}: " in full.stderr
        assert "File too large" in full.stderr and parts.exists() == kept, full.stderr
    assert 0 < len(interrupts.rows(parts)[0]) < 12
    assert cli("sweep", toml, "--out", parts).returncode == 0
    assert cli("sweep", toml, "--out", whole).returncode == 0
    assert interrupts.rows(parts) == interrupts.rows(whole)
