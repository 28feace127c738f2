// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <tl/expected.hpp>

#include <string>
#include <utility>
#include <vector>

namespace reflet {

/// What kind of failure an Error is. The command line maps these to its exit codes.
enum class ErrorCode {
    Usage,          ///< the caller asked for something that does not exist or contradicts itself
    Unreadable,     ///< a file is absent, unreadable, truncated or not of its format
    Refused,        ///< the data are readable but must not be used as they are (CRS, geometry)
    ResourceLimit,  ///< a limit on memory, recursion, image or file size was met
    WriteFailed,    ///< an output could not be written; nothing partial was left behind
    Cancelled,      ///< the job's stop token was triggered
    SomeFailed,     ///< the job went through, but some of its items failed
    Internal,       ///< a library did what its documentation excludes
};

/// A failure as a value: what went wrong, with which thing, and what the user can do about it.
struct Error {
    ErrorCode code = ErrorCode::Internal;
    std::string what;                     ///< one sentence, without the subject's name
    std::string subject;                  ///< file, object or option that it is about; may be empty
    std::string remedy;                   ///< what the user can do; may be empty
    std::vector<std::string> trail = {};  ///< outer contexts, innermost first

    /// The same error seen from one level further out ("while importing a.city.json").
    [[nodiscard]] Error in(std::string context) const&;
    /// One line for people: "subject: what. remedy".
    [[nodiscard]] std::string message() const;
};

template <class T>
using Result = tl::expected<T, Error>;

/// Shorthand for `return fail(ErrorCode::Unreadable, "...", path, "...")`.
[[nodiscard]] inline tl::unexpected<Error> fail(ErrorCode code, std::string what,
                                                std::string subject = {}, std::string remedy = {}) {
    return tl::unexpected<Error>(
        Error{code, std::move(what), std::move(subject), std::move(remedy), {}});
}

}  // namespace reflet
