#pragma once

// GCC has macros, Clang has __has_feature.
#ifndef __has_feature
#define __has_feature(feature) 0
#endif

#if defined(__SANITIZE_ADDRESS__) || __has_feature(address_sanitizer)
#define GLOVEBENCH_ADDRESS_SANITIZER
#endif
#if defined(__SANITIZE_THREAD__) || __has_feature(thread_sanitizer)
#define GLOVEBENCH_THREAD_SANITIZER
#endif
