// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/base/JobContext.h"

#include <algorithm>

namespace reflet {

JobContext JobContext::phase(std::string name, double from, double to) const {
    JobContext inner = *this;
    inner.m_name = std::move(name);
    inner.m_from = m_from + (m_to - m_from) * from;
    inner.m_to = m_from + (m_to - m_from) * to;
    return inner;
}

void JobContext::progress(double fraction) const {
    if (m_sink)
        m_sink(m_from + (m_to - m_from) * std::clamp(fraction, 0.0, 1.0), m_name);
}

Error JobContext::cancelledError() {
    return {ErrorCode::Cancelled,
            "cancelled",
            "",
            "Start it again to finish; what was done is kept.",
            {}};
}

}  // namespace reflet
