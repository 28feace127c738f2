// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <csignal>
#include <functional>
#include <stdexcept>
#include <sys/wait.h>
#include <unistd.h>

namespace reflet::test {

/// A process of its own that does something until it is killed: a copy of the test program, which
/// starts a hundred times faster than another program would.
class Victim {
public:
    /// `live` runs in the process. It calls `ready` once, which this waits for, and goes on for
    /// ever; when it returns, something went wrong.
    explicit Victim(const std::function<void(const std::function<void()>& ready)>& live) {
        int pipe[2] = {-1, -1};
        if (::pipe(pipe) != 0)
            throw std::runtime_error("no pipe");
        m_process = ::fork();
        if (m_process == 0) {
            live([&] { static_cast<void>(!::write(pipe[1], "r", 1)); });
            ::_exit(1);
        }
        ::close(pipe[1]);
        char letter = 0;
        m_isReady = ::read(pipe[0], &letter, 1) == 1;
        ::close(pipe[0]);
    }
    ~Victim() { kill(); }
    Victim(const Victim&) = delete;
    Victim& operator=(const Victim&) = delete;

    [[nodiscard]] bool isReady() const { return m_isReady; }
    [[nodiscard]] pid_t process() const { return m_process; }

    /// kill -9, and waits until it is dead.
    void kill() {
        if (m_process <= 0)
            return;
        ::kill(m_process, SIGKILL);
        int status = 0;
        ::waitpid(m_process, &status, 0);
        m_process = -1;
    }

private:
    pid_t m_process = -1;
    bool m_isReady = false;
};

}  // namespace reflet::test
