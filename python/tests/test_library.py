# SPDX-License-Identifier: Apache-2.0
"""Where the libraries and programs are looked for, and what is said of modules that are missing."""

import sys

import pytest

from sobb import bench, cli, library


@pytest.fixture
def places(tmp_path, monkeypatch):
    """The folders of a wheel and of a checkout, of which neither has a library yet."""
    wheel, checkout = tmp_path / "native" / "lib", tmp_path / "build" / "lib"
    wheel.mkdir(parents=True)
    checkout.mkdir(parents=True)
    monkeypatch.delenv("SOBB_LIBRARY_PATH", raising=False)
    monkeypatch.setattr(library, "_FOLDERS", (wheel, checkout))
    return wheel, checkout


def test_folders_in_their_order(places, tmp_path, monkeypatch):
    wheel, checkout = places
    assert library.folder() is None
    for folder in (checkout, wheel):
        (folder / "libsobb.so.0").touch()
        assert library.folder() == folder
    monkeypatch.setenv("SOBB_LIBRARY_PATH", str(tmp_path / "named"))
    assert library.folder() == tmp_path / "named"
    monkeypatch.setenv("SOBB_LIBRARY_PATH", "")
    assert library.folder() == wheel


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


def test_a_command_says_which_extra_it_needs(capsys, monkeypatch):
    monkeypatch.setitem(sys.modules, "PIL", None)
    assert cli.main(["render", "builtin:city:100", "-o", "unused.png"]) == 1
    assert "sobb[commands]" in capsys.readouterr().err
