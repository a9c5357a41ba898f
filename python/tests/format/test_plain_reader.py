# SPDX-License-Identifier: Apache-2.0
"""The library and the reader written from docs/format.md alone agree on every file."""

import random
from pathlib import Path

import numpy as np
import pytest
from plain_reader import Refused, SobbFile, mended
from plain_xxh3 import xxh3_64

import sobb
from sobb import format
from sobb.hierarchy import QUALITIES, STRATEGIES, VOLUMES

GOLDEN = Path(__file__).resolve().parents[3] / "tests" / "golden"
GOOD = sorted((GOLDEN / "good").glob("*.sobb"))
BAD = [line.split(" ", 2) for line in (GOLDEN / "bad" / "expected.txt").read_text().splitlines()]


def agree(data):
    """Asserts that every field of the plain reader equals the library's."""
    plain = SobbFile(data)
    with sobb.Hierarchy.from_bytes(data) as hierarchy:
        parts, info = format.parts(hierarchy.bytes), hierarchy.info
        header, record = parts.header, parts.record
        for name in header.dtype.names:
            value = getattr(plain, name)
            own = np.array(list(value) if name == "magic" else value, header.dtype[name].base)
            assert own.tobytes() == header[name].tobytes(), name
        for name in record.dtype.names:
            value = getattr(plain, "record_reserved" if name == "reserved" else name)
            own = np.array(value, record.dtype[name].base)
            assert own.tobytes() == record[name].tobytes(), name
        assert np.array(plain.directions, "<f4").tobytes() == parts.directions.tobytes()
        assert len(plain.nodes) == len(parts.nodes) == info.nodes
        for node, right in zip(plain.nodes, parts.nodes, strict=True):
            for name in right.dtype.names:
                own = np.array(getattr(node, name), right.dtype[name].base)
                assert own.tobytes() == right[name].tobytes(), name
        assert len(plain.blocks) == len(parts.blocks) == info.blocks
        for block, right in zip(plain.blocks, parts.blocks, strict=True):
            assert np.array(block.vertex, "<f4").tobytes() == right["vertex"].tobytes()
            assert block.primitive == right["primitive"].tolist()
        assert (VOLUMES[info.volume], info.width, info.depth) == (
            plain.volume,
            plain.width,
            plain.depth,
        )
        assert (QUALITIES[info.quality], STRATEGIES[info.strategy]) == (
            plain.quality,
            plain.strategy,
        )
        assert info.leaves == sum(m >> 15 for n in plain.nodes for m in n.meta)
        assert info.source_hash == plain.source_hash
        assert mended(data) == data


def statuses(data):
    """Returns the verdicts of both readers: "OK", or the end of a SOBB_ERROR_FORMAT_ name."""
    try:
        SobbFile(data)
        plain = "OK"
    except Refused as error:
        plain = error.status
    try:
        sobb.Hierarchy.from_bytes(data).close()
        library = "OK"
    except sobb.Error as error:
        library = error.status.name.removeprefix("FORMAT_")
    return plain, library


@pytest.mark.parametrize("path", GOOD, ids=lambda path: path.stem)
def test_agree_on_golden_files(path):
    agree(path.read_bytes())


@pytest.mark.parametrize(("name", "status", "message"), BAD, ids=[name for name, *_ in BAD])
def test_agree_on_bad_files(name, status, message):
    assert statuses((GOLDEN / "bad" / f"{name}.sobb").read_bytes()) == (status, status)


@pytest.mark.parametrize("quality", ["low", "medium", "high"])
@pytest.mark.parametrize("width", [4, 8])
@pytest.mark.parametrize(("volume", "k"), [("aabb", 64), ("sobb", 32), ("sobb", 48), ("sobb", 64)])
def test_agree_on_what_is_built(mesh, volume, k, width, quality):
    vertices, faces = mesh
    with sobb.build(
        vertices, faces[:150], volume=volume, k=k, width=width, quality=quality
    ) as hierarchy:
        agree(bytes(hierarchy.bytes))


def test_agree_on_damage():
    """Bytes are changed at random, and checksums made to fit, so that other rules are reached."""
    seed = 20261123
    print(f"seed {seed}")
    rng = random.Random(seed)
    small = [path.read_bytes() for path in GOOD if path.stat().st_size < 4000]
    values = 0, 1, 2, 4, 8, 31, 0x3F, 0x7F, 0x80, 0xFF
    seen = set()
    for _ in range(600):
        data = bytearray(rng.choice(small))
        for _ in range(rng.randint(1, 3)):
            data[rng.randrange(len(data))] = rng.choice(values)
        data = mended(data)
        plain, library = statuses(data)
        assert plain == library, data.hex()
        seen.add(plain)
    assert len(seen) > 8, seen


def test_checksum_is_the_one_of_the_specification():
    """The lengths lie on both sides of every change of method; the values are libxxhash 0.8's."""
    data = bytes((i * i * 31 + i * 7 + 3) & 255 for i in range(1025))
    expected = {
        0: 0x2D06800538D394C2,
        1: 0x13E608BC156DEFED,
        3: 0xB7391E018153D37A,
        4: 0xFDF480D413C14AB0,
        8: 0xEC39AB64BBDD3E16,
        9: 0xB72B2752390382D5,
        16: 0x2866D96771D12B4E,
        17: 0x385C21B59BF6407D,
        128: 0xA4B9DCA2EE00CE72,
        129: 0xFB9E35F274249234,
        240: 0x4ED2E5C562EAE4C1,
        241: 0x6819923E2201397D,
        1023: 0xDACDD1A09BE419EC,
        1024: 0xEFBB20E87ADC204C,
        1025: 0x99244EE55B2FAE5D,
    }
    assert {n: xxh3_64(data[:n]) for n in expected} == expected
