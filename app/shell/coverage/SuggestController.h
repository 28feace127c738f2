// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/pipeline/coverage/Suggest.h"
#include "app/shell/Workbench.h"
#include "widgets/coverage/CoveragePanel.h"

#include <QObject>
#include <optional>
#include <string>
#include <vector>

class QMenu;

namespace reflet {

class CoverageController;

/// Suggested probes: worked out in the background, shown as ghosts with what they gain, and taken
/// into the project one by one, all at once or not at all.
class SuggestController : public QObject {
    Q_OBJECT
public:
    SuggestController(Workbench& bench, CoverageController& coverage, QObject* parent);

    void suggest(const SuggestionWish& wish);
    /// One ghost at the best place near a spot (project frame); those that are there stay.
    void suggestHere(const glm::dvec3& spot);
    /// One step of undo.
    void acceptAll();
    void accept(const std::string& id);
    void dismiss();
    /// What a menu over the ground offers there.
    void extendMenu(QMenu* menu, const glm::dvec3& ground);

private:
    void show(Suggestion suggestion);
    /// What of the suggestion is not in the project: what is undone comes back.
    [[nodiscard]] std::vector<SuggestedProbe> pending() const;
    void showPending();
    void move(const std::string& id);
    void add(SuggestedProbe probe);

    Workbench& m_bench;
    CoverageController& m_coverage;
    std::optional<Suggestion> m_suggestion;
    std::optional<SuggestionFacts> m_facts;  ///< its card
};

}  // namespace reflet
