// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/viewport/camera/CameraDriver.h"

#include <cmath>

namespace reflet {

namespace {

constexpr double kFlightSeconds = 0.2;
constexpr double kClearance = 0.4;  // metres over the ground that a flying camera keeps
constexpr double kSettled = 1e-4;   // metres a tick: nobody sees less

}  // namespace

void CameraDriver::setGround(std::shared_ptr<const Ground> ground) {
    m_ground = std::move(ground);
    m_settling = m_walking;
}

Camera CameraDriver::overGround(const Camera& camera) const {
    const Camera sound = upright(camera);
    return raised(sound, m_ground->heightAt(sound.position.x, sound.position.y), kClearance);
}

void CameraDriver::jump(const Camera& camera) {
    m_flying = false;
    m_camera = m_walking ? upright(camera) : overGround(camera);
}

void CameraDriver::fly(const Camera& camera) {
    if (m_reduced) {
        jump(camera);
        return;
    }
    m_from = m_camera;
    m_to = m_walking ? upright(camera) : overGround(camera);
    m_share = 0.0;
    m_flying = true;
}

void CameraDriver::setWalking(bool walking) {
    if (walking == m_walking) {
        return;
    }
    m_walking = walking;
    m_input = {};
    if (walking) {
        fly(Walker::standing(*m_ground, m_camera));
    } else {
        m_flying = false;
    }
}

bool CameraDriver::moving() const {
    return m_flying || (m_walking && (m_settling || !m_input.idle()));
}

bool CameraDriver::tick(double seconds) {
    if (m_flying) {
        m_share += seconds / kFlightSeconds;
        m_camera = between(m_from, m_to, m_share);
        if (!m_walking) {
            m_camera = overGround(m_camera);
        }
        m_flying = m_share < 1.0;
        return true;
    }
    if (!m_walking || !moving()) {
        return false;
    }
    const Camera before = m_camera;
    m_camera = Walker::walked(*m_ground, m_camera, m_input, seconds);
    m_settling = std::abs(m_camera.position.z - before.position.z) > kSettled;
    return m_camera.position != before.position || m_camera.target != before.target;
}

}  // namespace reflet
