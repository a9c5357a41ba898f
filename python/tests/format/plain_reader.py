# SPDX-License-Identifier: Apache-2.0
"""A second reader of .sobb files, written from docs/format.md alone.

It uses the standard library, and neither NumPy nor libsobb. It checks every rule that the document
states, in the document's order.
"""

import math
import struct
from dataclasses import dataclass

from plain_xxh3 import xxh3_64

MIB = 2**20
NO_PRIMITIVE = 0xFFFFFFFF
MAGIC = bytes.fromhex("f5534f42420d0a1a")


class Refused(Exception):
    """A file that breaks a rule; `status` is the end of the name SOBB_ERROR_FORMAT_…"""

    def __init__(self, status, cause):
        super().__init__(f"{status}: {cause}")
        self.status = status


def require(rule, status, cause):
    if not rule:
        raise Refused(status, cause)


@dataclass
class Section:
    id: int
    reserved: int
    offset: int
    size: int
    checksum: int


@dataclass
class Node:
    slab: list  # [j][min or max][child], for unused children, too
    reference: list
    basis: list
    meta: list
    bits: bytes  # the bytes in the file

    @property
    def child_count(self):
        return self.meta[0] >> 8 & 15

    @property
    def shared(self):
        return bool(self.meta[0] >> 12 & 1)


@dataclass
class Block:
    vertex: list  # [vertex][axis][lane]
    primitive: list
    bits: bytes

    @property
    def used(self):
        return sum(p != NO_PRIMITIVE for p in self.primitive)


def is_leaf(meta):
    return bool(meta >> 15)


def triangles(meta):
    return meta & 63


def directions_of(basis):
    return basis & 31, basis >> 5 & 31, basis >> 10 & 31


def within(value, limit):
    return -limit <= value <= limit  # false for NaN


