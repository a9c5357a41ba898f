# SPDX-License-Identifier: Apache-2.0
"""`python -m sobb`."""

import sys

from sobb.cli import main

sys.exit(main())
