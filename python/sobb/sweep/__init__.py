# SPDX-License-Identifier: Apache-2.0
"""Scenes x views x methods x options, measured case by case and kept in a DuckDB file."""
