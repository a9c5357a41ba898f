# SPDX-License-Identifier: Apache-2.0
"""Build, load and open at every time of an interpreter's life: in threads that outlive the main
thread, in atexit, in the child of a fork, and cancelled by Ctrl-C."""

import subprocess
import sys
import textwrap

import pytest

import sobb

# Every long call, with progress and without; prints `done` at their end.
CALLS = """
    import sys
    import numpy as np
    import sobb

    def calls():
        triangle = [[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]]
        for progress in (None, lambda fraction: None):
            assert sobb.build(*triangle, progress=progress).info.triangles == 1
            scene = sobb.Scene.load("builtin:city:20000", progress=progress)
            for quality in ("low", "medium"):
                assert sobb.build(scene, quality=quality).info.triangles == len(scene.faces)
            opened = sobb.Hierarchy.open(sys.argv[1], progress=progress)
            rays = np.zeros(10000, sobb.ray_dtype)
            rays["direction"], rays["tmax"] = 1, np.inf
            assert len(opened.intersect(rays)) == 10000

        def refuse(fraction):
            raise LookupError("no more")

        try:
            sobb.build(scene, progress=refuse)
        except LookupError:
            print("done", flush=True)
"""

PLACES = {
    "a thread that outlives the main thread": """
        import threading

        def late():
            threading.main_thread().join()
            calls()

        threading.Thread(target=late).start()
    """,
    "the same, where the main thread had used the library": """
        import threading

        def late():
            threading.main_thread().join()
            calls()

        sobb.build(sobb.Scene.load("builtin:city:20000"))
        threading.Thread(target=late).start()
    """,
    "atexit": """
        import atexit

        atexit.register(calls)
    """,
    "a finalizer": """
        import weakref

        class Owner:
            pass

        owner = Owner()
        weakref.finalize(owner, calls)
    """,
    "the child of a fork": """
        import os

        sobb.build(sobb.Scene.load("builtin:city:20000"))
        child = os.fork()
        if child == 0:
            calls()
        else:
            sys.exit(os.waitpid(child, 0)[1])
    """,
    "the child of a thread's fork": """
        import os
        import threading

        sobb.build(sobb.Scene.load("builtin:city:20000"))
        statuses = []

        def fork():
            child = os.fork()
            if child == 0:
                calls()
                os._exit(0)
            statuses.append(os.waitpid(child, 0)[1])

        thread = threading.Thread(target=fork)
        thread.start()
        thread.join()
        sys.exit(statuses[0])
    """,
}


def run(script, *arguments):
    source = textwrap.dedent(CALLS) + textwrap.dedent(script)
    no_advice = "-Wignore::DeprecationWarning"  # Python warns of forks beside threads
    return subprocess.run(
        [sys.executable, no_advice, "-c", source, *map(str, arguments)],
        check=False,
        capture_output=True,
        text=True,
        timeout=120,
    )


@pytest.mark.parametrize("place", PLACES)
def test_long_calls_in(place, tmp_path, mesh):
    path = tmp_path / "mesh.sobb"
    sobb.build(*mesh).save(path)
    process = run(PLACES[place], path)
    assert (process.stdout, process.stderr, process.returncode) == ("done\n", "", 0)


def test_ctrl_c_cancels_a_build(tmp_path):
    script = """
        import os
        import signal

        pressed = []

        def progress(fraction):
            if not pressed:
                pressed.append(fraction)
                os.kill(os.getpid(), signal.SIGINT)

        signal.signal(signal.SIGINT, signal.default_int_handler)
        try:
            sobb.build(sobb.Scene.load("builtin:city:100000"), progress=progress)
        except KeyboardInterrupt:
            print("cancelled", len(pressed))
    """
    process = run(script)
    assert (process.stdout, process.returncode) == ("cancelled 1\n", 0), process.stderr
