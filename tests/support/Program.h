// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "tests/support/TemporaryFolder.h"

#include <cstdio>
#include <filesystem>
#include <string>
#include <sys/wait.h>

namespace reflet::test {

/// What a program that ran to its end left.
struct ProgramResult {
    int exitCode = -1;
    std::string output;  ///< standard output
    std::string errors;  ///< standard error
};

/// Runs a shell command line and waits for it.
[[nodiscard]] inline ProgramResult runProgram(const std::string& commandLine) {
    const TemporaryFolder folder;
    const std::string redirected = commandLine + " >'" + (folder / "out").string() + "' 2>'" +
                                   (folder / "err").string() + "' </dev/null";
    const int status = std::system(redirected.c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, bytesOf(folder / "out"),
            bytesOf(folder / "err")};
}

}  // namespace reflet::test
