# SPDX-License-Identifier: Apache-2.0
"""Rays per second beside Embree's, as `sobb_bench` measures them."""
