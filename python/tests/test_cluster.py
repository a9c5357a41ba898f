# SPDX-License-Identifier: Apache-2.0
"""Sweeps on a Dask cluster of two workers on this machine, one of which is killed."""

import os
import signal
import subprocess
import sys
import time

import pytest

duckdb = pytest.importorskip("duckdb")
distributed = pytest.importorskip("distributed")

SWEEP = ("--scenes", "builtin:city:500", "builtin:pipes:500", "builtin:terrain:500")
SWEEP += ("--rays", "primary", "--size", "8", "--repetitions", "2")


def _cases(path):
    with duckdb.connect(str(path), read_only=True) as connection:
        return connection.execute("SELECT case_id, status FROM cases ORDER BY ALL").fetchall()


@pytest.fixture
def cluster():
    options = {"n_workers": 2, "threads_per_worker": 1, "dashboard_address": None}
    with distributed.LocalCluster(processes=True, **options) as cluster:
        yield cluster


def test_a_killed_worker_loses_nothing(cli, tmp_path, cluster):
    whole, parts = tmp_path / "whole.duckdb", tmp_path / "parts.duckdb"
    assert cli("sweep", *SWEEP, "--out", whole).returncode == 0
    address = cluster.scheduler_address
    command = [sys.executable, "-m", "sobb", "sweep", *SWEEP, "--out", parts, "--dask", address]
    sweep = subprocess.Popen(command, stderr=subprocess.PIPE, text=True)
    with distributed.Client(cluster) as client:
        workers = list(client.run(os.getpid).values())
        end = time.monotonic() + 60
        while not any(client.processing().values()) and time.monotonic() < end:
            time.sleep(0.01)
        os.kill(workers[0], signal.SIGKILL)
    _, said = sweep.communicate(timeout=120)
    assert sweep.returncode == 0, said
    assert _cases(parts) == _cases(whole) and len(_cases(whole)) == 9


def test_no_scheduler(cli, tmp_path):
    done = cli("sweep", *SWEEP, "--out", tmp_path / "r.duckdb", "--dask", "tcp://127.0.0.1:9")
    assert done.returncode == 1 and "no Dask scheduler" in done.stderr
