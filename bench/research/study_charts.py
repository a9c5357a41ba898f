#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Turns sobb_study's answers, docs/data/study-*.json, into charts and tables of docs/study.md.

A developer's tool; needs Matplotlib. Charts: docs/images/study-QUESTION.svg. Tables are printed.
"""

import argparse
import json
import pathlib
import sys
from collections.abc import Sequence

from charts import areas, clipping, sharing, tables, topologies

ROOT = pathlib.Path(__file__).resolve().parents[2]
QUESTIONS = {
    "areas": areas.draw,
    "tables": tables.draw,
    "clipping": clipping.draw,
    "sharing": sharing.draw,
    "topologies": topologies.draw,
}


def main(arguments: Sequence[str] | None = None) -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("questions", nargs="*", metavar="QUESTION", help=", ".join(QUESTIONS))
    parser.add_argument("--data", type=pathlib.Path, default=ROOT / "docs/data")
    parser.add_argument("--images", type=pathlib.Path, default=ROOT / "docs/images")
    parser.add_argument("--format", choices=("svg", "png"), default="svg")
    chosen = parser.parse_args(arguments)
    for question in chosen.questions or QUESTIONS:
        if question not in QUESTIONS:
            parser.error(f"no question {question}; there are {', '.join(QUESTIONS)}")
        data = chosen.data / f"study-{question}.json"
        report = json.loads(data.read_text(encoding="utf-8"))
        QUESTIONS[question](report, chosen.images / f"study-{question}.{chosen.format}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
