# SPDX-License-Identifier: Apache-2.0
"""The results of sweeps as one HTML page that needs no other file."""
