# SPDX-License-Identifier: Apache-2.0
"""Makes a small file of results with made-up figures, always the same, for tests of readers."""

import itertools
import json
from datetime import datetime
from pathlib import Path

import numpy as np

from sobb.tools.sweep.records import FAILED, Case, Run, Sample
from sobb.tools.sweep.store import Store

SCENES = {"builtin:hairball:2000": 2000, "builtin:pipes:2000": 2016, "builtin:city:2000": 1990}
METHODS = {"aabb": 1.0, "sobb": 1.4, "embree": 1.1}
SUBDIVISIONS = (1, 4)
RAYS = ("primary", "diffuse1")
CALLS = ("single", "array")
REPETITIONS = 5


def write(path: Path, speed: float = 1.0, noise: float = 0.02, seed: int = 7) -> Path:
    """Writes results of three scenes, three methods and two subdivisions, and one failed case.

    speed: multiplies all rays per second.
    noise: the relative standard deviation of the samples.
    """
    rng = np.random.default_rng(seed)
    run = Run(
        "example", "Example CPU", 8, "0.1.0", "3.13.5", "0" * 40, "3.11.7",
        json.dumps({"scenes": list(SCENES)}),
    )  # fmt: skip
    with Store(path) as store:
        run_id = store.begin_run(run)
        for i, (scene, times, method) in enumerate(
            itertools.product(SCENES, SUBDIVISIONS, METHODS)
        ):
            case = _case(f"case{i:02}", scene, times, method)
            store.add(run_id, case, _samples(case, i // len(METHODS), speed, noise, rng))
        bad = _case("failed", "builtin:city:2000", 16, "sobb", FAILED, "memory limit")
        store.add(run_id, bad, [])
        store.end_run(run_id)
    return path


def _case(case_id, scene, times, method, status="done", error=None) -> Case:
    ours = method != "embree"
    return Case(
        case_id=case_id, scene=scene, name=scene.split(":")[1], subdivision=times, view=0,
        method=method, k=64 if ours else None, strategy="k2" if method == "sobb" else None,
        table_kind="fitted" if method == "sobb" else None, quality="medium",
        width=8 if ours else None, isa="avx2", threads=1, triangles=SCENES[scene] * times,
        status=status, error=error, seconds=1.5, host="example",
        finished=datetime(2026, 11, 23, 8, 0),
    )  # fmt: skip


def _samples(case: Case, group: int, speed: float, noise: float, rng) -> list[Sample]:
    base = METHODS[case.method] * speed * (4 + group) / case.subdivision**0.3
    samples = [
        Sample(rays, call, "mrays_s", i, base * (1 + noise * rng.standard_normal()))
        for rays in RAYS
        for call in CALLS
        for i in range(REPETITIONS)
    ]
    built = {"build_ms": 20.0 * case.subdivision, "bytes_per_triangle": 64.0}
    if case.method != "embree":
        built |= {"area_inner": 30 / METHODS[case.method], "area_leaves": 20.0}
        counts = {"nodes_per_ray": 8.0, "volumes_per_ray": 60.0, "triangles_per_ray": 9.0}
        samples += [
            Sample(rays, "single", metric, i, value / METHODS[case.method])
            for rays in RAYS
            for metric, value in counts.items()
            for i in range(REPETITIONS)
        ]
    samples += [
        Sample(None, None, metric, i, value)
        for metric, value in built.items()
        for i in range(REPETITIONS)
    ]
    return samples
