# SPDX-License-Identifier: Apache-2.0
"""Measures cases on the workers of a Dask cluster; each result comes back as soon as it is done.

A worker builds and measures by itself, with the programs of its own installation. It finds a scene
at the same path as the client, so cluster and client have to share their folders.
"""

from collections.abc import Iterator, Sequence
from dataclasses import replace

from sobb.tools.sweep import measure
from sobb.tools.sweep.measure import Outcome
from sobb.tools.sweep.plan import Job
from sobb.tools.sweep.records import CRASHED, FAILED

_CONNECT_SECONDS = 10


def run(address: str, jobs: Sequence[Job]) -> Iterator[Outcome]:
    """Measures jobs on the workers of the scheduler at `address`.

    A case whose worker dies goes to another one; after as many deaths as the scheduler allows, its
    status is CRASHED. Raises OSError where there is no scheduler.
    """
    from distributed import Client, KilledWorker, as_completed

    try:
        client = Client(address, timeout=_CONNECT_SECONDS)
    except (OSError, ValueError) as error:
        raise OSError(f"{address}: no Dask scheduler there: {error}") from None
    with client:
        futures = {client.submit(measure.measure, job, pure=False): job for job in jobs}
        for future in as_completed(list(futures)):
            job, failure = futures.pop(future), future.exception()
            if failure is None:
                yield future.result()
                continue
            status = CRASHED if isinstance(failure, KilledWorker) else FAILED
            yield Outcome(replace(job.case, status=status, error=f"on a worker: {failure}"), [])
