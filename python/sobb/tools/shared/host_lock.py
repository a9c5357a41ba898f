# SPDX-License-Identifier: Apache-2.0
"""A lock that lets a user's processes measure one at a time on a machine."""

import fcntl
import os
from collections.abc import Iterator
from contextlib import contextmanager

# TMPDIR is not asked, since two workers may have different environments.
_PATH = f"/tmp/sobb-measuring-{os.getuid()}.lock"


@contextmanager
def turn() -> Iterator[int]:
    """Waits for the lock; yields its descriptor.

    A child that inherits the descriptor holds the lock while it lives, even if its parent is
    killed.
    """
    flags = os.O_RDWR | os.O_CREAT | os.O_NOFOLLOW | os.O_CLOEXEC
    descriptor = os.open(_PATH, flags, 0o600)
    try:
        fcntl.flock(descriptor, fcntl.LOCK_EX)
        yield descriptor
    finally:
        os.close(descriptor)
