# SPDX-License-Identifier: Apache-2.0
"""Long calls into the library that report progress, and that an exception or Ctrl-C cancels."""

import threading
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from typing import Any, TypeVar

from sobb import structs

Result = TypeVar("Result")


def run(call: Callable[[Any], Result], progress: Callable[[float], None] | None = None) -> Result:
    """Runs call(report) on another thread; `report` goes into the options of the C call.

    progress: called from time to time, on that thread, with the fraction done, 0 to 1. What it
        raises cancels the call and is raised here. So is the KeyboardInterrupt of Ctrl-C.
    """
    stop = threading.Event()
    raised: list[BaseException] = []

    @structs.Progress
    def report(_user: int, fraction: float) -> int:
        try:
            if progress is not None:
                progress(fraction)
        except BaseException as error:  # no exception may cross the C library
            raised.append(error)
            return 1
        return int(stop.is_set())

    # Python sees Ctrl-C only between its own instructions, so this thread must not be in C.
    with ThreadPoolExecutor(1) as worker:
        try:
            return worker.submit(call, report).result()
        except BaseException as error:
            stop.set()
            raise (raised[0] if raised else error) from None
