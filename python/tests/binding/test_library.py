# SPDX-License-Identifier: Apache-2.0
"""Where the libraries are looked for, and in which order."""

from sobb import library


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
