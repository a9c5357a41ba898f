// SPDX-License-Identifier: Apache-2.0
// kSanitized tells whether AddressSanitizer or ThreadSanitizer watches the program, which takes ten
// times as long then. A test that only repeats itself over more rays or options takes fewer of
// them.
#pragma once

namespace sobb::test {

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
inline constexpr bool kSanitized = true;
#elif defined(__has_feature)
inline constexpr bool kSanitized =
    __has_feature(address_sanitizer) || __has_feature(thread_sanitizer);
#else
inline constexpr bool kSanitized = false;
#endif

}  // namespace sobb::test
