# SPDX-License-Identifier: Apache-2.0
"""Instruction sets that can be asked for, and what others call them."""

#: The library's names -> Embree's, which differ.
EMBREE = {"sse4": "sse4.2", "avx2": "avx2"}

#: The library's names -> those for people.
TITLES = {"sse4": "SSE4.2", "avx2": "AVX2"}
