# SPDX-License-Identifier: Apache-2.0
"""Fixtures for all tests: a small mesh, its hierarchies, rays around it, the command line."""

import signal
import subprocess
import sys

import numpy as np
import pytest

import sobb
from sobb import library
from sobb import rays as make

SEED = 20250607

# A shell's background jobs ignore interrupts, and so do the processes that they start: tests that
# interrupt a command would wait for its end.
signal.signal(signal.SIGINT, signal.default_int_handler)


@pytest.fixture(scope="session")
def rng():
    """A generator of random numbers; a failing test prints its seed."""
    print(f"seed {SEED}")
    return np.random.default_rng(SEED)


@pytest.fixture(scope="session")
def mesh(rng):
    """500 thin triangles at all angles: (vertices, faces)."""
    centre = rng.uniform(-1, 1, (500, 1, 3))
    vertices = (centre + rng.normal(0, 0.1, (500, 3, 3))).astype(np.float32).reshape(-1, 3)
    return vertices, np.arange(1500, dtype=np.uint32).reshape(-1, 3)


@pytest.fixture(scope="session", params=["aabb", "sobb"])
def hierarchy(request, mesh):
    return sobb.build(*mesh, volume=request.param)


@pytest.fixture(scope="session")
def rays(rng):
    """2,000 rays between random points of the box of the mesh."""
    return make.random_in_box((-1, -1, -1), (1, 1, 1), 2000, SEED)


@pytest.fixture
def cli():
    """A function that runs `python -m sobb` with arguments, and returns the finished process."""

    def run(*arguments):
        command = [sys.executable, "-m", "sobb", *map(str, arguments)]
        return subprocess.run(command, check=False, capture_output=True, text=True, timeout=120)

    return run


@pytest.fixture
def folder(tmp_path, monkeypatch):
    """A folder of scenes, and SOBB_SCENES naming it."""
    folder = tmp_path / "scenes"
    folder.mkdir()
    for name in ("crown.glb", "a b.glb", "other.obj"):
        (folder / name).touch()
    monkeypatch.setenv("SOBB_SCENES", str(folder))
    return folder


@pytest.fixture
def places(tmp_path, monkeypatch):
    """The folders of a wheel and of a checkout, neither of which has a library yet."""
    wheel, checkout = tmp_path / "native" / "lib", tmp_path / "build" / "lib"
    wheel.mkdir(parents=True)
    checkout.mkdir(parents=True)
    monkeypatch.delenv("SOBB_LIBRARY_PATH", raising=False)
    monkeypatch.setattr(library, "_FOLDERS", (wheel, checkout))
    return wheel, checkout
