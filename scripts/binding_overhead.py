#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Measures what the Python binding costs (docs/measuring.md).

A million rays are traced through the binding and by the same call in C, in turns, in one process;
then a hierarchy is pickled.

usage: .venv/bin/python scripts/binding_overhead.py [REPETITIONS]
"""

import pickle
import sys
import time
from collections.abc import Callable
from ctypes import byref
from statistics import median

import numpy as np

import sobb
from sobb import library, structs
from sobb import rays as make

SIDE = 1000


def seconds(call: Callable[[], object], clock: Callable[[], float]) -> float:
    start = clock()
    result = call()
    end = clock()
    del result  # freeing memory is not timed
    return end - start


def tracing(scene: sobb.Scene, coherent: bool, repetitions: int) -> None:
    """Prints the processor time of closest hits on one thread, and its ratio to the C call's."""
    hierarchy, info = sobb.build(scene), scene.info
    if coherent:
        rays, _ = make.primary(scene.views[0], SIDE, SIDE)
    else:
        rays = make.random_in_box(info.bounds_min, info.bounds_max, SIDE * SIDE, 1)
    out = np.zeros(len(rays), sobb.hit_dtype)

    def in_c() -> None:
        options = structs.TraceOptions(flags=int(coherent), threads=1)
        handle, to = hierarchy.handle, out.ctypes.data
        call = library.core().sobb_intersect
        assert call(handle, rays.ctypes.data, rays.size, to, byref(options)) == 0

    ways: dict[str, Callable[[], object]] = {
        "in C": in_c,
        "intersect": lambda: hierarchy.intersect(rays, coherent, threads=1),
        "intersect, out=": lambda: hierarchy.intersect(rays, coherent, threads=1, out=out),
    }
    times: dict[str, list[float]] = {name: [] for name in ways}
    for _ in range(repetitions):
        for name, call in ways.items():
            times[name].append(seconds(call, time.process_time))
    for name, of_way in times.items():
        ratio = median(t / c for t, c in zip(of_way, times["in C"], strict=True))
        print(f"  {name:18}{median(of_way) * 1e3:8.1f} ms{ratio:8.3f}")


def pickling(scene: sobb.Scene, repetitions: int) -> None:
    """Prints how many gigabytes of hierarchy are pickled per second, by the wall clock."""
    hierarchy = sobb.build(scene)
    size = hierarchy.info.bytes
    print(f"pickling, {size / 1e6:.0f} MB")
    buffers: list[pickle.PickleBuffer] = []
    apart = pickle.dumps(hierarchy, 5, buffer_callback=buffers.append)
    whole = {protocol: pickle.dumps(hierarchy, protocol) for protocol in (4, 5)}
    ways: dict[str, Callable[[], object]] = {
        "dumps, protocol 4": lambda: pickle.dumps(hierarchy, 4),
        "dumps, protocol 5": lambda: pickle.dumps(hierarchy, 5),
        "loads, protocol 4": lambda: pickle.loads(whole[4]),
        "loads, protocol 5": lambda: pickle.loads(whole[5]),
        "loads, out of band": lambda: pickle.loads(apart, buffers=buffers),
    }
    for name, call in ways.items():
        rate = size / median(seconds(call, time.perf_counter) for _ in range(repetitions))
        print(f"  {name:18}{rate / 1e9:8.2f} GB/s")


def main() -> None:
    repetitions = int(sys.argv[1]) if len(sys.argv) > 1 else 15
    for name, coherent in (("builtin:hairball", False), ("builtin:city", True)):
        print(f"{name}, {SIDE * SIDE:,} {'primary, coherent' if coherent else 'random'} rays")
        with sobb.Scene.load(name) as scene:
            tracing(scene, coherent, repetitions)
    with sobb.Scene.load("builtin:hairball:2000000") as scene:
        pickling(scene, repetitions)


if __name__ == "__main__":
    main()
