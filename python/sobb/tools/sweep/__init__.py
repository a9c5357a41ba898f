# SPDX-License-Identifier: Apache-2.0
"""Scenes, views, methods and options, measured case by case into a DuckDB file."""
