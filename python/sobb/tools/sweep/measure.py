# SPDX-License-Identifier: Apache-2.0
"""Measures one case in a process of its own; returns how it ended, and its samples."""

import json
import platform
import tempfile
import time
from collections.abc import Iterator
from dataclasses import dataclass, replace
from datetime import UTC, datetime
from pathlib import Path
from typing import Any

from sobb.tools.shared import bench, host_lock
from sobb.tools.sweep import process
from sobb.tools.sweep.plan import Job
from sobb.tools.sweep.records import DONE, FAILED, Case, Sample
from sobb.tools.sweep.spec import CALLS

#: The programs' counters -> the names of the store's metrics, where these differ.
_METRICS = {
    "Mrays/s": "mrays_s",
    "bytes/triangle": "bytes_per_triangle",
    "area_leaf": "area_leaves",
    "volume_ms": "fit_ms",
}
_COUNTERS = {
    *("Mrays/s", "nodes/ray", "volumes/ray", "blocks/ray", "triangles/ray", "bytes/triangle"),
    *("area_inner", "area_leaf", "topology_ms", "collapse_ms", "volume_ms", "node_bytes"),
}
#: Rows that trace nothing -> the metric of their time.
_TIMES = {"build": "build_ms", "overhead": "fit_ms"}


@dataclass(frozen=True)
class Outcome:
    """A measured case, and the version of Embree that the program reported."""

    case: Case
    samples: list[Sample]
    embree_version: str | None = None


def measure(job: Job) -> Outcome:
    """Measures a case; whatever happens to it is in its status.

    Raises OSError where the program is missing, or has no room for its output.
    """
    program = str(bench.find_program(job.program))
    with tempfile.TemporaryDirectory(prefix="sobb-sweep-") as folder, host_lock.turn() as turn:
        out = Path(folder, "rows.json")
        command = [program, *job.arguments, f"--benchmark_out={out}"]
        start = time.monotonic()
        status, error = process.run(
            [*command, "--benchmark_out_format=json"],
            Path(folder), job.time_limit, job.memory_limit, turn,
        )  # fmt: skip
        seconds = time.monotonic() - start
        context: dict[str, Any] = {}
        found: list[Sample] = []
        if status == DONE:
            try:
                document = json.loads(out.read_bytes())
                context, found = document["context"], list(samples(document))
            except (OSError, ValueError, KeyError) as problem:
                status, error = FAILED, f"its results cannot be read: {problem}"
    if status == DONE and not found:
        status, error = FAILED, "the program measured no row"
    triangles = int(context["triangles"]) if "triangles" in context else None
    case = replace(
        job.case, status=status, error=error, seconds=seconds, triangles=triangles,
        isa=context.get("isa", job.case.isa) if job.case.method != "embree" else job.case.isa,
        host=platform.node(), finished=datetime.now(UTC).replace(tzinfo=None),
    )  # fmt: skip
    return Outcome(case, found if status == DONE else [], context.get("embree"))


def samples(document: dict[str, Any]) -> Iterator[Sample]:
    """Yields the samples of every repetition of every row. Raises ValueError for a failed row."""
    for row in document["benchmarks"]:
        if row.get("error_occurred"):
            raise ValueError(f"{row['name']}: {row.get('error_message', '')}")
        if row["run_type"] != "iteration":
            continue
        repetition = row["repetition_index"]
        kind, call = _kind_and_call(row["run_name"])
        traced = kind not in _TIMES
        if not traced:
            yield Sample(None, None, _TIMES[kind], repetition, row["real_time"])
        for counter in sorted(_COUNTERS & row.keys()):
            metric = _METRICS.get(counter, counter.replace("/", "_per_"))
            rays = kind if traced else None
            yield Sample(rays, call if traced else None, metric, repetition, row[counter])


def _kind_and_call(name: str) -> tuple[str, str]:
    """Returns KIND and CALL of KIND/METHOD/CALL.

    The rows of sobb_bench_volumes have a layout in place of the call; they trace arrays.
    """
    kind, _, call = name.split("/")[:3]
    return ("diffuse7" if kind == "secondary" else kind), call if call in CALLS else "array"
