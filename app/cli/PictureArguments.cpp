// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/PictureArguments.h"

#include "app/cli/Console.h"

#include <fmt/format.h>

#include <cstdio>

namespace reflet::cli {

namespace {

constexpr int kLargestEdge = 16384;

Result<void> readMethods(const RenderArguments& arguments, PictureArguments& out) {
    const std::vector<std::string> pair = splitList(arguments.wipe);
    if (!arguments.wipe.empty() && pair.size() != 2) {
        return fail(ErrorCode::Usage, "a wipe needs two methods", "--wipe",
                    "Write them with a comma: --wipe sky,mem.");
    }
    const auto left = methodFromString(pair.empty() ? arguments.method : pair[0]);
    if (!left)
        return tl::unexpected(left.error());
    out.method = *left;
    if (pair.empty())
        return {};
    const auto right = methodFromString(pair[1]);
    if (!right)
        return tl::unexpected(right.error());
    out.right = *right;
    return {};
}

}  // namespace

Result<glm::ivec2> pictureSize(const std::string& text) {
    glm::ivec2 size(0);
    char rest = 0;
    const int found = std::sscanf(text.c_str(), "%dx%d%c", &size.x, &size.y, &rest);
    const auto fits = [](int edge) { return edge >= 16 && edge <= kLargestEdge; };
    if (found != 2 || !fits(size.x) || !fits(size.y)) {
        return fail(ErrorCode::Usage, "\"" + text + "\" is no picture size", "--size",
                    fmt::format("Write it as 1920x1080, each 16 to {}.", kLargestEdge));
    }
    return size;
}

Result<PictureArguments> pictureArguments(const RenderArguments& arguments) {
    PictureArguments out;
    const auto size = pictureSize(arguments.size);
    if (!size)
        return tl::unexpected(size.error());
    out.width = size->x;
    out.height = size->y;
    if (auto methods = readMethods(arguments, out); !methods)
        return tl::unexpected(methods.error());
    out.wipe = float(arguments.wipeAt);
    return out;
}

}  // namespace reflet::cli
