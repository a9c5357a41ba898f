# SPDX-License-Identifier: Apache-2.0
"""Makes files of results for tests of the report: any methods and scenes, one of a hostile name."""

import random

from sobb.tools.sweep.store import Store

HOSTILE = "<img src=x onerror=alert(1)>"
# Method -> its options k, strategy, table_kind; its speed and its build time over those of AABBs.
METHODS = {
    "aabb": (None, None, None, 1.0, 1.0),
    "sobb": (64, "k2", "fitted", 1.5, 1.25),
    "embree": (None, None, None, 0.9, 1.5),
}
SCENES = ("builtin:hairball:2000", "builtin:city:2000", f"/missing/{HOSTILE}.glb")
RAYS = {"primary": 20.0, "diffuse1": 8.0}  # their speeds with AABBs
CALLS = ("single", "array")
FAILURES = {"crashed": "signal 11 <script>alert(2)</script>", "timeout": "gave up after 60 s"}


def write(path, methods=METHODS, scenes=SCENES, failures=FAILURES):
    """Writes results of each scene, at 1 and 4 times its triangles, with each method.

    The three repetitions differ by a few per cent.
    """
    made = random.Random(7)
    cases, samples = [], []
    for scene in scenes:
        name = scene.removeprefix("builtin:").removeprefix("/missing/").split(":")[0]
        for subdivision in (1, 4):
            for method, (k, strategy, table, speed, build) in methods.items():
                case = f"{name}-{subdivision}-{method}"
                options = (k, strategy, table, "medium", 8 if method != "embree" else None)
                what = (case, 1, scene, name, 2000 * subdivision, subdivision, 0, method)
                how = ("avx2", 1, "done", None, 2.5, "host", "2026-01-02 03:05:00")
                cases.append((*what, *options, *how))
                for repetition in range(3):
                    noise = made.uniform(0.98, 1.02)

                    def add(metric, value, rays=None, call=None, at=(case, repetition)):
                        samples.append((at[0], rays, call, metric, at[1], value))

                    add("build_ms", 10 * subdivision * build * noise)
                    add("area_inner", 30 / speed)
                    for rays, base in RAYS.items():
                        for call in CALLS:
                            add("mrays_s", base * speed / subdivision**0.2 * noise, rays, call)
                        if method != "embree":
                            add("volumes_per_ray", 50 / speed, rays, "single")
    for status, error in failures.items():
        what = (status, 1, "builtin:wool:9", "wool", None, 1, 0, "sobb", 64, "k2", "fitted")
        cases.append((*what, "medium", 8, "avx2", 1, status, error, 60.0, "host", None))
    with Store(path) as store:
        database = store.connection
        database.execute(
            "INSERT INTO runs VALUES (1, '2026-01-02 03:04:05', '2026-01-02 04:00:00', 'host', "
            "'A & B', 2, '0.1.0', '3.13.5', 'abc1234', '3.11.2', '{\"scenes\": []}')"
        )
        for table, rows in (("cases", cases), ("samples", samples)):
            if rows:
                marks = ", ".join("?" * len(rows[0]))
                database.executemany(f"INSERT INTO {table} VALUES ({marks})", rows)
