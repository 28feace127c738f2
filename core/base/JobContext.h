// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/Error.h"

#include <functional>
#include <stop_token>
#include <string>

namespace reflet {

/// What a long function is given so that it can report progress and be cancelled.
/// Copies share the same sink. Progress is nested: a phase maps its own 0..1 into a part of its
/// parent's. Safe to use from several threads when the sink is.
class JobContext {
public:
    /// Called with the overall fraction (0..1) and the name of the innermost phase.
    using Sink = std::function<void(double fraction, const std::string& phase)>;

    /// A context that reports nowhere and is never cancelled.
    JobContext() = default;
    JobContext(Sink sink, std::stop_token stop)
        : m_sink(std::move(sink)), m_stop(std::move(stop)) {}

    /// A phase that covers [from, to] of this context's progress.
    [[nodiscard]] JobContext phase(std::string name, double from, double to) const;
    /// Reports the fraction (0..1) of this phase that is done.
    void progress(double fraction) const;
    [[nodiscard]] bool cancelled() const { return m_stop.stop_requested(); }
    [[nodiscard]] const std::stop_token& stopToken() const { return m_stop; }
    /// The error that a cancelled job returns.
    [[nodiscard]] static Error cancelledError();

private:
    Sink m_sink;
    std::stop_token m_stop;
    std::string m_name;
    double m_from = 0.0;
    double m_to = 1.0;
};

}  // namespace reflet
