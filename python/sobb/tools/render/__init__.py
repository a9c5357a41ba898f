# SPDX-License-Identifier: Apache-2.0
"""Pictures of a hierarchy: shaded, or the work of each ray as a heat map."""
