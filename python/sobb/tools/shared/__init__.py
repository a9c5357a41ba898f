# SPDX-License-Identifier: Apache-2.0
"""What several commands use: scenes by name, benchmark programs, tables, colours, files."""
