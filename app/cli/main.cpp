// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/Commands.h"
#include "core/base/ParallelFor.h"

#include <fmt/format.h>

#include <csignal>
#include <ctime>
#include <exception>
#include <thread>

namespace {

using namespace reflet;

/// Turns SIGINT and SIGTERM into a stop request while it lives. Signals are waited for on a thread
/// of their own, so that nothing has to happen inside a signal handler.
class InterruptWatch {
public:
    InterruptWatch() {
        sigemptyset(&m_signals);
        sigaddset(&m_signals, SIGINT);
        sigaddset(&m_signals, SIGTERM);
        pthread_sigmask(SIG_BLOCK, &m_signals, nullptr);
        m_thread = std::jthread([this](const std::stop_token& ended) {
            while (!ended.stop_requested()) {
                const timespec wait{0, 50'000'000};
                if (sigtimedwait(&m_signals, nullptr, &wait) > 0)
                    m_stop.request_stop();
            }
        });
    }
    [[nodiscard]] std::stop_token token() const { return m_stop.get_token(); }

private:
    sigset_t m_signals{};
    std::stop_source m_stop;
    std::jthread m_thread;
};

}  // namespace

int main(int argc, char** argv) {
    try {
        const auto parsed = cli::parseArguments(argc, argv);
        if (const int* code = std::get_if<int>(&parsed))
            return *code;
        const auto& arguments = std::get<cli::Arguments>(parsed);
        const InterruptWatch watch;
        setThreadLimit(arguments.global.jobs);
        const cli::Console console(arguments.global, watch.token());
        return std::visit([&](const auto& command) { return cli::run(command, console); },
                          arguments.command);
    } catch (const std::bad_alloc&) {
        fmt::print(stderr,
                   "reflet-cli: the memory is full. Close other programs, or load less with --bbox "
                   "or --types.\n");
        return cli::kResourceLimit;
    } catch (const std::exception& e) {
        fmt::print(stderr, "reflet-cli: internal error: {}\n", e.what());
        return cli::kSomeFailed;
    }
}