class SobbFile:
    """A file's fields, by the names of the document; raises Refused."""

    def __init__(self, data):
        self.data = bytes(data)
        self._header()
        self._sections()
        self._directions()
        self._record()
        self._blocks()
        self._nodes()
        self._tree()

    # -- header and sections

    def _header(self):
        data = self.data
        require(data[:8] == MAGIC[: len(data)], "MAGIC", "other bytes")
        require(len(data) >= 128, "SIZE", "shorter than a header")
        fields = struct.unpack_from("<8sIIQQIIIIIIII4fQ5Q", data)
        (
            self.magic,
            self.version,
            self.header_size,
            self.total_size,
            self.header_checksum,
            self.must_understand,
            self.ignorable,
            self.volume,
            self.width,
            self.direction_count,
            self.section_count,
            self.depth,
            self.reserved0,
        ) = fields[:13]
        self.centre, self.radius = fields[13:16], fields[16]
        self.triangle_count, self.reserved1 = fields[17], fields[18:]
        require(self.version == 1, "VERSION", self.version)
        require(self.total_size == len(data), "SIZE", "total_size")
        require(self.header_size == 128, "HEADER", "header_size")
        end = 128 + 32 * self.section_count
        require(self.section_count <= 64 and end <= len(data), "HEADER", "section_count")
        zeroed = data[:24] + bytes(8) + data[32:end]
        require(xxh3_64(zeroed) == self.header_checksum, "HEADER", "header_checksum")
        require(self.must_understand == 0, "FEATURE", self.must_understand)
        self._header_fields()

    def _header_fields(self):
        require(self.volume in (1, 2), "HEADER", "volume")
        require(self.width in (4, 8), "HEADER", "width")
        counts = (3,) if self.volume == 1 else (16, 24, 32)
        require(self.direction_count in counts, "HEADER", "direction_count")
        require(self.reserved0 == 0, "HEADER", "reserved0")
        require(all(within(c, 2.0**60) for c in self.centre), "HEADER", "centre")
        positive = within(self.radius, 2.0**62) and math.copysign(1, self.radius) > 0
        require(positive, "HEADER", "radius")
        require(1 <= self.triangle_count <= 2**32 - 3, "HEADER", "triangle_count")
        require(not any(self.reserved1), "HEADER", "reserved1")
        require(1 <= self.depth <= 96, "DEPTH", "depth")

    def _sections(self):
        table = struct.iter_unpack("<IIQQQ", self.data[128 : 128 + 32 * self.section_count])
        self.sections = [Section(*fields) for fields in table]
        for s in self.sections:
            require(s.reserved == 0 and s.offset % 64 == 0, "SECTION", s)
            require(s.offset + s.size <= len(self.data), "SECTION", s)
        end = 128 + 32 * self.section_count
        for s in sorted(self.sections, key=lambda s: (s.offset, s.size)):
            require(s.offset >= end, "SECTION", "overlap")
            require(not any(self.data[end : s.offset]), "SECTION", "gap")
            end = s.offset + s.size
        require(not any(self.data[end:]), "SECTION", "gap at the end")
        items = {
            "directions": self._part(1, 12, self.direction_count, self.direction_count),
            "record": self._part(4, 64, 1, 1),
            "nodes": self._part(2, 32 * self.width, 1, 2**32),
            "blocks": self._part(3, 160, 1, 2**32),
        }
        for s in self.sections:
            require(self._checksum(s) == s.checksum, "CHECKSUM", s)
        self._parts = items

    def _part(self, number, size, least, most):
        """The items of a section, each `size` bytes."""
        found = [s for s in self.sections if s.id == number]
        require(len(found) == 1, "SECTION", f"{len(found)} of id {number}")
        s = found[0]
        fits = s.size % size == 0 and least <= s.size // size <= most
        require(fits, "SECTION", f"size of id {number}")
        return [self.data[at : at + size] for at in range(s.offset, s.offset + s.size, size)]

    def _checksum(self, s):
        ends = range(s.offset, s.offset + s.size, MIB)
        pieces = [self.data[at : min(at + MIB, s.offset + s.size)] for at in ends]
        return xxh3_64(b"".join(struct.pack("<Q", xxh3_64(piece)) for piece in pieces))

    # -- what the sections hold

    def _directions(self):
        self.directions = [struct.unpack("<3f", item) for item in self._parts["directions"]]
        axes = [(1, 0, 0), (0, 1, 0), (0, 0, 1)]
        for i, n in enumerate(self.directions):
            length = math.sqrt(sum(x * x for x in n))
            require(abs(length - 1) <= 1e-5, "TABLE", n)
            require(self.volume == 2 or n == axes[i], "TABLE", n)

    def _record(self):
        fields = struct.unpack("<IIQQQ6f2I", self._parts["record"][0])
        self.quality, self.strategy, self.degenerate_count = fields[:3]
        self.reference_count, self.source_hash = fields[3:5]
        self.bounds_min, self.bounds_max, self.record_reserved = (
            fields[5:8],
            fields[8:11],
            fields[11:],
        )
        require(self.quality in (1, 2, 3), "RECORD", "quality")
        require(self.strategy in (1, 2, 3), "RECORD", "strategy")
        require(self.degenerate_count <= self.triangle_count, "RECORD", "degenerate_count")
        for low, high in zip(self.bounds_min, self.bounds_max, strict=True):
            fine = within(low, 2.0**60) and within(high, 2.0**60) and low <= high
            require(fine, "RECORD", "bounds")
        require(not any(self.record_reserved), "RECORD", "reserved")

    def _blocks(self):
        self.blocks = [self._block(item) for item in self._parts["blocks"]]
        for block in self.blocks:
            used = block.used
            require(used > 0, "TRIANGLE", "empty block")
            for lane, primitive in enumerate(block.primitive):
                numbers = [block.vertex[v][a][lane] for v in range(3) for a in range(3)]
                if lane < used:
                    require(primitive < self.triangle_count, "TRIANGLE", "primitive")
                    require(all(within(x, 2.0**60) for x in numbers), "TRIANGLE", "vertex")
                else:
                    require(primitive == NO_PRIMITIVE, "TRIANGLE", "lanes")
                    bits = b"".join(struct.pack("<f", x) for x in numbers)
                    require(not any(bits), "TRIANGLE", "unused lane")

    @staticmethod
    def _block(item):
        numbers = struct.unpack("<36f", item[:144])
        vertex = [[list(numbers[12 * v + 4 * a :][:4]) for a in range(3)] for v in range(3)]
        return Block(vertex, list(struct.unpack("<4I", item[144:])), item)

    def _nodes(self):
        self.nodes = [self._node(item) for item in self._parts["nodes"]]
        for index, node in enumerate(self.nodes):
            require(1 <= node.child_count <= self.width, "NODE", f"{index}: child count")
            for lane in range(self.width):
                if lane < node.child_count:
                    self._child(index, node, lane)
                else:
                    self._unused(node, lane)

    def _node(self, item):
        w = self.width
        numbers = struct.unpack_from(f"<{6 * w}f", item)
        slab = [[list(numbers[(2 * j + side) * w :][:w]) for side in range(2)] for j in range(3)]
        words = struct.unpack_from(f"<{w}I{w}H{w}H", item, 24 * w)
        return Node(slab, list(words[:w]), list(words[w : 2 * w]), list(words[2 * w :]), item)

    def _unused(self, node, lane):
        w = self.width
        for row in range(7):  # six of slabs, one of references
            at = 4 * (row * w + lane)
            require(not any(node.bits[at : at + 4]), "NODE", "unused lane")
        require(node.basis[lane] == 0 and node.meta[lane] == 0, "NODE", "unused lane")

    def _child(self, index, node, lane):
        meta, basis = node.meta[lane], node.basis[lane]
        defined = 0x803F | (0x1F00 if lane == 0 else 0)
        require(meta & ~defined == 0, "NODE", "meta")
        require(is_leaf(meta) == (triangles(meta) > 0), "NODE", "triangles")
        for low, high in node.slab:
            fine = within(low[lane], 2.0**62) and within(high[lane], 2.0**62)
            require(fine and low[lane] <= high[lane], "NODE", "slab")
        three = directions_of(basis)
        require(basis >> 15 == 0 and len(set(three)) == 3, "NODE", "basis")
        require(max(three) < self.direction_count, "NODE", "basis")
        require(self.volume == 2 or basis == 0x0820, "NODE", "basis of an AABB")
        require(not node.shared or basis == node.basis[0], "NODE", "shared basis")
        if is_leaf(meta):
            self._leaf(node.reference[lane], triangles(meta))
        else:
            require(index < node.reference[lane] < len(self.nodes), "REFERENCE", "node")

    def _leaf(self, first, count):
        blocks = -(-count // 4)
        require(first + blocks <= len(self.blocks), "REFERENCE", "blocks")
        for i in range(blocks):
            due = min(4, count - 4 * i)
            require(self.blocks[first + i].used == due, "TRIANGLE", "leaf")

    # -- the tree, in one pass

    def _tree(self):
        depth = [0] * len(self.nodes)
        depth[0] = 1
        used = [False] * len(self.blocks)
        references = 0
        for index, node in enumerate(self.nodes):
            require(depth[index] > 0, "REFERENCE", f"node {index} has no parent")
            for meta, target in zip(node.meta[: node.child_count], node.reference, strict=False):
                if is_leaf(meta):
                    for block in range(target, target + -(-triangles(meta) // 4)):
                        require(not used[block], "REFERENCE", f"block {block} twice")
                        used[block] = True
                    references += triangles(meta)
                    continue
                require(depth[target] == 0, "REFERENCE", f"node {target} twice")
                require(depth[index] < 96, "DEPTH", "more than 96")
                depth[target] = depth[index] + 1
        require(all(used), "REFERENCE", "a block in no leaf")
        require(max(depth) == self.depth, "DEPTH", "depth")
        require(references == self.reference_count, "RECORD", "reference_count")


def mended(data):
    """A copy whose size and checksums fit, as far as its header and table lead to bytes."""
    data = bytearray(data)
    if len(data) < 128:
        return bytes(data)
    struct.pack_into("<Q", data, 16, len(data))
    count = min(struct.unpack_from("<I", data, 52)[0], 64, (len(data) - 128) // 32)
    for i in range(count):
        offset, size = struct.unpack_from("<QQ", data, 128 + 32 * i + 8)
        if offset + size <= len(data):
            section = bytes(data[offset : offset + size])
            hashes = b"".join(
                struct.pack("<Q", xxh3_64(section[at : at + MIB])) for at in range(0, size, MIB)
            )
            struct.pack_into("<Q", data, 128 + 32 * i + 24, xxh3_64(hashes))
    data[24:32] = bytes(8)
    struct.pack_into("<Q", data, 24, xxh3_64(data[: 128 + 32 * count]))
    return bytes(data)
