# SPDX-License-Identifier: Apache-2.0
"""Cuts a hierarchy into its subtrees at a level, as if its nodes had two children each.

Files have nodes of 4 or 8 children. A node with c of them stands for log2(c) levels of a binary
hierarchy, so a child's level is its parent's plus log2(c).
"""

from typing import NamedTuple

import numpy as np

from sobb import format

_LEAF = 1 << 15
_TRIANGLES = 0x3F
# A node of 4 children steps at most 2 levels, so the first child beyond level - 1 is the nearest.
_HALF_STEP = 1.0


class Cut(NamedTuple):
    """The subtrees at one level, with the leaves that end above it."""

    corners: np.ndarray  # float32 (m, 3, 3), the triangles of all subtrees, subtree by subtree
    first: np.ndarray  # (n,), the first triangle of each subtree
    leaves: int  # how many of the subtrees are leaves

    def owners(self) -> np.ndarray:
        """Returns the subtree of each triangle, (m,)."""
        return np.repeat(np.arange(len(self.first)), np.diff(self.first, append=len(self.corners)))


def cut(file: format.Parts, level: float) -> Cut:
    """Cuts the hierarchy at a level; every triangle is in exactly one of the subtrees."""
    blocks: list[np.ndarray] = []  # (first block, blocks, subtree) of each leaf
    found = leaves_found = 0
    nodes = np.zeros(1, np.int64)
    depth = np.zeros(1)
    owner = np.full(1, -1)
    while nodes.size:
        meta = file.nodes["meta"][nodes]
        count = meta[:, 0] >> 8 & 0xF
        row, child = np.nonzero(np.arange(meta.shape[1]) < count[:, None])
        leaf = meta[row, child] & _LEAF != 0
        level_of = depth[row] + np.log2(np.maximum(count, 1))[row]
        of = owner[row]
        top = (of < 0) & (leaf | (level_of > level - _HALF_STEP))
        of[top] = found + np.arange(top.sum())
        found += int(top.sum())
        leaves_found += int((top & leaf).sum())
        reference = file.nodes["reference"][nodes[row], child].astype(np.int64)
        triangles = (meta[row, child] & _TRIANGLES).astype(np.int64)
        size = -(-triangles // format.LANES)
        blocks.append(np.stack([reference, size, of], axis=1)[leaf])
        nodes, depth, owner = reference[~leaf], level_of[~leaf], of[~leaf]
    corners, first = _triangles(file, np.concatenate(blocks), found)
    return Cut(corners, first, leaves_found)


def _triangles(
    file: format.Parts, leaves: np.ndarray, subtrees: int
) -> tuple[np.ndarray, np.ndarray]:
    """Returns the triangles, subtree by subtree, and the first of each subtree."""
    first, size, owner = leaves[np.argsort(leaves[:, 2], kind="stable")].T
    step = np.arange(size.sum()) - np.repeat(np.cumsum(size) - size, size)
    block = np.repeat(first, size) + step
    filled = file.blocks["primitive"][block] != format.NO_PRIMITIVE
    vertex = file.blocks["vertex"][block].transpose(0, 3, 1, 2)  # block, lane, corner, axis
    owners = np.broadcast_to(np.repeat(owner, size)[:, None], filled.shape)[filled]
    return vertex[filled], np.searchsorted(owners, np.arange(subtrees))
