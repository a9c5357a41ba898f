# SPDX-License-Identifier: Apache-2.0
"""Measures the cases that the file of results lacks, and keeps each as soon as it is done."""

import json
import os
import platform
import subprocess
import sys
from collections.abc import Iterator, Sequence
from dataclasses import asdict
from pathlib import Path

import sobb
from sobb.tools.shared import bench
from sobb.tools.shared.progress import bar
from sobb.tools.sweep import measure, plan
from sobb.tools.sweep.measure import Outcome
from sobb.tools.sweep.plan import Job
from sobb.tools.sweep.records import DONE, Run
from sobb.tools.sweep.spec import Spec
from sobb.tools.sweep.store import Store

_PACKAGE = Path(sobb.__file__).resolve().parent


def run(spec: Spec, out: Path, retry: bool, dask: str | None = None) -> None:
    """Runs a sweep into the file `out`, or continues it.

    retry: measure again the cases that failed.
    dask: the address of a scheduler whose workers measure; None for this process.

    A case that fails is reported on stderr; OSError is raised at the end then.
    """
    jobs = plan.jobs(spec)
    if dask is None:
        for program in sorted({job.program for job in jobs}):
            bench.find_program(program)
    with Store(out) as store:
        known = store.statuses()
        left = [job for job in jobs if _is_left(known.get(job.case.case_id), retry)]
        if left:
            _measure(store, store.begin_run(_circumstances(spec)), left, len(jobs), out, dask)
        statuses = store.statuses()
    bad = [job for job in jobs if statuses[job.case.case_id] != DONE]
    print(f"{out}: {len(jobs) - len(bad)} of {len(jobs)} cases, {len(left)} of them measured now")
    if bad:
        raise OSError(f"{len(bad)} of {len(jobs)} cases failed; --retry tries them again")


def _is_left(status: str | None, retry: bool) -> bool:
    return status is None or (retry and status != DONE)


def _measure(
    store: Store, run_id: int, left: Sequence[Job], total: int, out: Path, dask: str | None
) -> None:
    embree = None
    try:
        with bar(f"{len(left)} of {total} cases") as progress:
            for done, outcome in enumerate(_outcomes(left, dask)):
                store.add(run_id, outcome.case, outcome.samples)
                embree = outcome.embree_version or embree
                _tell(outcome)
                progress((done + 1) / len(left))
    except BaseException:
        print(f"sobb: {out} has the results so far; the same command continues", file=sys.stderr)
        raise
    store.end_run(run_id, embree)


def _outcomes(jobs: Sequence[Job], dask: str | None) -> Iterator[Outcome]:
    if dask is None:
        return map(measure.measure, jobs)
    from sobb.tools.sweep import cluster  # a local run needs no Dask

    return cluster.run(dask, jobs)


def _tell(outcome: Outcome) -> None:
    case = outcome.case
    if case.status != DONE:
        what = f"{case.name}, view {case.view}, {case.method}"
        print(f"sobb: {what}: {case.status}: {case.error}", file=sys.stderr)


def _circumstances(spec: Spec) -> Run:
    return Run(
        host=platform.node(), processor=_processor(), cores=os.cpu_count() or 1,
        sobb_version=sobb.version(), embree_version=None, git_commit=_git_commit(),
        python_version=platform.python_version(), spec=json.dumps(asdict(spec)),
    )  # fmt: skip


def _processor() -> str:
    for line in Path("/proc/cpuinfo").read_text().splitlines():
        if line.startswith("model name"):
            return line.partition(":")[2].strip()
    return platform.machine()


def _git_commit() -> str | None:
    """Returns the commit that this package lies in or was made from; + marks changes to it."""
    made_from = _PACKAGE / "native" / "commit"
    if made_from.is_file():
        return made_from.read_text().strip() or None
    folder = _PACKAGE.parents[1]
    if not (folder / ".git").exists():
        return None
    git = ["git", "-C", str(folder), "describe"]
    options = ["--always", "--abbrev=40", "--dirty=+", "--exclude=*"]
    try:
        described = subprocess.run([*git, *options], capture_output=True, text=True)
    except OSError:
        return None
    return described.stdout.strip() or None
