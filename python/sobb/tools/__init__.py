# SPDX-License-Identifier: Apache-2.0
"""The command line, `python -m sobb`. A library user imports `sobb`, which needs none of this.

A command with more than one file has a room of its own, whose `command.py` declares its arguments.
What several commands use lies in `shared`.
"""
