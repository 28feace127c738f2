// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/JobContext.h"
#include "core/coverage/Service.h"

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace reflet {

/// Places for REMs, and what each serves: rows by places, columns by the samples of a demand.
struct ServiceTable {
    std::size_t samples = 0;
    std::vector<ServiceRow> rows;
};

/// The worth of a set S of places, as a share of what is demanded (0..1):
///
///   f(S) = 1/n · Σ over samples of (1 − κ) · best service + κ · second best service
///
/// monotone and submodular for 0 <= κ <= 1/2. With κ = 0 it is the coverage. κ above 0 plans for
/// the two REMs that the reconstruction blends: a sample that two see counts a little more than one
/// that hangs on a single REM.
inline constexpr double kSecondShare = 0.1;
[[nodiscard]] double worthOf(const ServiceTable& table, std::span<const std::size_t> places,
                             double secondShare);

/// What is asked for. Either of `count` and `coverage`, or both: what is reached first ends it.
struct PlacementGoal {
    std::optional<std::size_t> count;  ///< of places besides the fixed ones
    std::optional<double> coverage;    ///< 0..1, of worthOf(.., 0)
    double leastGain = 0.0;            ///< a place that adds less to the worth is not taken
};

struct PlacedRow {
    std::size_t row = 0;
    double gain = 0.0;      ///< worth that it added when it was chosen
    double coverage = 0.0;  ///< with it and all before it
};

struct Placement {
    std::vector<PlacedRow> chosen;  ///< in the order in which they were chosen, without the fixed
    double before = 0.0;            ///< coverage of the fixed places alone
    double coverage = 0.0;          ///< of all
    double worth = 0.0;             ///< with kSecondShare
    bool reached = false;           ///< what was asked for

    /// The fixed places and the chosen ones.
    [[nodiscard]] std::vector<std::size_t> all(std::span<const std::size_t> fixed) const;
};

/// Greedy with lazy gains (Minoux 1978; CELF, Leskovec et al. 2007): the place that adds most to
/// the worth, again and again; ties go to the smaller row. Then backwards: a place whose loss the
/// goal bears is given back, the least first, and each is exchanged for a better one where there is
/// one. Deterministic for any number of threads. When the job is cancelled: Cancelled.
[[nodiscard]] Result<Placement> place(const ServiceTable& table, std::span<const std::size_t> fixed,
                                      const PlacementGoal& goal, const JobContext& job);

/// What no set of places can exceed.
struct Certificate {
    double prefix = 1.0;      ///< least of the bounds from the gains at prefixes of the order
    double everything = 1.0;  ///< worth of all places together
    double dual = 1.0;        ///< of the Lagrangian dual
    [[nodiscard]] double upperBound() const { return std::min(prefix, std::min(everything, dual)); }
};

/// Upper bounds on the worth of the fixed places and any `count` others, by what is known at the
/// prefixes of an order of places (those of place(), or any).
///
/// - f(S) + the sum of the `count` largest gains at S, for prefixes S.
/// - The dual of the facility-location program: each sample pays u1 and u2 for its best and second
///   best service, each place earns what it serves beyond that, and `count` places earn at most the
///   sum of the `count` largest earnings. Valid for every u >= 0; u is improved by subgradient
///   steps (Held, Wolfe, Crowder 1974; for locations Cornuéjols, Fisher, Nemhauser 1977).
[[nodiscard]] Result<Certificate> certify(const ServiceTable& table,
                                          std::span<const std::size_t> fixed,
                                          std::span<const std::size_t> order, std::size_t count,
                                          double secondShare, const JobContext& job);

/// The least number of places besides the fixed ones that could reach a coverage, by the same
/// bounds: no set of fewer does. At most `enough`, a number that is known to reach it.
[[nodiscard]] Result<std::size_t> leastCount(const ServiceTable& table,
                                             std::span<const std::size_t> fixed,
                                             std::span<const std::size_t> order, double coverage,
                                             std::size_t enough, const JobContext& job);

}  // namespace reflet
