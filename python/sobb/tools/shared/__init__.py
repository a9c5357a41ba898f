# SPDX-License-Identifier: Apache-2.0
"""Parts that several commands use: scenes by name, benchmark programs, tables, colours, files."""
