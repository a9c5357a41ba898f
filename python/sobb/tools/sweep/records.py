# SPDX-License-Identifier: Apache-2.0
"""The rows of the store: a run, a case, a sample. Their members are the columns of the tables."""

from dataclasses import dataclass
from datetime import datetime

DONE, FAILED, TIMEOUT, MEMORY, CRASHED = "done", "failed", "timeout", "memory", "crashed"


@dataclass(frozen=True)
class Run:
    """One call of the command: its machine and its versions.

    `spec` is the sweep as JSON, with all defaults filled in.
    """

    host: str
    processor: str
    cores: int
    sobb_version: str
    embree_version: str | None
    git_commit: str | None
    python_version: str
    spec: str


@dataclass(frozen=True)
class Case:
    """What one process measured, and how it ended. An option without meaning is None."""

    case_id: str
    scene: str
    name: str
    subdivision: int
    view: int
    method: str
    k: int | None = None
    strategy: str | None = None
    table_kind: str | None = None
    quality: str | None = None
    width: int | None = None
    isa: str | None = None
    threads: int | None = None
    triangles: int | None = None
    status: str = DONE
    error: str | None = None
    seconds: float | None = None
    host: str | None = None
    finished: datetime | None = None


@dataclass(frozen=True)
class Sample:
    """One repetition of one figure. Without rays and call it is a figure of the build."""

    rays: str | None
    call: str | None
    metric: str
    repetition: int
    value: float
