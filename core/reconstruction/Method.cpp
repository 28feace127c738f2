// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/reconstruction/Method.h"

#include <string>

namespace reflet {

namespace {

constexpr const char* kNames[] = {"sky",   "nearest",   "blend",    "box",     "mem",
                                  "dense", "per-pixel", "raytrace", "rerender"};

}  // namespace

const char* toString(Method method) {
    return kNames[std::size_t(method)];
}

const std::vector<Method>& allMethods() {
    static const std::vector<Method> methods{Method::Sky,      Method::Nearest,  Method::Blend,
                                             Method::Box,      Method::Mem,      Method::Dense,
                                             Method::PerPixel, Method::RayTrace, Method::Rerender};
    return methods;
}

bool needsProbes(Method method) {
    return method == Method::Nearest || method == Method::Blend || method == Method::Box ||
           method == Method::Mem || method == Method::Dense || method == Method::PerPixel;
}

Result<Method> methodFromString(std::string_view name) {
    std::string known;
    for (const Method method : allMethods()) {
        if (name == toString(method))
            return method;
        known += (known.empty() ? "" : ", ") + std::string(toString(method));
    }
    return fail(ErrorCode::Usage, "there is no method of that name", std::string(name),
                "Choose among " + known + ".");
}

}  // namespace reflet
