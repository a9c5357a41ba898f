# SPDX-License-Identifier: Apache-2.0
"""Plans the cases of a sweep, each with the program and arguments that measure it."""

import hashlib
import itertools
import json
import re
from collections.abc import Iterator
from dataclasses import asdict, dataclass, replace

from sobb.tools.shared import scenes
from sobb.tools.shared.isa import EMBREE
from sobb.tools.sweep.records import Case
from sobb.tools.sweep.spec import HIERARCHIES, Spec


@dataclass(frozen=True)
class Job:
    """A case to be measured, and how. It may be pickled and measured on another machine."""

    case: Case
    program: str
    arguments: tuple[str, ...]
    time_limit: float
    memory_limit: int


def jobs(spec: Spec) -> list[Job]:
    """Returns all cases, each once. Raises OSError that names the scenes that are missing."""
    sources = scenes.resolve(spec.scenes)
    found = {
        job.case.case_id: job
        for source in sources
        for refined, times in _refined(spec, source)
        for view, method in itertools.product(spec.views, spec.methods)
        for job in _jobs(spec, refined, times, view, method)
    }
    return list(found.values())


def _refined(spec: Spec, source: scenes.Source) -> Iterator[tuple[scenes.Source, int]]:
    """Yields a scene at each subdivision, under one name; at its own alone if it names one."""
    _, own = scenes.unrefined(source.argument)
    if own > 1:
        name, asked = scenes.unrefined(source.name)[0], scenes.unrefined(source.asked)[0]
        yield scenes.Source(source.argument, name, asked), own
        return
    for times in spec.subdivisions:
        yield replace(source, argument=scenes.refined(source.argument, times)), times


def _jobs(spec: Spec, source: scenes.Source, times: int, view: int, method: str) -> Iterator[Job]:
    options = itertools.product(
        spec.k, spec.strategy, spec.table, spec.quality, spec.width, spec.isa, spec.threads
    )
    for k, strategy, table, quality, width, isa, threads in options:
        case = Case(
            "", source.asked, source.name, times, view, method,
            k, strategy, table, quality, width, isa, threads,
        )  # fmt: skip
        if method == "embree":
            if quality == "low":
                continue  # sobb_bench measures Embree's medium and high builds
            case = replace(case, k=None, strategy=None, table_kind=None, width=None)
        elif method == "aabb":
            case = replace(case, k=None, strategy=None, table_kind=None)
        elif method != "sobb":
            case = _volume_case(case)
        yield _job(spec, source, replace(case, case_id=_case_id(spec, case)))


def _volume_case(case: Case) -> Case:
    """Sets the options of a research volume: its own k, a hierarchy of medium quality, 8 wide."""
    k = re.search(r"sobb(\d+)", case.method)
    chosen = case.strategy if re.search(r"[di]$", case.method) and k else None
    return replace(
        case, k=int(k[1]) if k else None, strategy="k2" if k and not chosen else chosen,
        table_kind=None, quality="medium", width=8,
    )  # fmt: skip


def _case_id(spec: Spec, case: Case) -> str:
    """Returns an id that depends on what is measured alone, not on when or where."""
    named = {key: value for key, value in asdict(case).items() if key != "case_id"}
    named |= {key: getattr(spec, key) for key in ("cameras", "size", "repetitions", "min_time")}
    named |= {"rays": sorted(spec.rays), "calls": sorted(spec.calls)}
    return hashlib.sha256(json.dumps(named, sort_keys=True).encode()).hexdigest()[:16]


def _job(spec: Spec, source: scenes.Source, case: Case) -> Job:
    arguments = [
        f"--scene={source.argument}",
        f"--view={case.view}",
        f"--size={spec.size}",
        f"--threads={case.threads}",
        f"--isa={case.isa}",
    ]
    if spec.cameras:
        arguments.append(f"--cameras={spec.cameras}")
    if case.method in HIERARCHIES:
        program, more = "sobb_bench", _hierarchy_arguments(spec, case)
    else:
        program, more = "sobb_bench_volumes", _volume_arguments(spec, case)
    return Job(case, program, (*arguments, *more), spec.time_limit, spec.memory_limit)


def _hierarchy_arguments(spec: Spec, case: Case) -> list[str]:
    row = f"embree_{case.quality}" if case.method == "embree" else case.method
    traced = f"({'|'.join(spec.rays)})/{row}/({'|'.join(spec.calls)})"
    arguments = [
        f"--benchmark_filter=^(build/{row}|{traced})(/|$)",
        f"--benchmark_repetitions={spec.repetitions}",
        f"--benchmark_min_time={spec.min_time}",
    ]
    options = {"k": case.k, "strategy": case.strategy, "table": case.table_kind}
    options |= {"width": case.width, "quality": case.quality}
    arguments += [f"--{key}={value}" for key, value in options.items() if value is not None]
    if case.method == "embree" and case.isa in EMBREE:
        arguments.append(f"--embree-isa={EMBREE[case.isa]}")
    return arguments


def _volume_arguments(spec: Spec, case: Case) -> list[str]:
    rays = {"primary": "primary", "diffuse7": "secondary"}
    rows = ["overhead", *(rays[name] for name in spec.rays if name in rays)]
    return [
        f"--benchmark_filter=^({'|'.join(rows)})/{case.method}/",
        "--layout=wide",
        f"--strategy={case.strategy or 'k2'}",
        f"--cell-seconds={spec.min_time * spec.repetitions}",
    ]
