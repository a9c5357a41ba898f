# SPDX-License-Identifier: Apache-2.0
"""The page: its text, table and charts, and the template that they fill."""
