# SPDX-License-Identifier: Apache-2.0
"""The pictures of a scene on the page: rendered, heat maps, and the volumes of two levels."""
