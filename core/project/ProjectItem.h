// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace reflet {

/// Names one thing of a project that can be selected: by kind and id, never by pointer or index.
struct ProjectItem {
    enum class Kind { Model, Probe, Route, Reflector, Vehicle, View };
    Kind kind = Kind::Probe;
    std::string id;  ///< a model's path, a view's name, else the id

    friend bool operator==(const ProjectItem&, const ProjectItem&) = default;
};

}  // namespace reflet
