// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/pipeline/Figures.h"

#include <map>
#include <vector>

namespace reflet {

/// Metres between two local maps of a drive.
inline constexpr double kPopStep = 0.5;

/// Drives the middle stretch of each reflector's route, `metres` long, in steps of kPopStep, and
/// compares how the local map of its first body changes with how the ray-traced one does. Other
/// vehicles are left out: they move by themselves. Steps to or from a place where the reference is
/// refused (inside a wall) do not count. Methods without a change in any step are given as they
/// are; those of no step at all are left out.
[[nodiscard]] Result<std::map<Method, PopFigures>> measurePops(
    const PreparedCity& city, const Traffic& traffic, const RemSet& rems,
    const std::vector<Method>& methods, double metres, const JobContext& job);

/// The figures of steps that were measured. steps: mean |I_t − I_t−1| each; changed: whether the
/// REMs in use changed over it; against: mean |(I_t − I_t−1) − (R_t − R_t−1)| each.
[[nodiscard]] PopFigures popFigures(const std::vector<double>& steps,
                                    const std::vector<bool>& changed,
                                    const std::vector<double>& against);

}  // namespace reflet
