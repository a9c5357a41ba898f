# SPDX-License-Identifier: Apache-2.0
"""The command line: collects the commands, runs the one that was asked for, tells its failure.

Exit codes: 0 done, 1 failed (the cause is on stderr), 2 wrong usage,
3 something got slower (compare).
"""

import argparse
import os
import sys
from collections.abc import Mapping, Sequence

import sobb
from sobb.tools import build, info, validate
from sobb.tools.command import Command
from sobb.tools.compare import command as compare
from sobb.tools.demo import command as demo
from sobb.tools.paper import command as paper
from sobb.tools.peers import command as peers
from sobb.tools.render import command as render
from sobb.tools.report import command as report
from sobb.tools.sweep import command as sweep

#: The commands by name, in the order of the help.
COMMANDS: Mapping[str, Command] = {
    "build": build,
    "info": info,
    "validate": validate,
    "render": render,
    "demo": demo,
    "paper": paper,
    "peers": peers,
    "report": report,
    "sweep": sweep,
    "compare": compare,
}


def main(arguments: Sequence[str] | None = None) -> int:
    """Runs one command; returns its exit code (wrong usage exits with 2 by itself)."""
    options = _parser().parse_args(arguments)
    command = COMMANDS[options.command]
    try:
        code = command.run(options)
        sys.stdout.flush()
        return code or 0
    except BrokenPipeError:
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())  # nobody reads on
        return 1
    except KeyboardInterrupt:
        return _fail("interrupted")
    except MemoryError:
        return _fail("out of memory")
    except ModuleNotFoundError as error:
        return _fail(f"{error}: install what this command needs, the extra sobb[{command.EXTRA}]")
    except (sobb.Error, OSError, ValueError) as error:
        return _fail(str(error))


def _fail(message: str) -> int:
    print(f"sobb: {message}", file=sys.stderr)
    return 1


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(prog="sobb", description=sobb.__doc__.split("\n")[0])
    subparsers = parser.add_subparsers(required=True, metavar="COMMAND", dest="command")
    for name, command in COMMANDS.items():
        description = f"{command.HELP[0].upper()}{command.HELP[1:]}."
        command.add_arguments(
            subparsers.add_parser(name, help=command.HELP, description=description)
        )
    return parser
