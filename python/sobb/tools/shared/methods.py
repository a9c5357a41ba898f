# SPDX-License-Identifier: Apache-2.0
"""The bounding volumes that the benchmark programs compare."""

#: The names in the programs' rows -> the paper's names, in the paper's order.
TITLES = {
    "aabb": "AABB",
    "14-dop": "14-DOP",
    "obb": "OBB",
    "sobb32d": "SOBB 32d",
    "sobb32i": "SOBB 32i",
    "sobb48d": "SOBB 48d",
    "sobb48i": "SOBB 48i",
    "sobb64d": "SOBB 64d",
    "sobb64i": "SOBB 64i",
    "sobb128": "SOBB 128",
    "sobb256": "SOBB 256",
}
