# SPDX-License-Identifier: Apache-2.0
"""Long calls into the library that report progress, and that an exception or Ctrl-C cancels."""

import threading
from collections.abc import Callable
from typing import Any, TypeVar

from sobb import structs

Result = TypeVar("Result")


def run(call: Callable[[Any], Result], progress: Callable[[float], None] | None = None) -> Result:
    """Runs call(report) to its end; `report` goes into the options of the C call.

    progress: called from time to time, on any thread but never on two at once, with the fraction
        done, 0 to 1. What it raises cancels the call and is raised here. So is the
        KeyboardInterrupt of Ctrl-C.
    """
    stop = threading.Event()
    raised: list[BaseException] = []
    results: list[Result] = []

    @structs.Progress
    def report(_user: int, fraction: float) -> int:
        try:
            if progress is not None:
                progress(fraction)
        except BaseException as error:  # no exception may cross the C library
            raised.append(error)
            return 1
        return int(stop.is_set())

    def finish() -> None:
        try:
            results.append(call(report))
        except BaseException as error:  # what progress raised comes first
            raised.append(error)

    try:
        _run_on_a_thread(finish, stop)
    except _NoThread:
        finish()
    if raised:
        raise raised[0]
    return results[0]


class _NoThread(Exception):
    """No thread can be started, as at the interpreter's end."""


def _run_on_a_thread(work: Callable[[], None], stop: threading.Event) -> None:
    """Runs `work` on a thread of its own, and sets `stop` where waiting for it is interrupted.

    Python sees Ctrl-C only between its own instructions, so the main thread must not be in C. The
    interpreter waits for this thread before it ends, even if its caller is a daemon.
    """
    ended = threading.Event()  # Thread.join() is over too early once Ctrl-C interrupted it

    def run_to_end() -> None:
        try:
            work()
        finally:
            ended.set()

    try:
        threading.Thread(target=run_to_end, name="sobb", daemon=False).start()
    except RuntimeError:
        raise _NoThread from None
    try:
        ended.wait()
    except BaseException:
        stop.set()
        ended.wait()
        raise
