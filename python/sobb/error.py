# SPDX-License-Identifier: Apache-2.0
"""The exception that a failed call of the library raises."""

from enum import IntEnum


class Status(IntEnum):
    """sobb_status: how a call ended. sobb.h says what each value means."""

    OK = 0
    INVALID_ARGUMENT = 1
    EMPTY = 2
    INDEX = 3
    NOT_FINITE = 4
    TOO_LARGE = 5
    OUT_OF_MEMORY = 6
    MEMORY_LIMIT = 7
    CANCELLED = 8
    UNSUPPORTED_CPU = 9
    INTERNAL = 10
    FILE_OPEN = 20
    FILE_READ = 21
    FILE_WRITE = 22
    FORMAT_MAGIC = 30
    FORMAT_VERSION = 31
    FORMAT_FEATURE = 32
    FORMAT_SIZE = 33
    FORMAT_HEADER = 34
    FORMAT_SECTION = 35
    FORMAT_CHECKSUM = 36
    FORMAT_TABLE = 37
    FORMAT_NODE = 38
    FORMAT_REFERENCE = 39
    FORMAT_DEPTH = 40
    FORMAT_TRIANGLE = 41
    FORMAT_RECORD = 42
    SCENE_FORMAT = 60
    SCENE_SYNTAX = 61
    SCENE_UNSUPPORTED = 62
    SCENE_REFERENCE = 63


class Error(Exception):
    """A call of the library failed.

    `status` is a Status, or an int where a later library has one that this module lacks. The text
    is the library's own, and names file, place and cause.
    """

    def __init__(self, status: int, message: str):
        super().__init__(message)
        try:
            self.status: int = Status(status)
        except ValueError:
            self.status = status

    def __reduce__(self):
        return Error, (int(self.status), str(self))
