// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/gpu/Frame.h"
#include "core/heightfield/Hiding.h"
#include "core/reconstruction/FrameBudget.h"

#include <future>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace reflet {

/// Chooses the detail of all local maps from picture to picture of a movement (DESIGN 5.4), and
/// learns from what pictures took. Without OpenGL.
class DetailPlanner {
public:
    /// Forgets everything. What the city hides is worked out in the background; until it is known
    /// nothing counts as hidden. Null: no city.
    void setCity(std::shared_ptr<const DrawnCity> city);

    struct Body {
        std::string reflector;
        std::size_t body = 0;
        glm::dvec3 center{0.0};  ///< of its map, project frame
        Box bounds;              ///< project frame
        double pixels = 0.0;     ///< along its longest edge, of the picture that is drawn
        double squeeze = 1.0;
        double interest = 1.0;
        std::size_t others = 0;  ///< bodies of other vehicles that its map may show
    };
    struct Choice {
        Detail detail;
        double weight = 1.0;  ///< for MapUpdate
        double units = 0.0;   ///< the same: with the other vehicles in its map
        bool hidden = false;  ///< by the city: its map is of no use
    };
    /// One for each body, in order. shrunk: the picture is drawn smaller than it is shown.
    [[nodiscard]] std::vector<Choice> plan(std::span<const Body> bodies, const glm::dvec3& eye,
                                           const MemSettings& tuned, bool shrunk);
    /// What the city hides; null until it has been worked out.
    [[nodiscard]] const Hiding* hiding() const;
    [[nodiscard]] FrameBudget& budget() { return m_budget; }
    [[nodiscard]] const FrameBudget& budget() const { return m_budget; }

private:
    using Key = std::pair<std::string, std::size_t>;
    struct Held {
        Detail detail;
        glm::dvec3 center{0.0};
    };
    [[nodiscard]] double nearestOf(const Body& body) const;

    std::shared_ptr<const DrawnCity> m_city;
    std::shared_future<Hiding> m_hiding;
    FrameBudget m_budget;
    std::map<Key, Held> m_held;  ///< of the last picture
};

}  // namespace reflet
