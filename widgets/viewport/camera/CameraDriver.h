// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "widgets/viewport/camera/CameraMoves.h"
#include "widgets/viewport/camera/Ground.h"
#include "widgets/viewport/camera/Walker.h"

#include <memory>

namespace reflet {

/// The camera of a viewport as time goes by: flights, walking, and never below the ground. Knows no
/// clock but the one that tick() tells.
class CameraDriver {
public:
    [[nodiscard]] const Camera& camera() const { return m_camera; }
    void setGround(std::shared_ptr<const Ground> ground);

    /// At once; ends a flight.
    void jump(const Camera& camera);
    /// Eased, within a fifth of a second; a jump with reduced motion.
    void fly(const Camera& camera);
    /// Where it will be when a flight is over.
    [[nodiscard]] const Camera& destination() const { return m_flying ? m_to : m_camera; }
    /// The user takes over: the camera stays where the flight is now.
    void interrupt() { m_flying = false; }
    void setReducedMotion(bool reduced) { m_reduced = reduced; }

    /// Steps down to the pavement, or stays where it is and is free again.
    void setWalking(bool walking);
    [[nodiscard]] bool walking() const { return m_walking; }
    void setInput(const WalkInput& input) { m_input = input; }

    /// Whether it needs ticks.
    [[nodiscard]] bool moving() const;
    /// Lets time pass; returns whether the camera changed.
    bool tick(double seconds);

private:
    [[nodiscard]] Camera overGround(const Camera& camera) const;

    std::shared_ptr<const Ground> m_ground = std::make_shared<const Ground>();
    Camera m_camera{{-40.0, -60.0, 40.0}, {0.0, 0.0, 0.0}, 0.9};
    Camera m_from, m_to;
    double m_share = 0.0;  ///< of the flight
    bool m_flying = false;
    bool m_walking = false;
    bool m_settling = false;  ///< eyes still follow the last step
    bool m_reduced = false;
    WalkInput m_input;
};

}  // namespace reflet
