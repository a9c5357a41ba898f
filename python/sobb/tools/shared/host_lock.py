# SPDX-License-Identifier: Apache-2.0
"""One measurement at a time on a machine: processes of a user take turns."""

import fcntl
import os
from collections.abc import Iterator
from contextlib import contextmanager

# Not the environment's folder for such files: two workers may have different environments.
_PATH = f"/tmp/sobb-measuring-{os.getuid()}.lock"


@contextmanager
def turn() -> Iterator[int]:
    """Waits for the turn; yields the lock's descriptor. A child that inherits it keeps the turn
    while it lives, even where its parent was killed."""
    flags = os.O_RDWR | os.O_CREAT | os.O_NOFOLLOW | os.O_CLOEXEC
    descriptor = os.open(_PATH, flags, 0o600)
    try:
        fcntl.flock(descriptor, fcntl.LOCK_EX)
        yield descriptor
    finally:
        os.close(descriptor)
