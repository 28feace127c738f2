// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/base/Error.h"

namespace reflet {

Error Error::in(std::string context) const& {
    Error outer = *this;
    outer.trail.push_back(std::move(context));
    return outer;
}

std::string Error::message() const {
    std::string text = subject.empty() ? what : subject + ": " + what;
    if (!text.empty() && text.back() != '.')
        text += '.';
    for (const auto& context : trail)
        text += " (" + context + ")";
    if (!remedy.empty())
        text += " " + remedy;
    return text;
}

}  // namespace reflet
