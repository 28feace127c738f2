// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#if defined(__SSE2__)
#include <immintrin.h>
#endif

namespace reflet {

/// While it lives, this thread treats denormal numbers as zero, which Embree asks for: they would
/// slow its traversal down by orders of magnitude.
class FlushToZero {
public:
#if defined(__SSE2__)
    FlushToZero() : m_previous(_mm_getcsr()) {
        _mm_setcsr(m_previous | 0x8040U);
    }
    ~FlushToZero() {
        _mm_setcsr(m_previous);
    }
#else
    FlushToZero() = default;
#endif
    FlushToZero(const FlushToZero&) = delete;
    FlushToZero& operator=(const FlushToZero&) = delete;

private:
#if defined(__SSE2__)
    unsigned m_previous;
#endif
};

}  // namespace reflet
