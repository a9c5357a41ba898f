# SPDX-License-Identifier: Apache-2.0
"""What the page shows: its text, table and charts, and the template that they fill."""
