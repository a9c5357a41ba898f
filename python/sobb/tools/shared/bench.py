# SPDX-License-Identifier: Apache-2.0
"""Runs a benchmark program, and reads the JSON that Google Benchmark writes."""

import json
import shutil
import subprocess
import tempfile
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from sobb import library
from sobb.tools.shared import atomic

#: The name of a row -> its time in ms (`real_time`) and its counters.
Rows = dict[str, dict[str, Any]]


@dataclass(frozen=True)
class Report:
    """One run of a program: its context (machine, scene, versions) and its rows."""

    context: dict[str, Any]
    medians: Rows
    variations: Rows  # coefficients of variation, of the rows that were repeated


def find_program(name: str) -> Path:
    """Finds a program in bin beside the libraries' folder, or in PATH. Raises OSError."""
    folder = library.folder()
    beside = None if folder is None else folder.parent / "bin"
    found = (beside and shutil.which(name, path=str(beside))) or shutil.which(name)
    if found is None:
        places = "PATH" if beside is None else f"{beside} nor in PATH"
        raise OSError(f"no {name} in {places}: build it (scripts/setup.sh)")
    return Path(found)


def run(program: str, arguments: Sequence[str], raw: Path | None = None) -> Report:
    """Runs a program; keeps its JSON in the file `raw`.

    Raises OSError, with the last line that the program printed, if it or one of its rows fails.
    """
    with tempfile.TemporaryDirectory(prefix="sobb-bench-") as folder:
        out = Path(folder, "rows.json")
        command = [str(find_program(program)), *arguments]
        command += [f"--benchmark_out={out}", "--benchmark_out_format=json"]
        done = subprocess.run(
            command, check=False, capture_output=True, text=True, errors="replace"
        )
        if done.returncode != 0:
            last = (done.stderr.strip() or done.stdout.strip()).splitlines()[-1:]
            raise OSError(f"{program} failed ({done.returncode}): {''.join(last)}")
        data = out.read_bytes()
    report = parse(json.loads(data))
    if raw is not None:
        atomic.write_bytes(raw, data)
    return report


def parse(document: dict[str, Any]) -> Report:
    """Reads what Google Benchmark wrote. Raises OSError for a row that failed."""
    report = Report(document["context"], {}, {})
    for entry in document["benchmarks"]:
        if entry.get("error_occurred"):
            raise OSError(f"{entry['name']}: {entry.get('error_message', '')}")
        name = entry["run_name"].removesuffix("/manual_time")
        # A single repetition is its own median; several have an entry for theirs.
        if entry["run_type"] == "iteration" or entry["aggregate_name"] == "median":
            report.medians[name] = entry
        elif entry["aggregate_name"] == "cv":
            report.variations[name] = entry
    return report
