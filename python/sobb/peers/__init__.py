# SPDX-License-Identifier: Apache-2.0
"""Rays a second beside Embree's, measured by `sobb_bench`."""
