# SPDX-License-Identifier: Apache-2.0
"""Interrupts sweeps, and reads the rows that must be the same with and without interruptions."""

import subprocess
import sys
import time
from pathlib import Path


def rows(path):
    """Returns the cases with their status, and the figures that are kept of each."""
    import duckdb

    with duckdb.connect(str(path), read_only=True) as connection:
        cases = connection.execute("SELECT case_id, status FROM cases ORDER BY ALL").fetchall()
        # sobb_bench_volumes repeats a row as often as its time allows
        kept = connection.execute(
            "SELECT case_id, rays, call, metric, if(method = 'obb', 0, repetition) AS repetition "
            "FROM results GROUP BY ALL ORDER BY ALL"
        ).fetchall()
    return cases, kept


def interrupt(arguments, out, number):
    """Starts a sweep into the file `out`; sends it a signal once it has kept something more."""
    before = _kept(out)
    command = [sys.executable, "-m", "sobb", *map(str, arguments)]
    running = subprocess.Popen(command, stderr=subprocess.PIPE, text=True)
    end = time.monotonic() + 60
    while _kept(out) == before and running.poll() is None and time.monotonic() < end:
        time.sleep(0.005)
    running.send_signal(number)
    return running.wait(60), running.stderr.read()


def _kept(out):
    return sum(path.stat().st_size for path in (out, Path(f"{out}.wal")) if path.exists())
