#pragma once

namespace subimpact {

/// Whether the tests are built with it. It reserves more addresses than a limit of memory allows.
#if defined(__SANITIZE_ADDRESS__)
constexpr bool has_address_sanitizer = true;
#elif defined(__has_feature)
constexpr bool has_address_sanitizer = __has_feature(address_sanitizer);
#else
constexpr bool has_address_sanitizer = false;
#endif

}  // namespace subimpact
