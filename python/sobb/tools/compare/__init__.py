# SPDX-License-Identifier: Apache-2.0
"""Which figures differ between two files of results by more than their noise."""
