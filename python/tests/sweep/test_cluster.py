# SPDX-License-Identifier: Apache-2.0
"""Sweeps on a Dask cluster of two workers on this machine, one of which is killed."""

import os
import signal
import subprocess
import sys
import time

import pytest

pytest.importorskip("duckdb")
distributed = pytest.importorskip("distributed")

import interrupts  # noqa: E402


@pytest.fixture
def cluster():
    options = {"n_workers": 2, "threads_per_worker": 1, "dashboard_address": None}
    with distributed.LocalCluster(processes=True, **options) as cluster:
        yield cluster


def test_interrupted_three_times_by_ctrl_c_a_kill_and_a_killed_worker(cli, tmp_path, toml, cluster):
    whole, parts = tmp_path / "whole.duckdb", tmp_path / "parts.duckdb"
    assert cli("sweep", toml, "--out", whole).returncode == 0
    sweep = ["sweep", toml, "--out", parts, "--dask", cluster.scheduler_address]
    for number in (signal.SIGINT, signal.SIGKILL):
        code, said = interrupts.interrupt(sweep, parts, number)
        assert code == (1 if number == signal.SIGINT else -number), said
    command = [sys.executable, "-m", "sobb", *map(str, sweep)]
    running = subprocess.Popen(command, stderr=subprocess.PIPE, text=True)
    with distributed.Client(cluster) as client:
        workers = list(client.run(os.getpid).values())
        end = time.monotonic() + 60
        while not any(client.processing().values()) and time.monotonic() < end:
            time.sleep(0.01)
        os.kill(workers[0], signal.SIGKILL)
    _, said = running.communicate(timeout=120)
    assert running.returncode == 0, said
    assert interrupts.rows(parts) == interrupts.rows(whole)
    assert len(interrupts.rows(whole)[0]) == 12


def test_no_scheduler(cli, tmp_path, toml):
    done = cli("sweep", toml, "--out", tmp_path / "r.duckdb", "--dask", "tcp://127.0.0.1:9")
    assert done.returncode == 1 and "no Dask scheduler" in done.stderr
