// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/Console.h"

#include "app/pipeline/ImportReportJson.h"

#include <fmt/format.h>

#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <memory>
#include <mutex>
#include <sstream>
#include <string_view>
#include <unistd.h>
#include <utility>

namespace reflet::cli {

namespace {

constexpr int kSchemaVersion = 1;

/// Progress at most ten times a second, from any thread.
struct ProgressState {
    std::mutex mutex;
    std::chrono::steady_clock::time_point last{};
    bool shown = false;

    ~ProgressState() {
        if (shown)
            fmt::print(stderr, "\r\033[K");
    }
    bool due() {
        const auto now = std::chrono::steady_clock::now();
        if (now - last < std::chrono::milliseconds(100))
            return false;
        last = now;
        return true;
    }
};

const char* nameOf(ErrorCode code) {
    switch (code) {
        case ErrorCode::Usage:
            return "usage";
        case ErrorCode::Unreadable:
            return "unreadable";
        case ErrorCode::Refused:
            return "refused";
        case ErrorCode::ResourceLimit:
            return "resource-limit";
        case ErrorCode::WriteFailed:
            return "write-failed";
        case ErrorCode::Cancelled:
            return "cancelled";
        case ErrorCode::SomeFailed:
            return "some-failed";
        case ErrorCode::Internal:
            return "internal";
    }
    return "internal";
}

}  // namespace

int exitCodeOf(ErrorCode code) {
    switch (code) {
        case ErrorCode::Usage:
            return kUsage;
        case ErrorCode::Unreadable:
            return kUnreadable;
        case ErrorCode::Refused:
            return kRefused;
        case ErrorCode::ResourceLimit:
        case ErrorCode::WriteFailed:
            return kResourceLimit;
        case ErrorCode::Cancelled:
            return kInterrupted;
        case ErrorCode::SomeFailed:
        case ErrorCode::Internal:
            return kSomeFailed;
    }
    return kSomeFailed;
}

JobContext Console::job() const {
    const bool lines = m_options.progressJson;
    const bool terminal = !lines && !m_options.quiet && isatty(STDERR_FILENO) == 1;
    if (!lines && !terminal)
        return JobContext({}, m_stop);
    auto state = std::make_shared<ProgressState>();
    return JobContext(
        [state, lines](double fraction, const std::string& phase) {
            const std::scoped_lock lock(state->mutex);
            if (!state->due())
                return;
            if (lines) {
                fmt::print(stderr, "{}\n",
                           nlohmann::json{{"progress", fraction}, {"phase", phase}}.dump());
            } else {
                state->shown = true;
                fmt::print(stderr, "\r\033[K{:3.0f} %  {}", fraction * 100.0, phase);
                std::fflush(stderr);
            }
        },
        m_stop);
}

void Console::data(nlohmann::json document) const {
    document["schemaVersion"] = kSchemaVersion;
    fmt::print("{}\n", document.dump(2, ' ', false, nlohmann::json::error_handler_t::replace));
}

void Console::text(const std::string& line) const {
    if (!m_options.json)
        fmt::print("{}\n", line);
}

void Console::note(const std::string& line) const {
    if (!m_options.quiet)
        fmt::print(stderr, "{}\n", line);
}

void Console::note(const Diagnostic& diagnostic) const {
    std::string line = fmt::format("{} [{}]", toString(diagnostic.severity), diagnostic.code);
    if (!diagnostic.object.empty())
        line += " " + diagnostic.object;
    line += ": " + diagnostic.text;
    if (!diagnostic.remedy.empty())
        line += " " + diagnostic.remedy;
    note(line);
}

int Console::failed(const Error& error) const {
    fmt::print(stderr, "reflet-cli: {}\n", error.message());
    if (m_options.json) {
        data({{"error",
               {{"code", nameOf(error.code)},
                {"what", error.what},
                {"subject", error.subject},
                {"remedy", error.remedy},
                {"trail", error.trail}}}});
    }
    return exitCodeOf(error.code);
}

nlohmann::json toJson(const Diagnostic& d) {
    return remarkJson(d);
}

nlohmann::json toJson(const std::vector<Diagnostic>& diagnostics) {
    nlohmann::json out = nlohmann::json::array();
    for (const auto& diagnostic : diagnostics)
        out.push_back(toJson(diagnostic));
    return out;
}

Result<std::optional<double>> parseUnit(const std::string& text) {
    constexpr double kSmallest = 1e-6, kLargest = 1e6;
    constexpr std::array<std::pair<std::string_view, double>, 7> kUnits{{{"m", 1.0},
                                                                         {"cm", 0.01},
                                                                         {"mm", 0.001},
                                                                         {"km", 1000.0},
                                                                         {"ft", 0.3048},
                                                                         {"us-ft", 1200.0 / 3937.0},
                                                                         {"in", 0.0254}}};
    if (text.empty())
        return std::nullopt;
    for (const auto& [name, metres] : kUnits) {
        if (text == name)
            return metres;
    }
    const auto number = parseNumbers(text, 1, 1, "--unit");
    if (number && number->front() >= kSmallest && number->front() <= kLargest)
        return number->front();
    return fail(ErrorCode::Usage, "this is no unit of length", "--unit " + text,
                "Give m, cm, mm, km, ft, us-ft, in, or its metres between 1e-6 and 1e6.");
}

std::vector<std::string> splitList(const std::string& text) {
    std::vector<std::string> parts;
    std::istringstream stream(text);
    std::string part;
    while (std::getline(stream, part, ',')) {
        if (!part.empty())
            parts.push_back(part);
    }
    return parts;
}

Result<std::vector<double>> parseNumbers(const std::string& text, std::size_t least,
                                         std::size_t most, const std::string& option) {
    std::vector<double> numbers;
    for (const auto& part : splitList(text)) {
        char* end = nullptr;
        const double number = std::strtod(part.c_str(), &end);
        if (end == part.c_str() || *end != '\0' || !std::isfinite(number)) {
            return fail(ErrorCode::Usage, "\"" + part + "\" is no number", option,
                        "Numbers are separated by commas.");
        }
        numbers.push_back(number);
    }
    if (numbers.size() < least || numbers.size() > most) {
        const std::string wanted =
            least == most ? fmt::format("{}", least) : fmt::format("{} to {}", least, most);
        return fail(ErrorCode::Usage,
                    fmt::format("{} numbers were expected, {} given", wanted, numbers.size()),
                    option, "Numbers are separated by commas, without spaces.");
    }
    return numbers;
}

}  // namespace reflet::cli
