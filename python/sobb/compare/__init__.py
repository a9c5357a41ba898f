# SPDX-License-Identifier: Apache-2.0
"""Two files of results: what got faster or slower than the noise."""
