# SPDX-License-Identifier: Apache-2.0
"""Where the benchmark programs are looked for."""

import pytest

from sobb.tools.shared import bench


def test_programs_lie_beside_the_libraries(places, tmp_path, monkeypatch):
    wheel, _ = places
    monkeypatch.setenv("PATH", str(tmp_path))
    with pytest.raises(OSError, match="no sobb_bench in PATH"):
        bench.find_program("sobb_bench")
    (wheel / "libsobb.so.0").touch()
    with pytest.raises(OSError, match="native/bin nor in PATH"):
        bench.find_program("sobb_bench")
    for folder in (tmp_path, wheel.parent / "bin"):
        folder.mkdir(exist_ok=True)
        program = folder / "sobb_bench"
        program.touch(mode=0o755)
        assert bench.find_program("sobb_bench") == program
