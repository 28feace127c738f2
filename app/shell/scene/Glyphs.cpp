// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/shell/scene/Glyphs.h"

#include "app/pipeline/Traffic.h"

#include <algorithm>

namespace reflet {
namespace {

constexpr double kProbeSurroundings = 12.0;  // metres around a probe that are shown with it

const RouteSpec* findRoute(const Project& project, const std::string& id) {
    const auto found = std::find_if(project.routes.begin(), project.routes.end(),
                                    [&](const RouteSpec& route) { return route.id == id; });
    return found == project.routes.end() ? nullptr : &*found;
}

void addRoute(Box& box, const Project& project, const std::string& id) {
    if (const RouteSpec* route = findRoute(project, id)) {
        for (const glm::dvec3& point : route->points) {
            box.add(point - project.frame.origin);
        }
    }
}

void addProbe(Box& box, const Project& project, const std::string& id) {
    for (const Probe& probe : project.probes) {
        if (probe.id == id) {
            const glm::dvec3 position = probe.position - project.frame.origin;
            box.add(position - glm::dvec3(kProbeSurroundings));
            box.add(position + glm::dvec3(kProbeSurroundings));
        }
    }
}

}  // namespace

std::vector<ProbeGlyph> probeGlyphs(const Project& project, const Selection& selection,
                                    const std::function<ProbeState(const std::string&)>& stateOf,
                                    bool previewSelected) {
    std::vector<ProbeGlyph> glyphs;
    glyphs.reserve(project.probes.size());
    for (const Probe& probe : project.probes) {
        ProbeGlyph glyph;
        glyph.id = probe.id;
        glyph.position = probe.position - project.frame.origin;
        glyph.state = stateOf(probe.id);
        glyph.selected = selection.contains({ProjectItem::Kind::Probe, probe.id});
        glyph.preview = previewSelected && glyph.selected;
        glyphs.push_back(std::move(glyph));
    }
    return glyphs;
}

std::vector<RouteGlyph> routeGlyphs(const Project& project, const Selection& selection) {
    std::vector<RouteGlyph> glyphs;
    glyphs.reserve(project.routes.size());
    for (const RouteSpec& route : project.routes) {
        RouteGlyph glyph;
        glyph.id = route.id;
        glyph.line = routeInFrame(route, project.frame).points();
        for (const glm::dvec3& point : route.points) {
            glyph.handles.push_back(point - project.frame.origin);
        }
        glyph.selected = selection.contains({ProjectItem::Kind::Route, route.id});
        glyphs.push_back(std::move(glyph));
    }
    return glyphs;
}

Box boxOf(const Project& project, const std::vector<ProjectItem>& items) {
    Box box;
    for (const ProjectItem& item : items) {
        switch (item.kind) {
            case ProjectItem::Kind::Probe:
                addProbe(box, project, item.id);
                break;
            case ProjectItem::Kind::Route:
                addRoute(box, project, item.id);
                break;
            case ProjectItem::Kind::Reflector:
                for (const Reflector& reflector : project.reflectors) {
                    if (reflector.id == item.id) {
                        addRoute(box, project, reflector.route);
                    }
                }
                break;
            case ProjectItem::Kind::View:
            case ProjectItem::Kind::Model:
            case ProjectItem::Kind::Vehicle:
                break;
        }
    }
    return box;
}

}  // namespace reflet
