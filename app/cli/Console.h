// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/cli/Arguments.h"
#include "core/base/Diagnostic.h"
#include "core/base/Error.h"
#include "core/base/JobContext.h"

#include <nlohmann/json.hpp>

#include <optional>
#include <string>

namespace reflet::cli {

/// Exit codes of DESIGN section 7.
enum Exit : int {
    kDone = 0,
    kSomeFailed = 1,
    kUsage = 2,
    kUnreadable = 3,
    kRefused = 4,
    kResourceLimit = 5,
    kInterrupted = 130
};

[[nodiscard]] int exitCodeOf(ErrorCode code);

/// Where the program talks: data on standard output, messages on standard error.
class Console {
public:
    Console(const GlobalOptions& options, std::stop_token stop)
        : m_options(options), m_stop(std::move(stop)) {}

    [[nodiscard]] bool json() const { return m_options.json; }
    /// A job whose progress goes to standard error and that an interrupt cancels.
    [[nodiscard]] JobContext job() const;
    /// Data: one JSON document, with "schemaVersion" added.
    void data(nlohmann::json document) const;
    /// Data for people; nothing with --json.
    void text(const std::string& line) const;
    /// A message; nothing with --quiet.
    void note(const std::string& line) const;
    void note(const Diagnostic& diagnostic) const;
    /// Says what went wrong (and as JSON with --json); returns the exit code.
    [[nodiscard]] int failed(const Error& error) const;

private:
    GlobalOptions m_options;
    std::stop_token m_stop;
};

[[nodiscard]] nlohmann::json toJson(const Diagnostic& diagnostic);
[[nodiscard]] nlohmann::json toJson(const std::vector<Diagnostic>& diagnostics);

/// Numbers separated by commas; Usage unless there are `least` to `most` of them.
[[nodiscard]] Result<std::vector<double>> parseNumbers(const std::string& text, std::size_t least,
                                                       std::size_t most, const std::string& option);
/// Metres of "m", "cm", "mm", "km", "ft", "us-ft", "in" or a number; nothing for an empty text;
/// Usage for another.
[[nodiscard]] Result<std::optional<double>> parseUnit(const std::string& text);
/// The parts of a list with commas; empty for an empty text.
[[nodiscard]] std::vector<std::string> splitList(const std::string& text);

}  // namespace reflet::cli
