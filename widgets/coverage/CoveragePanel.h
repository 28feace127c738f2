// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/coverage/CoverageFigures.h"

#include <glm/vec3.hpp>

#include <QString>
#include <QWidget>
#include <memory>
#include <optional>
#include <vector>

namespace reflet {

/// What the panel shows of a measured coverage. Places are in the project frame.
struct CoverageFacts {
    struct Route {
        QString name;
        LineFigures figures;
        glm::dvec3 worst{0.0};
    };
    struct Place {
        QString name;  ///< "Main street, 120–130 m"
        double coverage = 0.0;
        glm::dvec3 place{0.0};
    };
    struct Facade {
        QString object;
        double uncovered = 0.0, reflected = 0.0;  ///< m²
        glm::dvec3 place{0.0};
    };
    struct ProbeShare {
        QString id;
        double serves = 0.0;         ///< share of all
        std::optional<double> loss;  ///< coverage that would be lost without it
    };
    Estimate coverage;
    Estimate seen, seenTwice;
    std::optional<Estimate> shown;  ///< by the reconstruction; none while probes are moved
    std::vector<Route> routes;
    std::vector<Place> worst;
    std::vector<Facade> facades;  ///< none while probes are moved
    std::vector<ProbeShare> probes;
    double reflectedWalls = 0.0, uncoveredWalls = 0.0;  ///< m²
};

/// What the panel shows of a suggestion.
struct SuggestionFacts {
    struct Move {
        QString id;
        double gain = 0.0;
    };
    QString sentence;    ///< "27 probes reach 96.1 %; no 27 could exceed 98.3 %."
    QString comparison;  ///< with even spacing, junctions, chance; may be empty
    int pending = 0;     ///< suggested probes that are neither accepted nor dismissed
    std::vector<Move> moves;
};

/// What is asked of a suggestion: a coverage, or a number of new probes.
struct SuggestionWish {
    std::optional<double> coverage;  ///< 0..1
    std::optional<int> count;
};

/// How well the probes serve what vehicles mirror, where they do not, and what would help. A
/// passive view.
class CoveragePanel : public QWidget {
    Q_OBJECT
public:
    /// Less of all than this, served by a probe, is called waste.
    static constexpr double kWaste = 0.005;

    explicit CoveragePanel(QWidget* parent = nullptr);
    ~CoveragePanel() override;

    /// nullopt: nothing has been measured.
    void setFacts(const std::optional<CoverageFacts>& facts);
    /// What keeps the figures from being true any more; empty: they are.
    void setStale(const QString& why);
    void setMeasuring(bool measuring);
    void setSuggesting(bool suggesting);
    /// nullopt: nothing is suggested.
    void setSuggestion(const std::optional<SuggestionFacts>& suggestion);
    void setMapShown(bool shown);
    /// There is something to measure and to suggest for.
    void setPossible(bool possible);
    [[nodiscard]] SuggestionWish wish() const;

Q_SIGNALS:
    void measureRequested();
    void cancelRequested();  ///< of measuring and suggesting
    void mapToggled(bool shown);
    void placeActivated(const glm::dvec3& place);
    void probeActivated(const QString& id);
    void suggestRequested(const reflet::SuggestionWish& wish);
    void acceptAllRequested();
    void dismissRequested();
    void moveRequested(const QString& id);

private:
    struct Impl;
    std::unique_ptr<Impl> m_impl;
};

}  // namespace reflet
