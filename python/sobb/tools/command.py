# SPDX-License-Identifier: Apache-2.0
"""The members that make a module a command.

The command line imports the modules of all commands at every start. They therefore import what a
command works with, and above all the packages of its extra, in `run` alone.
"""

from argparse import ArgumentParser, Namespace
from typing import Protocol


class Command(Protocol):
    """A command; a module is one when it has these members."""

    @property
    def HELP(self) -> str:
        """What the command does: a phrase that begins with a verb in lower case."""

    @property
    def EXTRA(self) -> str:
        """The extra of the package that brings what the command imports."""

    def add_arguments(self, parser: ArgumentParser, /) -> None:
        """Declares the command's arguments."""

    def run(self, options: Namespace, /) -> int | None:
        """Does the command's work; returns its exit code, None for 0."""
