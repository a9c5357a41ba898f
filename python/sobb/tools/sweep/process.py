# SPDX-License-Identifier: Apache-2.0
"""Runs a program in a process group of its own, under limits of time and memory."""

import os
import shutil
import signal
import subprocess
import time
from collections.abc import Sequence
from pathlib import Path

from sobb.tools.sweep.records import CRASHED, DONE, FAILED, MEMORY, TIMEOUT

_LOOK_SECONDS = 0.1
_PAGE = os.sysconf("SC_PAGE_SIZE")


def run(
    command: Sequence[str], folder: Path, time_limit: float, memory_limit: int, keep: int
) -> tuple[str, str | None]:
    """Runs a command; returns its status, and its last line where it failed.

    folder: takes the file with what the command prints on stderr.
    time_limit: in seconds. memory_limit: the MiB that the command may hold.
    keep: a descriptor that the command inherits.

    No process of the group outlives this call. If this process is killed, the command dies with it
    where `setpriv` is installed.
    """
    if shutil.which("setpriv"):
        command = ["setpriv", "--pdeathsig", "KILL", *command]
    said = folder / "said"
    with open(said, "wb") as output:
        process = subprocess.Popen(
            command, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=output,
            start_new_session=True, pass_fds=(keep,),
        )  # fmt: skip
    try:
        beyond = _watch(process, time_limit, memory_limit)
    finally:
        _kill(process)
    if beyond is not None:
        return beyond
    if process.returncode == 0:
        return DONE, None
    if process.returncode < 0:
        return CRASHED, f"ended by {signal.Signals(-process.returncode).name}"
    last = said.read_text(errors="replace").strip().splitlines()[-1:]
    return FAILED, "".join(last) or f"exit code {process.returncode}"


def _watch(
    process: subprocess.Popen[bytes], time_limit: float, memory_limit: int
) -> tuple[str, str] | None:
    """Waits for the end, and returns None; or until a limit is passed, and returns which."""
    end = time.monotonic() + time_limit
    while True:
        try:
            process.wait(min(_LOOK_SECONDS, max(0, end - time.monotonic())))
            return None
        except subprocess.TimeoutExpired:
            if time.monotonic() >= end:
                return TIMEOUT, f"longer than {time_limit:g} s"
            if _resident(process.pid) > memory_limit << 20:
                return MEMORY, f"more than {memory_limit} MiB"


def _resident(pid: int) -> int:
    try:
        return int(Path(f"/proc/{pid}/statm").read_text().split()[1]) * _PAGE
    except OSError:
        return 0


def _kill(process: subprocess.Popen[bytes]) -> None:
    try:
        os.killpg(process.pid, signal.SIGKILL)
    except ProcessLookupError:
        pass
    process.wait()
