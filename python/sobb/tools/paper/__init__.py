# SPDX-License-Identifier: Apache-2.0
"""The paper's table: every bounding volume over the same hierarchies, scene by scene."""
