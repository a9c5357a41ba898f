# SPDX-License-Identifier: Apache-2.0
"""The entry point of `python -m sobb`."""

import sys

from sobb.tools.cli import main

sys.exit(main())
