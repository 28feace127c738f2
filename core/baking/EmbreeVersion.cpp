// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/baking/EmbreeVersion.h"

#include <embree3/rtcore.h>
#include <fmt/format.h>

namespace reflet {

std::string embreeVersion() {
    RTCDevice device = rtcNewDevice("threads=1");
    if (device == nullptr)
        return "not usable";
    const auto version = rtcGetDeviceProperty(device, RTC_DEVICE_PROPERTY_VERSION);
    rtcReleaseDevice(device);
    return fmt::format("{}.{}.{}", version / 10000, version / 100 % 100, version % 100);
}

}  // namespace reflet
