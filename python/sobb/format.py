# SPDX-License-Identifier: Apache-2.0
"""The parts of a .sobb file (docs/format.md, version 1) as NumPy arrays, without copies.

The bytes must be those of Hierarchy.bytes, which the library proved to be a valid file: nothing is
proved here.
"""

from typing import Any, NamedTuple

import numpy as np

LANES = 4  # triangles per block
NO_PRIMITIVE = 0xFFFFFFFF

header_dtype = np.dtype(
    [
        ("magic", "u1", 8),
        ("version", "<u4"),
        ("header_size", "<u4"),
        ("total_size", "<u8"),
        ("header_checksum", "<u8"),
        ("must_understand", "<u4"),
        ("ignorable", "<u4"),
        ("volume", "<u4"),
        ("width", "<u4"),
        ("direction_count", "<u4"),
        ("section_count", "<u4"),
        ("depth", "<u4"),
        ("reserved0", "<u4"),
        ("centre", "<f4", 3),
        ("radius", "<f4"),
        ("triangle_count", "<u8"),
        ("reserved1", "<u8", 5),
    ]
)

section_dtype = np.dtype(
    [
        ("id", "<u4"),
        ("reserved", "<u4"),
        ("offset", "<u8"),
        ("size", "<u8"),
        ("checksum", "<u8"),
    ]
)

#: Four triangles: vertex[corner, axis, lane] in the input's coordinates, primitive[lane].
block_dtype = np.dtype([("vertex", "<f4", (3, 3, LANES)), ("primitive", "<u4", LANES)])

record_dtype = np.dtype(
    [
        ("quality", "<u4"),
        ("strategy", "<u4"),
        ("degenerate_count", "<u8"),
        ("reference_count", "<u8"),
        ("source_hash", "<u8"),
        ("bounds_min", "<f4", 3),
        ("bounds_max", "<f4", 3),
        ("reserved", "<u4", 2),
    ]
)


def node_dtype(width: int) -> np.dtype:
    """Returns the type of a node: slab[j, side, child]; reference, basis and meta [child]."""
    return np.dtype(
        [
            ("slab", "<f4", (3, 2, width)),
            ("reference", "<u4", width),
            ("basis", "<u2", width),
            ("meta", "<u2", width),
        ]
    )


class Parts(NamedTuple):
    """The sections of a file, as views of its bytes."""

    header: np.ndarray  # header_dtype, ()
    directions: np.ndarray  # float32 (K, 3), unit normals
    nodes: np.ndarray  # node_dtype(W), (n,)
    blocks: np.ndarray  # block_dtype, (b,)
    record: np.ndarray  # record_dtype, ()


def parts(data: Any) -> Parts:
    """Splits the bytes of a valid file into its sections."""
    header = np.frombuffer(data, header_dtype, 1)[0]
    table = np.frombuffer(data, section_dtype, header["section_count"], header["header_size"])

    def section(number: int, dtype: np.dtype) -> np.ndarray:
        entry = table[table["id"] == number][0]
        return np.frombuffer(data, dtype, entry["size"] // dtype.itemsize, entry["offset"])

    return Parts(
        header,
        section(1, np.dtype(("<f4", 3))),
        section(2, node_dtype(int(header["width"]))),
        section(3, block_dtype),
        section(4, record_dtype)[0],
    )
