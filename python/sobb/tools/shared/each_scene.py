# SPDX-License-Identifier: Apache-2.0
"""Measures scene after scene; one that fails does not stop the others."""

import sys
from collections.abc import Callable, Sequence

from sobb.tools.shared import bench
from sobb.tools.shared.progress import bar
from sobb.tools.shared.scenes import Source


def run(
    sources: Sequence[Source],
    measure: Callable[[Source], bench.Report],
    done: Callable[[Source, bench.Report], None],
    summary: Callable[[], None],
) -> None:
    """Measures each scene and hands its report to `done`; calls `summary` after the last.

    A scene that fails is reported on stderr; OSError is raised at the end then.
    """
    failed: list[str] = []
    for i, source in enumerate(sources):
        with bar(f"{source.argument} ({i + 1} of {len(sources)})") as progress:
            progress(i / len(sources))
            try:
                report = measure(source)
            except OSError as error:
                print(f"sobb: {source.argument}: {error}", file=sys.stderr)
                failed.append(source.argument)
                continue
        done(source, report)
    summary()
    if failed:
        raise OSError(f"{len(failed)} of {len(sources)} scenes failed: {', '.join(failed)}")
