# SPDX-License-Identifier: Apache-2.0
"""Figures from the benchmark program, sobb_bench: the library beside Embree on the same rays."""

import json
import os
import shutil
import subprocess
import tempfile
from collections.abc import Sequence
from pathlib import Path
from typing import Any

_CHECKOUT = Path(__file__).resolve().parents[2]

#: The name of a row -> its time in ms (`real_time`) and counters.
Rows = dict[str, dict[str, Any]]


def find_program() -> Path:
    """sobb_bench: beside the folder of SOBB_LIBRARY_PATH, in the checkout's release build, or in
    PATH. Raises OSError."""
    folder = os.environ.get("SOBB_LIBRARY_PATH")
    build = Path(folder).parent if folder else _CHECKOUT / "build" / "release"
    found = shutil.which("sobb_bench", path=str(build / "bin")) or shutil.which("sobb_bench")
    if found is None:
        raise OSError(f"no sobb_bench in {build / 'bin'} nor in PATH: build it (scripts/setup.sh)")
    return Path(found)


def run(arguments: Sequence[str]) -> Rows:
    """Runs sobb_bench; returns the medians of its rows. Raises OSError with what it said, where it
    or one of its rows fails."""
    with tempfile.TemporaryDirectory(prefix="sobb-bench-") as folder:
        out = os.path.join(folder, "rows.json")
        command = [str(find_program()), *arguments]
        command += [f"--benchmark_out={out}", "--benchmark_out_format=json"]
        done = subprocess.run(
            command, check=False, capture_output=True, text=True, errors="replace"
        )
        if done.returncode != 0:
            last = (done.stderr.strip() or done.stdout.strip()).splitlines()[-1:]
            raise OSError(f"sobb_bench failed ({done.returncode}): {''.join(last)}")
        with open(out, encoding="utf-8") as file:
            return _medians(json.load(file)["benchmarks"])


def _medians(entries: list[dict[str, Any]]) -> Rows:
    rows: Rows = {}
    for entry in entries:
        if entry.get("error_occurred"):
            raise OSError(f"sobb_bench: {entry['name']}: {entry.get('error_message', '')}")
        # One repetition is its own median; of several there is an entry that says so.
        if entry["run_type"] == "iteration" or entry.get("aggregate_name") == "median":
            rows[entry["run_name"].removesuffix("/manual_time")] = entry
    return rows
