// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace reflet::test {

/// Milliseconds that something may take which comes in its own time: work in the background, or a
/// window manager on a machine with much to do. Waits end as soon as it is there.
inline constexpr int kPatience = 60'000;

}  // namespace reflet::test
