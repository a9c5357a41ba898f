// SPDX-License-Identifier: Apache-2.0
// A header of the parent's own, named as one of the library's.
#error "the library includes its parent's headers"
